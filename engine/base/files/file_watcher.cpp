#include "engine/base/files/file_watcher.h"

#include <fmt/format.h>
#include <sys/inotify.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>

namespace weft::base {

namespace fs = std::filesystem;

namespace {

// IN_CREATE: links and folders; a file that is made and written ends with IN_CLOSE_WRITE.
constexpr std::uint32_t kEvents = IN_CLOSE_WRITE | IN_MOVED_TO | IN_CREATE | IN_DELETE | IN_MOVED_FROM |
                                  IN_DELETE_SELF | IN_MOVE_SELF | IN_ONLYDIR;

std::string watchedPath(const std::string& path) {
  std::error_code ec;
  const fs::path absolute = fs::absolute(path, ec);
  return (ec ? fs::path(path) : absolute).lexically_normal().string();
}

bool holdsSomething(const std::string& path) {
  std::error_code ec;
  return fs::is_regular_file(path, ec) && fs::file_size(path, ec) > 0 && !ec;
}

// File systems that other machines or programs write to behind the kernel's back (linux/magic.h and their
// sources); "" for all others.
const char* networkOf(const std::string& file) {
  struct statfs status {};
  fs::path at = file;
  while (::statfs(at.c_str(), &status) != 0) {
    if (at == at.parent_path()) return "";
    at = at.parent_path();
  }
  switch (static_cast<std::uint32_t>(status.f_type)) {
    case 0x6969:
      return "NFS";
    case 0x517B:
    case 0xFF534D42:
    case 0xFE534D42:
      return "CIFS";
    case 0x65735546:
      return "FUSE";
    case 0x01021997:
      return "9P";
    case 0x5346414F:
    case 0x6B414653:
      return "AFS";
    case 0x00C36400:
      return "Ceph";
    default:
      return "";
  }
}

}  // namespace

FileWatcher::FileWatcher(Means means) {
  if (means == Means::inotify) descriptor_ = ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
  if (descriptor_ < 0) error_ = means == Means::inotify ? errno : EMFILE;
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
  std::map<Reason, std::vector<std::string>> looked;
  for (const std::string& file : files_) {
    const std::string absolute = watchedPath(file);
    Reason reason = armFile(absolute, file);
    std::error_code ec;
    if (const fs::path real = fs::canonical(absolute, ec); !ec && real.string() != absolute) {
      const Reason behind = armFile(real.string(), file);
      if (reason == Reason::told) reason = behind;
    }
    if (reason == Reason::told && *networkOf(absolute)) reason = Reason::network;
    if (reason != Reason::told) looked[reason].push_back(file);
  }
  std::vector<std::string> all;
  for (const auto& [reason, files] : looked) {
    all.insert(all.end(), files.begin(), files.end());
    tell(reason, files);
  }
  poller_.watch(all);
  for (const auto& [watch, names] : before)
    if (!folders_.contains(watch)) ::inotify_rm_watch(descriptor_, watch);
}

FileWatcher::Reason FileWatcher::armFile(const std::string& absolute, const std::string& given) {
  if (descriptor_ < 0) return Reason::no_instance;
  watched_[absolute].insert(given);
  fs::path folder = fs::path(absolute).parent_path();
  for (;;) {
    const int watch = ::inotify_add_watch(descriptor_, folder.c_str(), kEvents);
    if (watch >= 0) {
      folders_[watch].insert(folder.string());
      return Reason::told;
    }
    if (errno == ENOSPC || errno == ENOMEM) return Reason::no_watch;
    if (errno == EACCES) return Reason::unreadable;
    if (folder == folder.parent_path()) return Reason::unreadable;
    awaited_.insert(folder.string());
    folder = folder.parent_path();
  }
}

void FileWatcher::tell(Reason reason, const std::vector<std::string>& files) {
  if (!toldReasons_.insert(reason).second) return;
  const std::string& first = files.front();
  Diagnostic d{.severity = Severity::note,
               .code = Code::filesArePolled,
               .message = fmt::format("{} looked at twice a second instead of being told of changes",
                                      files.size() == 1
                                          ? fmt::format("'{}' is", first)
                                          : fmt::format("'{}' and {} more {} are", first, files.size() - 1,
                                                        files.size() == 2 ? "file" : "files")),
               .place = {std::make_shared<const std::string>(first)}};
  switch (reason) {
    case Reason::told:
      return;
    case Reason::no_instance:
      d.found = fmt::format("no inotify instance: {}", std::strerror(error_));
      d.hint = "end other programs that watch files, or raise fs.inotify.max_user_instances with sysctl";
      break;
    case Reason::no_watch:
      d.found = "no inotify watch is left for its folder";
      d.hint = "end other programs that watch files, or raise fs.inotify.max_user_watches with sysctl";
      break;
    case Reason::unreadable:
      d.found = "its folder may not be read, so inotify may not watch it";
      d.hint = "give yourself the right to read the folder";
      break;
    case Reason::network:
      d.found = fmt::format("it lies on a mount ({}) that others write to without inotify's knowledge",
                            networkOf(watchedPath(first)));
      break;
  }
  notices_.add(std::move(d));
}

Diagnostics FileWatcher::takeNotices() {
  return std::exchange(notices_, {});
}

void FileWatcher::note(const std::string& path, bool created) {
  const auto found = watched_.find(path);
  if (found == watched_.end() || (created && !holdsSomething(path))) return;
  changed_.insert(found->second.begin(), found->second.end());
}

std::vector<std::string> FileWatcher::poll() {
  changed_.merge(poller_.take());
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
