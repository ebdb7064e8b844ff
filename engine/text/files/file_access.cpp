#include "engine/text/files/file_access.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <map>
#include <mutex>
#include <vector>

namespace weft::text {

namespace fs = std::filesystem;

namespace {

using State = OpenedFile::State;

constexpr int kMaxLinks = 40;  // on one path; as Linux

struct Access {
  std::mutex mutex;
  bool confined = false;
  std::vector<std::string> named;     // as the person wrote them
  std::vector<std::string> folders;   // real paths
  std::vector<std::string> own;       // of allowFolder(), absolute
  std::map<std::string, int> chosen;  // by absolute path: how often it may be a pipe
};

Access& access() {
  static Access all;
  return all;
}

std::string absoluteOf(const std::string& path) {
  std::error_code ec;
  const fs::path absolute = fs::absolute(path, ec);
  std::string text = (ec ? fs::path(path) : absolute).lexically_normal().string();
  while (text.size() > 1 && text.back() == '/') text.pop_back();
  return text;
}

// Where an absolute path leads, all links followed, whether or not something is there.
std::string realOf(const fs::path& path, int links = 0) {
  std::error_code ec;
  if (fs::path real = fs::canonical(path, ec); !ec) return real.string();
  if (fs::is_symlink(fs::symlink_status(path, ec)) && links < kMaxLinks)
    return realOf(path.parent_path() / fs::read_symlink(path, ec), links + 1);
  if (path == path.parent_path()) return path.string();
  return (fs::path(realOf(path.parent_path(), links)) / path.filename()).lexically_normal().string();
}

// `path` is `folder` or below it.
bool isBelow(const std::string& path, const std::string& folder) {
  if (folder == "/" || path == folder) return true;
  return path.size() > folder.size() && path.starts_with(folder) && path[folder.size()] == '/';
}

void addFolder(Access& all, const std::string& folder) {
  std::string real = realOf(absoluteOf(folder));
  if (std::ranges::find(all.folders, real) == all.folders.end()) all.folders.push_back(std::move(real));
}

bool isInside(const Access& all, const std::string& real) {
  return std::ranges::any_of(all.folders, [&](const std::string& folder) { return isBelow(real, folder); });
}

// Whether no link on the way of an absolute path below a folder lies outside of the folders: not even that one leads back in is told.
bool staysInside(const Access& all, const fs::path& path, int& links) {
  if (std::ranges::find(all.folders, realOf(path)) != all.folders.end()) return true;
  if (path == path.parent_path() || !staysInside(all, path.parent_path(), links)) return false;
  std::error_code ec;
  const fs::path parent = realOf(path.parent_path()), here = parent / path.filename();
  if (!fs::is_symlink(fs::symlink_status(here, ec))) return true;
  return ++links > kMaxLinks ||  // it cannot be opened
         staysInside(all, (parent / fs::read_symlink(here, ec)).lexically_normal(), links);
}

bool isInside(const Access& all, const std::string& absolute, const std::string& real) {
  int links = 0;
  return isInside(all, real) && staysInside(all, absolute, links);
}

State judge(mode_t mode, bool mayBePipe, bool wasChosen) {
  if (S_ISREG(mode)) return State::open;
  if (S_ISDIR(mode)) return State::directory;
  if (S_ISFIFO(mode)) return mayBePipe ? State::open : wasChosen ? State::pipe_again : State::pipe;
  return S_ISSOCK(mode) ? State::socket : State::device;
}

}  // namespace

void chooseFile(const std::string& path) {
  if (path.empty()) return;
  Access& all = access();
  const std::lock_guard lock(all.mutex);
  const std::string written = absoluteOf(path);
  ++all.chosen[written];
  std::error_code ec;
  if (fs::is_directory(written, ec)) addFolder(all, written);
}

std::optional<std::string> confineTo(const std::string& folder) {
  std::error_code ec;
  if (!fs::is_directory(folder, ec))
    return fmt::format("expected a folder, found '{}', which is none", folder);
  Access& all = access();
  const std::lock_guard lock(all.mutex);
  all.confined = true;
  all.named.push_back(folder);
  addFolder(all, folder);
  return std::nullopt;
}

void allowFolder(const std::string& folder) {
  if (folder.empty()) return;
  Access& all = access();
  const std::lock_guard lock(all.mutex);
  addFolder(all, folder);
  all.own.push_back(absoluteOf(folder));
}

bool isOwnData(const std::string& path) {
  Access& all = access();
  const std::lock_guard lock(all.mutex);
  const std::string absolute = absoluteOf(path);
  return !all.chosen.contains(absolute) &&
         std::ranges::any_of(all.own, [&](const std::string& folder) { return isBelow(absolute, folder); });
}

bool mayRead(const std::string& path) {
  Access& all = access();
  const std::lock_guard lock(all.mutex);
  if (!all.confined) return true;
  const std::string absolute = absoluteOf(path);
  return all.chosen.contains(absolute) || isInside(all, absolute, realOf(absolute));
}

void reportOutside(const std::string& path, Diagnostics& diagnostics, const Place& place) {
  std::vector<std::string> folders;
  {
    Access& all = access();
    const std::lock_guard lock(all.mutex);
    for (const std::string& each : all.named) folders.push_back(fmt::format("'{}'", each));
  }
  Place where = place;
  if (!isKnown(where)) where.file = std::make_shared<const std::string>(path);
  Diagnostic& d =
      diagnostics.error(Code::outsideConfinement, where,
                        fmt::format("'{}' leads out of the folders that this run is confined to", path));
  d.expected = fmt::format("a path that stays, with links followed, in {} or in Weft's own data",
                           fmt::join(folders, ", "));
  d.hint = "move the file into one of them, or allow its folder with --confine FOLDER";
}

void resetFileAccess() {
  Access& all = access();
  const std::lock_guard lock(all.mutex);
  all.confined = false;
  all.named.clear();
  all.folders.clear();
  all.own.clear();
  all.chosen.clear();
}

OpenedFile openFile(const std::string& path) {
  bool mayBePipe = false, wasChosen = false, free = true;
  const std::string absolute = absoluteOf(path);
  Access& all = access();
  {
    const std::lock_guard lock(all.mutex);
    const auto chosen = all.chosen.find(absolute);
    wasChosen = chosen != all.chosen.end();
    mayBePipe = wasChosen && chosen->second > 0;
    if (mayBePipe) --chosen->second;
    free = !all.confined || wasChosen;
  }
  // Looked at before it is opened: opening a device can do something by itself. A handle reads nothing and does nothing.
  const int handle = path.empty() ? -1 : ::open(free ? path.c_str() : absolute.c_str(), O_PATH | O_CLOEXEC);
  int error = handle < 0 ? path.empty() ? ENOENT : errno : 0;
  const std::string behind = fmt::format("/proc/self/fd/{}", handle);
  const auto done = [&](OpenedFile opened) {
    if (handle >= 0) ::close(handle);
    return opened;
  };
  if (!free) {
    std::error_code ec;
    const std::string real = handle < 0 ? realOf(absolute) : fs::read_symlink(behind, ec).string();
    const std::lock_guard lock(all.mutex);
    if (!isInside(all, absolute, real)) return done({.state = State::outside});
  }
  const auto failure = [&] {
    const bool missing = error == ENOENT || error == ENOTDIR;
    return done({.state = missing ? State::missing : State::unreadable, .error = error});
  };
  if (error != 0) return failure();
  struct stat status {};
  State state =
      ::fstat(handle, &status) == 0 ? judge(status.st_mode, mayBePipe, wasChosen) : State::unreadable;
  if (state != State::open) return done({.state = state});
  // What was looked at is what is opened, whatever has the name by now.
  const int descriptor = ::open(behind.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (descriptor < 0) error = errno;
  if (error != 0) return failure();
  const bool regular = S_ISREG(status.st_mode);
  return done({.state = state,
               .descriptor = descriptor,
               .endless = !regular,
               .bytes = regular ? static_cast<std::uint64_t>(status.st_size) : 0});
}

}  // namespace weft::text
