#include "engine/base/files/folder_names.h"

#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <tuple>

namespace weft::base {

namespace {

constexpr std::size_t kMostNames = 5000, kMostFolders = 64;

// What tells a folder from another, or from itself after a change.
using Stamp = std::tuple<std::uint64_t, std::uint64_t, std::int64_t, std::int64_t>;

struct Known {
  Stamp stamp;
  std::shared_ptr<const std::vector<std::string>> names;
};

}  // namespace

std::shared_ptr<const std::vector<std::string>> namesIn(const std::string& folder) {
  static std::mutex mutex;
  static std::map<std::string, Known> known;
  static const auto kNone = std::make_shared<const std::vector<std::string>>();
  struct stat status {};
  if (::stat(folder.c_str(), &status) != 0) return kNone;
  const Stamp stamp{status.st_dev, status.st_ino, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
  const std::lock_guard lock(mutex);
  if (const auto found = known.find(folder); found != known.end() && found->second.stamp == stamp)
    return found->second.names;
  std::vector<std::string> names;
  std::error_code ec;
  for (auto entry = std::filesystem::directory_iterator(folder, ec);
       !ec && entry != std::filesystem::directory_iterator() && names.size() < kMostNames;
       entry.increment(ec))
    names.push_back(entry->path().filename().string());
  std::ranges::sort(names);
  if (known.size() >= kMostFolders) known.clear();
  auto made = std::make_shared<const std::vector<std::string>>(std::move(names));
  known[folder] = {stamp, made};
  return made;
}

}  // namespace weft::base
