#include "engine/text/files/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <utility>
#include <vector>

#include "data_places.h"
#include "engine/text/chars.h"
#include "engine/text/files/pending_file.h"
#include "engine/text/limits.h"
#include "engine/text/nearest.h"
#include "text_sentences.h"

namespace weft::text {

namespace fs = std::filesystem;

namespace {

constexpr int kMaxLinks = 40;  // on one path; as Linux

// A pipe may be read, an endless one must not fill the memory.
constexpr std::size_t kMaxBytes = std::size_t{4} << 30;

struct Access {
  bool confined = false;
  std::vector<std::string> named;      // as the person wrote them
  std::vector<std::string> folders;    // real paths
  std::map<std::string, bool> chosen;  // by absolute path: whether it may be a pipe, as it was not opened yet
  std::set<std::string> read;          // absolute paths
  std::map<std::string, Overlay> overlays;
  std::uint64_t overlaid = 0;  // in the life of the process
};

// The rules of the process, while one thread has them.
class Rules {
 public:
  Rules() : lock_(mutex_) {}
  Access& operator*() { return all_; }
  Access* operator->() { return &all_; }

 private:
  inline static std::mutex mutex_;
  inline static Access all_;
  const std::lock_guard<std::mutex> lock_;
};

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
  std::string real = realOf(absolutePath(folder));
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

// The folder that is not there, or the file of the nearest name.
std::string hintForMissing(const fs::path& path) {
  constexpr std::size_t kMaxNames = 5000;
  std::error_code ec;
  if (path.has_parent_path() && !fs::is_directory(path.parent_path(), ec))
    return fmt::format("check the path: there is no folder '{}'", path.parent_path().string());
  std::vector<std::string> names;
  for (auto entry = fs::directory_iterator(path.has_parent_path() ? path.parent_path() : ".", ec);
       !ec && entry != fs::directory_iterator() && names.size() < kMaxNames; entry.increment(ec))
    names.push_back(entry->path().filename().string());
  std::ranges::sort(names);
  const std::string near = nearestName(path.filename().string(), names);
  return near.empty() ? "check the path"
                      : fmt::format("did you mean '{}'?", (path.parent_path() / near).string());
}

// Whether a pipe has bytes or its end; false after a moment without, so that whoever waits can be asked.
bool hasMore(int descriptor) {
  constexpr int kMilliseconds = 50;
  pollfd one{descriptor, POLLIN, 0};
  return ::poll(&one, 1, kMilliseconds) > 0;
}

// Closes what it holds.
class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  ~Descriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  explicit operator bool() const { return descriptor_ >= 0; }
  int get() const { return descriptor_; }

 private:
  const int descriptor_;
};

// What is opened for reading, or why not.
struct Opened {
  int descriptor = -1;      // does not block; closed by whoever reads
  bool endless = false;     // a pipe, whose end is known when it comes
  std::uint64_t bytes = 0;  // of a regular file
  bool outside = false;
  std::string why, hint;
};

Opened openFile(const std::string& path) {
  if (path.empty()) return {.why = "the name is empty", .hint = "name a file"};
  bool mayBePipe = false, wasChosen = false, free = true;
  const std::string absolute = absolutePath(path);
  {
    Rules rules;
    const auto chosen = rules->chosen.find(absolute);
    wasChosen = chosen != rules->chosen.end();
    mayBePipe = wasChosen && std::exchange(chosen->second, false);
    free = !rules->confined || wasChosen;
  }
  // Looked at before it is opened: opening a device can do something by itself. A handle reads nothing and does nothing.
  const Descriptor handle(::open(free ? path.c_str() : absolute.c_str(), O_PATH | O_CLOEXEC));
  int error = errno;
  const std::string behind = fmt::format("/proc/self/fd/{}", handle.get());
  if (!free) {
    std::error_code ec;
    const std::string real = handle ? fs::read_symlink(behind, ec).string() : realOf(absolute);
    if (!isInside(*Rules(), absolute, real)) return {.outside = true};
  }
  struct stat status {};
  int descriptor = -1;
  if (handle && ::fstat(handle.get(), &status) == 0) {
    const bool pipe = S_ISFIFO(status.st_mode);
    if (S_ISDIR(status.st_mode)) return {.why = "it is a directory", .hint = "name a file inside it"};
    if (pipe && !mayBePipe)
      return {.why = "it is a pipe", .hint = "name a file; only a path on the command line may be a pipe"};
    if (!pipe && !S_ISREG(status.st_mode))
      return {.why = S_ISSOCK(status.st_mode) ? "it is a socket" : "it is a device", .hint = "name a file"};
    // What was looked at is what is opened, whatever has the name by now.
    descriptor = ::open(behind.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    error = errno;
  }
  if (descriptor < 0 && (error == ENOENT || error == ENOTDIR))
    return {.why = "no such file", .hint = hintForMissing(path)};
  if (descriptor < 0) return {.why = std::strerror(error)};
  const bool regular = S_ISREG(status.st_mode);
  Rules()->read.insert(absolute);
  return {.descriptor = descriptor,
          .endless = !regular,
          .bytes = regular ? static_cast<std::uint64_t>(status.st_size) : 0};
}

// `place`, or the file itself.
Where placeOr(const Place& place, const std::string& path) {
  return isKnown(place) ? place : Place{path};
}

std::nullopt_t reportUnread(const std::string& path, std::string_view why, const std::string& hint,
                            Diagnostics& diagnostics, Code code, const Place& place) {
  diagnostics.add({.code = code,
                   .message = fmt::format("cannot read '{}': {}", path, why),
                   .place = placeOr(place, path),
                   .hint = hint});
  return std::nullopt;
}

}  // namespace

std::string absolutePath(const std::string& path) {
  // Most are absolute, and a language server asks for thousands.
  const auto has = [&](const char* part) { return path.find(part) != path.npos; };
  if (path.starts_with('/') && path.size() > 1 && !path.ends_with('/') && !has("//") && !has("/."))
    return path;
  std::error_code ec;
  const fs::path absolute = fs::absolute(path, ec);
  std::string text = (ec ? fs::path(path) : absolute).lexically_normal().string();
  while (text.size() > 1 && text.back() == '/') text.pop_back();
  return text;
}

std::string besideFile(const Place& place, const std::string& path) {
  if (path.empty() || !place.file) return path;
  return (fs::path(*place.file).parent_path() / path).lexically_normal().string();
}

std::string lowerExtension(const std::string& path) {
  return lowered(fs::path(path).extension().string());
}

bool isThere(const std::string& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

bool isFolder(const std::string& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

std::string dataFolder() {
  if (const char* folder = std::getenv("WEFT_DATA")) return folder;
  return isFolder(WEFT_DATA_SOURCE) ? WEFT_DATA_SOURCE : WEFT_DATA_INSTALLED;
}

std::optional<std::string> readFile(const std::string& path, Diagnostics& diagnostics, Code code,
                                    const Place& place, const std::stop_token& stop) {
  std::uint64_t bytes = 0;
  auto whole = readWithin(path, kMaxBytes, bytes, diagnostics, code, place, stop);
  if (!whole && bytes > kMaxBytes && !stop.stop_requested())
    reportUnread(path, "it is larger than 4 GiB", "name a smaller file", diagnostics, code, place);
  return whole;
}

void reportTooLarge(const Place& place, std::uint64_t bytes, Diagnostics& diagnostics) {
  reportLimit(diagnostics, place, "the file is too large", kMaxTextBytes, "bytes of one JSON or .cube file",
              bytes);
}

std::optional<std::string> readWithin(const std::string& path, std::uint64_t most, std::uint64_t& bytes,
                                      Diagnostics& diagnostics, Code code, const Place& place,
                                      const std::stop_token& stop) {
  const std::optional<Overlay> unsaved = overlayOf(path);
  const Opened opened = unsaved ? Opened{.outside = !mayRead(path)} : openFile(path);
  if (opened.outside) {
    reportOutside(path, diagnostics, place);
    return std::nullopt;
  }
  bytes = unsaved ? unsaved->text->size() : opened.bytes;
  if (unsaved) return bytes <= most ? std::optional(*unsaved->text) : std::nullopt;
  const Descriptor file(opened.descriptor);
  if (!file) return reportUnread(path, opened.why, opened.hint, diagnostics, code, place);
  std::string read;
  char chunk[65536];
  while (bytes <= most && !stop.stop_requested()) {
    if (opened.endless && !hasMore(file.get())) continue;
    const ssize_t got = ::read(file.get(), chunk, sizeof chunk);
    if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (got < 0) return reportUnread(path, std::strerror(errno), "", diagnostics, code, place);
    if (got == 0 && opened.endless) overlayFile(path, read);  // nobody can read it again
    if (got == 0) return read;
    read.append(chunk, static_cast<std::size_t>(got));
    bytes = std::max<std::uint64_t>(bytes, read.size());
  }
  return std::nullopt;
}

// Each unsaved text has a number of its own, which is no time of a file.
FileStamp stampOf(const std::string& path) {
  if (const auto unsaved = overlayOf(path))
    return {path, -1 - static_cast<std::int64_t>(unsaved->generation), unsaved->text->size()};
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return {path};
  return {path, std::int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + status.st_mtim.tv_nsec,
          static_cast<std::uint64_t>(status.st_size)};
}

std::optional<std::string> readTextFile(const std::string& path, Diagnostics& diagnostics, Code code,
                                        const Place& place) {
  const std::uint64_t most = raised(kMaxTextBytes);
  std::uint64_t bytes = 0;  // of a pipe: so far
  std::optional<std::string> text = readWithin(path, most, bytes, diagnostics, code, place);
  if (bytes > most) reportTooLarge({path, 0, 0}, bytes, diagnostics);
  return text;
}

bool writeFile(const std::string& path, std::span<const char> bytes, Diagnostics& diagnostics) {
  PendingFile file(path);
  if (file.write(bytes) && file.putInPlace()) return true;
  diagnostics.error(say::cannotWrite, {path, 0, 0}, path,
                    file.error() == EISDIR ? "it is a directory" : std::strerror(file.error()),
                    file.error() == ENOSPC ? "free some space, or name a file on another disk"
                                           : "name a file in an existing folder that can be written to");
  return false;
}

void chooseFile(const std::string& path) {
  if (path.empty()) return;
  Rules all;
  const std::string written = absolutePath(path);
  all->chosen[written] = true;
  std::error_code ec;
  if (fs::is_directory(written, ec)) addFolder(*all, written);
}

std::optional<std::string> confineTo(const std::string& folder) {
  std::error_code ec;
  if (!fs::is_directory(folder, ec))
    return fmt::format("expected a folder, found '{}', which is none", folder);
  Rules all;
  all->confined = true;
  all->named.push_back(folder);
  addFolder(*all, folder);
  return std::nullopt;
}

void allowFolder(const std::string& folder) {
  if (folder.empty()) return;
  Rules all;
  addFolder(*all, folder);
}

bool mayRead(const std::string& path) {
  Rules all;
  if (!all->confined) return true;
  const std::string absolute = absolutePath(path);
  return all->chosen.contains(absolute) || isInside(*all, absolute, realOf(absolute));
}

void reportOutside(const std::string& path, Diagnostics& diagnostics, const Place& place) {
  std::vector<std::string> folders;
  for (Rules all; const std::string& each : all->named) folders.push_back(fmt::format("'{}'", each));
  diagnostics.error(say::outsideConfinement, placeOr(place, path), path, fmt::join(folders, ", "));
}

std::set<std::string> filesRead() {
  return Rules()->read;
}

void resetFileAccess() {
  Rules all;
  all->confined = false;
  all->named.clear();
  all->folders.clear();
  all->chosen.clear();
}

void overlayFile(const std::string& path, std::string text) {
  Rules all;
  all->overlays[absolutePath(path)] = {std::make_shared<const std::string>(std::move(text)), ++all->overlaid};
}

void dropOverlay(const std::string& path) {
  Rules()->overlays.erase(absolutePath(path));
}

std::optional<Overlay> overlayOf(const std::string& path) {
  Rules all;
  if (all->overlays.empty()) return std::nullopt;
  const auto found = all->overlays.find(absolutePath(path));
  return found == all->overlays.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace weft::text
