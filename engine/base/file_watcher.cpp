#include "engine/base/file_watcher.h"

#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

namespace weft::base {

namespace fs = std::filesystem;

namespace {

// IN_CREATE: links and folders; a file that is made and written ends with IN_CLOSE_WRITE.
constexpr std::uint32_t kEvents = IN_CLOSE_WRITE | IN_MOVED_TO | IN_CREATE | IN_DELETE | IN_MOVED_FROM |
                                  IN_DELETE_SELF | IN_MOVE_SELF | IN_ONLYDIR;

std::string absoluteOf(const std::string& path) {
  std::error_code ec;
  const fs::path absolute = fs::absolute(path, ec);
  return (ec ? fs::path(path) : absolute).lexically_normal().string();
}

bool holdsSomething(const std::string& path) {
  std::error_code ec;
  return fs::is_regular_file(path, ec) && fs::file_size(path, ec) > 0 && !ec;
}

}  // namespace

FileWatcher::FileWatcher() : descriptor_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {}

FileWatcher::~FileWatcher() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void FileWatcher::watch(const std::vector<std::string>& files) {
  std::vector<std::string> sorted = files;
  std::ranges::sort(sorted);
  const auto twice = std::ranges::unique(sorted);
  sorted.erase(twice.begin(), twice.end());
  if (sorted == files_) return;
  for (std::string& name : poll()) changed_.insert(std::move(name));
  files_ = std::move(sorted);
  std::erase_if(changed_, [&](const std::string& name) { return !std::ranges::binary_search(files_, name); });
  arm();
}

void FileWatcher::arm() {
  if (descriptor_ < 0) return;
  const auto before = std::move(folders_);
  folders_.clear();
  watched_.clear();
  awaited_.clear();
  for (const std::string& file : files_) {
    const std::string absolute = absoluteOf(file);
    armFile(absolute, file);
    std::error_code ec;
    if (const fs::path real = fs::canonical(absolute, ec); !ec && real.string() != absolute)
      armFile(real.string(), file);
  }
  for (const auto& [watch, names] : before)
    if (!folders_.contains(watch)) ::inotify_rm_watch(descriptor_, watch);
}

void FileWatcher::armFile(const std::string& absolute, const std::string& given) {
  watched_[absolute].insert(given);
  fs::path folder = fs::path(absolute).parent_path();
  for (;;) {
    const int watch = ::inotify_add_watch(descriptor_, folder.c_str(), kEvents);
    if (watch >= 0) {
      folders_[watch].insert(folder.string());
      return;
    }
    if (folder == folder.parent_path()) return;
    awaited_.insert(folder.string());
    folder = folder.parent_path();
  }
}

void FileWatcher::note(const std::string& path, bool created) {
  const auto found = watched_.find(path);
  if (found == watched_.end() || (created && !holdsSomething(path))) return;
  changed_.insert(found->second.begin(), found->second.end());
}

std::vector<std::string> FileWatcher::poll() {
  if (descriptor_ < 0) return {};
  alignas(inotify_event) char bytes[16384];
  bool again = false;
  for (ssize_t got = 0; (got = ::read(descriptor_, bytes, sizeof bytes)) > 0;) {
    for (const char* at = bytes; at < bytes + got;) {
      inotify_event event;
      std::memcpy(&event, at, sizeof event);
      const char* name = at + sizeof event;
      at += sizeof event + event.len;
      if (event.mask & IN_Q_OVERFLOW) {
        changed_.insert(files_.begin(), files_.end());
        continue;
      }
      const auto folder = folders_.find(event.wd);
      if (folder == folders_.end()) continue;  // of a watch that was given up
      if (event.mask & (IN_DELETE_SELF | IN_MOVE_SELF | IN_IGNORED)) again = true;
      if (event.len == 0) continue;
      for (const std::string& each : folder->second) {
        const std::string path = (fs::path(each) / name).string();
        again |= awaited_.contains(path);
        note(path, (event.mask & IN_CREATE) != 0);
      }
    }
  }
  // A folder appeared or went away. What already stands in a new one was made before it could be watched.
  if (again) {
    const std::set<std::string> missing = std::move(awaited_);
    arm();
    for (const auto& [path, names] : watched_)
      if (missing.contains(fs::path(path).parent_path().string()) && holdsSomething(path))
        changed_.insert(names.begin(), names.end());
  }
  std::vector<std::string> out(changed_.begin(), changed_.end());
  changed_.clear();
  return out;
}

}  // namespace weft::base
