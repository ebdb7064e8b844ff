#include "engine/base/files/temporary_name.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>

namespace weft::base {

std::string temporaryBeside(const std::string& path) {
  constexpr std::size_t kLongest = 255;  // bytes, of most file systems
  static std::atomic<unsigned> made = 0;
  const std::filesystem::path beside = fmt::format("{}.{}.tmp", path, ::getpid());
  if (beside.filename().string().size() <= kLongest) return beside.string();
  return (beside.parent_path() / fmt::format(".weft.{}.{}.tmp", ::getpid(), ++made)).string();
}

}  // namespace weft::base
