#include "engine/imports/files.h"

namespace weft::imports {

std::shared_ptr<const void> Files::getAny(
    const std::string& path, std::type_index type,
    const std::function<std::shared_ptr<const void>(text::Diagnostics&)>& read,
    text::Diagnostics& diagnostics) {
  touched_.insert(path);
  std::error_code ec;
  Stamp stamp{std::filesystem::last_write_time(path, ec), 0};
  if (ec) stamp = {};
  if (const auto size = std::filesystem::file_size(path, ec); !ec) stamp.second = size;
  const auto [found, fresh] = entries_.try_emplace({path, type});
  Entry& entry = found->second;
  if (fresh || entry.stamp != stamp) {
    entry = {.stamp = stamp, .made = nullptr, .said = {}};
    entry.made = read(entry.said);
  }
  diagnostics.append(entry.said);
  return entry.made;
}

}  // namespace weft::imports
