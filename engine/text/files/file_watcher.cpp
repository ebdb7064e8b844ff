#include "engine/text/files/file_watcher.h"

#include <fmt/format.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "engine/text/files/file.h"
#include "text_sentences.h"

namespace weft::text {

namespace fs = std::filesystem;

namespace {

// IN_CREATE: links and folders; a file that is made and written ends with IN_CLOSE_WRITE.
constexpr std::uint32_t kEvents = IN_CLOSE_WRITE | IN_MOVED_TO | IN_CREATE | IN_DELETE | IN_MOVED_FROM |
                                  IN_DELETE_SELF | IN_MOVE_SELF | IN_ONLYDIR;

bool holdsSomething(const std::string& path) {
  std::error_code ec;
  return fs::is_directory(path, ec) || (fs::is_regular_file(path, ec) && fs::file_size(path, ec) > 0 && !ec);
}

}  // namespace

FileWatcher::FileWatcher() : descriptor_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
  if (descriptor_ < 0) error_ = errno;
}

FileWatcher::~FileWatcher() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void FileWatcher::watch(std::vector<std::string> files) {
  std::ranges::sort(files);
  const auto twice = std::ranges::unique(files);
  files.erase(twice.begin(), twice.end());
  if (files == files_) return;
  for (std::string& name : poll()) changed_.insert(std::move(name));
  files_ = std::move(files);
  std::erase_if(changed_, [&](const std::string& name) { return !std::ranges::binary_search(files_, name); });
  arm();
}

void FileWatcher::arm() {
  const auto before = std::move(folders_);
  folders_.clear();
  watched_.clear();
  awaited_.clear();
  for (const std::string& file : files_) {
    const std::string absolute = absolutePath(file);
    armFile(absolute, file);
    std::error_code ec;
    if (const fs::path real = fs::canonical(absolute, ec); !ec && real.string() != absolute)
      armFile(real.string(), file);
  }
  for (const auto& [watch, names] : before)
    if (!folders_.contains(watch)) ::inotify_rm_watch(descriptor_, watch);
}

void FileWatcher::armFile(const std::string& absolute, const std::string& given) {
  if (descriptor_ < 0) return tell(error_, given);
  watched_[absolute].insert(given);
  fs::path folder = fs::path(absolute).parent_path();
  for (;;) {
    const int watch = ::inotify_add_watch(descriptor_, folder.c_str(), kEvents);
    if (watch >= 0) {
      folders_[watch].insert(folder.string());
      return;
    }
    const bool missing = errno == ENOENT || errno == ENOTDIR;
    if (!missing || folder == folder.parent_path()) return tell(errno, given);
    awaited_.insert(folder.string());
    folder = folder.parent_path();
  }
}

void FileWatcher::tell(int error, const std::string& file) {
  if (std::exchange(told_, true)) return;
  notices_.note(say::changesNotSeen, {file}, file, std::strerror(error));
}

std::vector<std::string> FileWatcher::poll() {
  alignas(inotify_event) char bytes[16384];
  bool again = false;
  for (ssize_t got = 0; descriptor_ >= 0 && (got = ::read(descriptor_, bytes, sizeof bytes)) > 0;) {
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
        const auto found = watched_.find(path);
        if (found != watched_.end() && (!(event.mask & IN_CREATE) || holdsSomething(path)))
          changed_.insert(found->second.begin(), found->second.end());
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

}  // namespace weft::text
