#include "engine/base/files/file_poller.h"

#include <sys/stat.h>

#include <utility>

namespace weft::base {

FilePoller::Stamp FilePoller::stampOf(const std::string& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return {};
  return {status.st_dev, status.st_ino, static_cast<std::uint64_t>(status.st_size), status.st_mtim.tv_sec,
          status.st_mtim.tv_nsec};
}

void FilePoller::watch(const std::vector<std::string>& files) {
  std::map<std::string, Known> wanted;
  {
    const std::lock_guard lock(mutex_);
    for (const std::string& file : files)
      if (const auto known = files_.find(file); known != files_.end()) wanted.insert(*known);
  }
  for (const std::string& file : files)
    if (!wanted.contains(file)) wanted[file] = {.stamp = stampOf(file), .emptied = false};
  const std::lock_guard lock(mutex_);
  files_ = std::move(wanted);
  std::erase_if(changed_, [&](const std::string& file) { return !files_.contains(file); });
}

bool FilePoller::empty() const {
  const std::lock_guard lock(mutex_);
  return files_.empty();
}

bool FilePoller::look() {
  std::vector<std::string> names;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [file, known] : files_) names.push_back(file);
  }
  bool any = false;
  for (const std::string& file : names) {
    const Stamp now = stampOf(file);  // without the lock
    const std::lock_guard lock(mutex_);
    const auto found = files_.find(file);
    if (found == files_.end() || found->second.stamp == now) continue;
    Known& known = found->second;
    const bool isEmpty = now.seconds >= 0 && now.bytes == 0;
    if (isEmpty && !std::exchange(known.emptied, true)) continue;
    known = {.stamp = now, .emptied = false};
    changed_.insert(file);
    any = true;
  }
  return any;
}

std::set<std::string> FilePoller::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(changed_, {});
}

}  // namespace weft::base
