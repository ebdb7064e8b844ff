#include "engine/base/files/file_access.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

namespace weft::base {

namespace fs = std::filesystem;

namespace {

using State = OpenedFile::State;

constexpr int kMostLinks = 40;  // on one path; as Linux

struct Access {
  std::mutex mutex;
  bool confined = false;
  std::vector<std::string> named;    // as the person wrote them
  std::vector<std::string> folders;  // real paths
  std::vector<std::string> own;      // of allowFolder(), absolute
  std::vector<std::pair<std::string, std::string>>
      spelled;                        // a folder as written, and its real path, where they differ
  std::map<std::string, int> chosen;  // by absolute path: how often it may be a pipe
};

Access& access() {
  static Access all;
  return all;
}

// A descriptor of a folder, for a while.
class Folder {
 public:
  Folder() = default;
  explicit Folder(int descriptor) : descriptor_(descriptor) {}
  Folder(Folder&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  Folder& operator=(Folder&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~Folder() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  int get() const { return descriptor_; }

 private:
  int descriptor_ = -1;
};

std::string absoluteOf(const std::string& path) {
  std::error_code ec;
  const fs::path absolute = fs::absolute(path, ec);
  std::string text = (ec ? fs::path(path) : absolute).lexically_normal().string();
  while (text.size() > 1 && text.back() == '/') text.pop_back();
  return text;
}

std::string realOf(const std::string& path) {
  std::error_code ec;
  const fs::path real = fs::weakly_canonical(path, ec);
  return ec ? path : absoluteOf(real.string());
}

// `path` is `folder` or below it.
bool isBelow(const std::string& path, const std::string& folder) {
  if (folder == "/" || path == folder) return true;
  return path.size() > folder.size() && path.starts_with(folder) && path[folder.size()] == '/';
}

void addSpelling(Access& all, const std::string& written, const std::string& real) {
  if (written != real && std::ranges::find(all.spelled, std::pair(written, real)) == all.spelled.end())
    all.spelled.emplace_back(written, real);
}

void addFolder(Access& all, const std::string& folder) {
  const std::string written = absoluteOf(folder), real = realOf(written);
  if (std::ranges::find(all.folders, real) == all.folders.end()) all.folders.push_back(real);
  addSpelling(all, written, real);
}

// Where a path leads: the folder that holds it and its name there, all links followed.
struct Walk {
  State state = State::open;
  Folder folder{};
  std::string name{};
  int error = 0;
};

class Walker {
 public:
  explicit Walker(const Access& all) : all_(all) { enterRoot(); }

  Walk walk(const std::string& path) {
    push(withRealFolder(absoluteOf(path)));
    int links = 0;
    while (!ahead_.empty()) {
      const std::string step = std::move(ahead_.back());
      ahead_.pop_back();
      if (step == "..") {
        if (folders_.size() > 1) folders_.pop_back(), at_.resize(at_.rfind('/'));
        continue;
      }
      const std::string next = at_ + "/" + step;
      const bool last = ahead_.empty();
      if (!isInside(next) && !isAbove(next)) return {.state = State::outside};
      struct stat status {};
      if (::fstatat(folders_.back().get(), step.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0)
        return failure(errno);
      if (S_ISLNK(status.st_mode)) {
        if (++links > kMostLinks) return failure(ELOOP);
        if (const int error = follow(step)) return failure(error);
        continue;
      }
      if (last) {
        if (!isInside(next)) return {.state = State::outside};
        return {.state = State::open, .folder = std::move(folders_.back()), .name = step};
      }
      Folder below(
          ::openat(folders_.back().get(), step.c_str(), O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
      if (below.get() < 0) return failure(errno);
      folders_.push_back(std::move(below));
      at_ = next;
    }
    if (!isInside(at_)) return {.state = State::outside};
    return {.state = State::open, .folder = std::move(folders_.back()), .name = "."};
  }

 private:
  static Walk failure(int error) {
    const bool missing = error == ENOENT || error == ENOTDIR;
    return {.state = missing ? State::missing : State::unreadable, .error = error};
  }

  bool isInside(const std::string& path) const {
    return std::ranges::any_of(all_.folders,
                               [&](const std::string& folder) { return isBelow(path, folder); });
  }
  // On the way to a folder: that it exists is no secret.
  bool isAbove(const std::string& path) const {
    return std::ranges::any_of(all_.folders,
                               [&](const std::string& folder) { return isBelow(folder, path); });
  }

  void enterRoot() {
    folders_.clear();
    folders_.emplace_back(::open("/", O_PATH | O_DIRECTORY | O_CLOEXEC));
    at_.clear();
  }

  void push(const std::string& path) {
    std::vector<std::string> steps;
    for (const fs::path& each : fs::path(path).relative_path())
      if (!each.empty() && each != ".") steps.push_back(each.string());
    ahead_.insert(ahead_.end(), steps.rbegin(), steps.rend());
  }

  // 0, or the error.
  int follow(const std::string& link) {
    std::array<char, 4096> target;
    const ssize_t length = ::readlinkat(folders_.back().get(), link.c_str(), target.data(), target.size());
    if (length < 0) return errno;
    const std::string to(target.data(), static_cast<std::size_t>(length));
    if (to.starts_with('/')) enterRoot();
    push(to);
    return 0;
  }

  // The way to a folder that the person spelled by links is no way out of it.
  std::string withRealFolder(const std::string& path) const {
    std::string best = path;
    std::size_t longest = 0;
    for (const auto& [written, real] : all_.spelled)
      if (written.size() >= longest && isBelow(path, written)) {
        longest = written.size();
        best = real + path.substr(written.size());
      }
    return best;
  }

  const Access& all_;
  std::vector<Folder> folders_;     // from the root to where the walk stands
  std::string at_;                  // its real path; "" is the root
  std::vector<std::string> ahead_;  // steps to go, the next one last
};

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
  const std::string folder = absoluteOf(fs::path(written).parent_path().string());
  addSpelling(all, folder, realOf(folder));
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
  if (!all.confined || all.chosen.contains(absoluteOf(path))) return true;
  return Walker(all).walk(path).state != State::outside;
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
  all.spelled.clear();
  all.chosen.clear();
}

OpenedFile openFile(const std::string& path) {
  int folder = AT_FDCWD, follow = 0, noFollow = 0;
  std::string name = path;
  bool mayBePipe = false, wasChosen = false;
  Walk walk;
  {
    Access& all = access();
    const std::lock_guard lock(all.mutex);
    const auto chosen = all.chosen.find(absoluteOf(path));
    wasChosen = chosen != all.chosen.end();
    mayBePipe = wasChosen && chosen->second > 0;
    if (mayBePipe) --chosen->second;
    if (all.confined && !wasChosen) {
      walk = Walker(all).walk(path);
      if (walk.state != State::open) return {.state = walk.state, .error = walk.error};
      folder = walk.folder.get();
      name = walk.name;
      follow = AT_SYMLINK_NOFOLLOW;
      noFollow = O_NOFOLLOW;
    }
  }
  const auto failure = [](int error) {
    return OpenedFile{.state = error == ENOENT || error == ENOTDIR ? State::missing : State::unreadable,
                      .error = error};
  };
  // Looked at before it is opened: opening a device can do something by itself.
  struct stat status {};
  if (::fstatat(folder, name.c_str(), &status, follow) != 0) return failure(errno);
  if (const State state = judge(status.st_mode, mayBePipe, wasChosen); state != State::open)
    return {.state = state};
  const int descriptor =
      ::openat(folder, name.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC | noFollow);
  if (descriptor < 0) return failure(errno);
  // And again: it may have been replaced in between.
  State state = State::unreadable;
  if (::fstat(descriptor, &status) == 0) state = judge(status.st_mode, mayBePipe, wasChosen);
  if (state != State::open) {
    ::close(descriptor);
    return {.state = state};
  }
  const bool regular = S_ISREG(status.st_mode);
  return {.state = state,
          .descriptor = descriptor,
          .endless = !regular,
          .bytes = regular ? static_cast<std::uint64_t>(status.st_size) : 0};
}

}  // namespace weft::base
