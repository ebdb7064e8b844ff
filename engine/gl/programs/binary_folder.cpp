#include "engine/gl/programs/binary_folder.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <vector>

namespace weft::gl {

namespace fs = std::filesystem;

namespace {

struct Binary {
  std::string path;
  fs::file_time_type used;
  std::uint64_t bytes = 0;
};

bool hasBinaryName(const std::string& name) {
  const auto isKey = [](char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0 || (c >= 'a' && c <= 'f');
  };
  return name.size() == kBinaryKeyLength + 4 && name.ends_with(".bin") &&
         std::all_of(name.begin(), name.begin() + kBinaryKeyLength, isKey);
}

bool hasMagic(const std::string& path) {
  char magic[kBinaryMagic.size()] = {};
  std::ifstream file(path, std::ios::binary);
  return file.read(magic, sizeof magic) && std::string_view(magic, sizeof magic) == kBinaryMagic;
}

// What others remove meanwhile is left out.
std::vector<Binary> listBinaries(const std::string& folder) {
  std::vector<Binary> all;
  std::error_code ec;
  for (fs::directory_iterator it(folder, ec), end; !ec && it != end; it.increment(ec)) {
    if (!hasBinaryName(it->path().filename().string())) continue;
    std::error_code gone;
    if (it->symlink_status(gone).type() != fs::file_type::regular || gone) continue;
    Binary binary{.path = it->path().string(), .used = it->last_write_time(gone)};
    if (!gone) binary.bytes = it->file_size(gone);
    if (!gone) all.push_back(std::move(binary));
  }
  return all;
}

std::uint64_t bytesOf(const std::vector<Binary>& all) {
  std::uint64_t bytes = 0;
  for (const Binary& binary : all) bytes += binary.bytes;
  return bytes;
}

}  // namespace

BinaryFolderUse pruneBinaries(const std::string& folder, std::uint64_t most) {
  std::vector<Binary> all = listBinaries(folder);
  BinaryFolderUse use{.bytes = bytesOf(all)};
  if (use.bytes <= most) return use;
  // Only now is it looked into them.
  std::erase_if(all, [](const Binary& binary) { return !hasMagic(binary.path); });
  use.bytes = bytesOf(all);
  if (use.bytes <= most) return use;
  std::sort(all.begin(), all.end(), [](const Binary& a, const Binary& b) {
    return a.used != b.used ? a.used < b.used : a.path < b.path;
  });
  for (const Binary& binary : all) {
    if (use.bytes <= most - most / 8) break;
    std::error_code ec;
    const bool removed = fs::remove(binary.path, ec);
    if (ec) continue;  // it may not be removed
    use.bytes -= binary.bytes;
    use.removed += removed ? 1 : 0;
  }
  return use;
}

void touchBinary(const std::string& path) {
  ::utimensat(AT_FDCWD, path.c_str(), nullptr, 0);
}

}  // namespace weft::gl
