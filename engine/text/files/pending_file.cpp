#include "engine/text/files/pending_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "engine/text/hash.h"

namespace weft::text {

namespace fs = std::filesystem;

namespace {

// Also where the name is as long as a name may be.
std::string nameBeside(const fs::path& target) {
  constexpr std::size_t kLongest = 255;  // bytes, of most file systems
  const std::string name = target.filename().string(), beside = "." + name + ".part";
  return (target.parent_path() /
          (beside.size() <= kLongest ? beside : fmt::format(".weft.{:016x}.part", hashBytes(name))))
      .string();
}

// Of a process among those of all machines that have the folder.
std::string processName() {
  char host[256] = {};
  ::gethostname(host, sizeof host - 1);
  return fmt::format("{}.{}", host, ::getpid());
}

}  // namespace

PendingFile::PendingFile(const std::string& path, bool wait) {
  std::error_code ec;
  const fs::path real = fs::canonical(path, ec);
  target_ = ec ? path : real.string();
  struct stat before {};
  const bool isThere = ::stat(target_.c_str(), &before) == 0;
  if (isThere && S_ISDIR(before.st_mode)) {
    error_ = EISDIR;
    return;
  }
  special_ = isThere && !S_ISREG(before.st_mode);
  if (isThere) mode_ = before.st_mode & 07777;
  name_ = special_ ? target_ : nameBeside(target_);
  if (special_) {
    descriptor_ = ::open(name_.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
    if (descriptor_ < 0) error_ = errno;
  } else {
    open(wait);
  }
}

// Whoever has the lock of an empty file that still has the name writes it. Bytes in it are those of a process that was killed.
void PendingFile::open(bool wait) {
  constexpr int kTries = 1000;
  bool lockable = true;  // else the name is of this process alone
  for (int tries = 0; tries < kTries; ++tries) {
    descriptor_ =
        ::open(name_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC, 0666);
    error_ = descriptor_ < 0 ? errno : 0;
    if ((error_ == ELOOP || error_ == EACCES) && ::unlink(name_.c_str()) == 0) continue;  // a stranger's
    if (error_ != 0) return;
    int locked = 0;
    while (lockable && (locked = ::flock(descriptor_, LOCK_EX | (wait ? 0 : LOCK_NB))) != 0 &&
           errno == EINTR) {
    }
    if (locked != 0) error_ = errno;
    struct stat opened {
    }, there{};
    const bool same = ::fstat(descriptor_, &opened) == 0 && ::lstat(name_.c_str(), &there) == 0 &&
                      opened.st_dev == there.st_dev && opened.st_ino == there.st_ino;
    if (locked == 0 && same && S_ISREG(opened.st_mode) && opened.st_size == 0) return;
    ::close(std::exchange(descriptor_, -1));
    if (error_ == EWOULDBLOCK) return;
    if (same) ::unlink(name_.c_str());
    if (locked != 0) name_ = nameBeside(target_ + "." + processName());
    lockable = locked == 0 && lockable;
  }
  error_ = EBUSY;
}

PendingFile::~PendingFile() {
  if (descriptor_ < 0) return;
  if (!special_) ::unlink(name_.c_str());
  ::close(descriptor_);
}

bool PendingFile::write(std::span<const char> bytes) {
  while (error_ == 0 && !bytes.empty()) {
    const ssize_t got = ::write(descriptor_, bytes.data(), bytes.size());
    if (got >= 0)
      bytes = bytes.subspan(static_cast<std::size_t>(got));
    else if (errno != EINTR)
      error_ = errno;
  }
  return error_ == 0;
}

bool PendingFile::putInPlace() {
  if (error_ != 0) return false;
  if (!special_ && mode_ != 0) ::fchmod(descriptor_, mode_);
  // A network file system tells here what it could not write; the lock stays.
  const bool good =
      ::close(::dup(descriptor_)) == 0 && (special_ || std::rename(name_.c_str(), target_.c_str()) == 0);
  if (!good) error_ = errno;
  if (!good) return false;
  ::close(descriptor_);
  descriptor_ = -1;
  return true;
}

}  // namespace weft::text
