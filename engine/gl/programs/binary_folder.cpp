#include "engine/gl/programs/binary_folder.h"

#include <algorithm>
#include <filesystem>
#include <vector>

namespace weft::gl {

namespace fs = std::filesystem;

namespace {

struct Binary {
  fs::file_time_type used;
  std::string path;
  std::uint64_t bytes = 0;
};

bool hasBinaryName(const std::string& name) {
  return name.size() == kBinaryKeyLength + 4 && name.ends_with(".bin") &&
         name.find_first_not_of("0123456789abcdef") == kBinaryKeyLength;
}

}  // namespace

BinaryFolderUse pruneBinaries(const std::string& folder, std::uint64_t most) {
  std::vector<Binary> all;
  BinaryFolderUse use;
  std::error_code ec;
  for (fs::directory_iterator it(folder, ec), end; !ec && it != end; it.increment(ec)) {
    if (!hasBinaryName(it->path().filename().string())) continue;
    std::error_code gone;  // others may remove it meanwhile
    if (it->symlink_status(gone).type() != fs::file_type::regular || gone) continue;
    Binary binary{.used = it->last_write_time(gone), .path = it->path().string()};
    if (!gone) binary.bytes = it->file_size(gone);
    if (gone) continue;
    use.bytes += binary.bytes;
    all.push_back(std::move(binary));
  }
  if (use.bytes <= most) return use;
  std::ranges::sort(all, {}, [](const Binary& binary) { return std::tie(binary.used, binary.path); });
  for (const Binary& binary : all) {
    if (use.bytes <= most - most / 8) break;
    const bool removed = fs::remove(binary.path, ec);
    if (ec) continue;  // it may not be removed
    use.bytes -= binary.bytes;
    use.removed += removed ? 1 : 0;
  }
  return use;
}

}  // namespace weft::gl
