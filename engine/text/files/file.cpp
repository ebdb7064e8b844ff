#include "engine/text/files/file.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <vector>

#include "engine/text/files/file_access.h"
#include "engine/text/files/file_overlay.h"
#include "engine/text/nearest.h"

namespace weft::text {

namespace {

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using FilePtr = std::unique_ptr<std::FILE, FileCloser>;

// A pipe may be read, an endless one must not fill the memory.
constexpr std::size_t kMaxBytes = std::size_t{4} << 30;

// The first folder that is not there, or the file of the nearest name.
std::string hintForMissing(const std::filesystem::path& path) {
  std::error_code ec;
  if (path == "-") return "name a file; standard input is /dev/stdin";
  if (!path.has_filename() && std::filesystem::is_regular_file(path.parent_path(), ec))
    return fmt::format("it is a file: write '{}'", path.parent_path().string());
  const std::filesystem::path folder = path.parent_path().empty() ? "." : path.parent_path();
  if (!std::filesystem::is_directory(folder, ec)) {
    std::filesystem::path missing = folder;
    while (missing.has_relative_path() && !missing.parent_path().empty() &&
           !std::filesystem::exists(missing.parent_path(), ec))
      missing = missing.parent_path();
    return fmt::format("check the path: there is no folder '{}'", missing.string());
  }
  constexpr std::size_t kMaxNames = 5000;
  std::vector<std::string> names;
  for (auto entry = std::filesystem::directory_iterator(folder, ec);
       !ec && entry != std::filesystem::directory_iterator() && names.size() < kMaxNames; entry.increment(ec))
    names.push_back(entry->path().filename().string());
  std::ranges::sort(names);
  const std::string near = nearestName(path.filename().string(), names);
  return near.empty() ? "check the path"
                      : fmt::format("did you mean '{}'?", (path.parent_path() / near).string());
}

// Where the bytes of a file stand until they are whole and it is renamed, also where its name is as long as a name may be.
std::string temporaryBeside(const std::string& path) {
  constexpr std::size_t kLongest = 255;  // bytes, of most file systems
  static std::atomic<unsigned> made = 0;
  const std::filesystem::path beside = fmt::format("{}.{}.tmp", path, ::getpid());
  if (beside.filename().string().size() <= kLongest) return beside.string();
  return (beside.parent_path() / fmt::format(".weft.{}.{}.tmp", ::getpid(), ++made)).string();
}

// Whether a pipe has bytes or its end; false after a moment without, so that whoever waits can be asked.
bool hasMore(int descriptor) {
  constexpr int kMilliseconds = 50;
  pollfd one{descriptor, POLLIN, 0};
  return ::poll(&one, 1, kMilliseconds) > 0;
}

}  // namespace

std::string besideFile(const Place& place, const std::string& path) {
  if (path.empty() || !place.file) return path;
  return (std::filesystem::path(*place.file).parent_path() / path).lexically_normal().string();
}

std::optional<std::string> readFile(const std::string& path, Diagnostics& diagnostics, Code code,
                                    const Place& place) {
  return readFile(path, diagnostics, code, place, {});
}

std::optional<std::string> readFile(const std::string& path, Diagnostics& diagnostics, Code code,
                                    const Place& place, const ReadProgress& goOn) {
  const auto fail = [&](std::string_view reason, const std::string& hint) {
    Place where = place;
    if (!isKnown(where)) where.file = std::make_shared<const std::string>(path);
    diagnostics.error(code, where, fmt::format("cannot read '{}': {}", path, reason)).hint = hint;
    return std::nullopt;
  };
  if (const std::optional<Overlay> unsaved = overlayOf(path)) {
    if (!mayRead(path)) {
      reportOutside(path, diagnostics, place);
      return std::nullopt;
    }
    if (goOn && !goOn(unsaved->text->size(), unsaved->text->size())) return std::nullopt;
    return *unsaved->text;
  }
  const OpenedFile opened = openFile(path);
  switch (opened.state) {
    case OpenedFile::State::open:
      break;
    case OpenedFile::State::outside:
      reportOutside(path, diagnostics, place);
      return std::nullopt;
    case OpenedFile::State::missing:
      if (path.empty()) return fail("the name is empty", "name a file");
      return fail("no such file", hintForMissing(path));
    case OpenedFile::State::directory:
      return fail("it is a directory", "name a file inside it");
    case OpenedFile::State::device:
      return fail("it is a device", "name a file");
    case OpenedFile::State::pipe:
      return fail("it is a pipe", "name a file; only a path on the command line may be a pipe");
    case OpenedFile::State::pipe_again:
      return fail("it is a pipe, which can be read only once", "name a file, to have it read again");
    case OpenedFile::State::socket:
      return fail("it is a socket", "name a file");
    case OpenedFile::State::unreadable:
      return fail(std::strerror(opened.error), "");
  }
  const FilePtr file(::fdopen(opened.descriptor, "rb"));
  if (!file) {
    ::close(opened.descriptor);
    return fail(std::strerror(ENOMEM), "");
  }
  if (opened.bytes > kMaxBytes) {
    if (goOn && !goOn(0, opened.bytes)) return std::nullopt;
    return fail("it is larger than 4 GiB", "name a smaller file");
  }
  std::string bytes;
  char chunk[65536];
  // Not fread: bytes of a slow pipe are reported as they come.
  for (;;) {
    if (opened.endless && !hasMore(opened.descriptor)) {
      if (goOn && !goOn(bytes.size(), 0)) return std::nullopt;
      continue;
    }
    const ssize_t got = ::read(opened.descriptor, chunk, sizeof chunk);
    if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (got < 0) return fail(std::strerror(errno), "");
    if (got == 0) break;
    bytes.append(chunk, static_cast<std::size_t>(got));
    if (goOn && !goOn(bytes.size(), opened.bytes)) return std::nullopt;
    if (bytes.size() > kMaxBytes) return fail("it is larger than 4 GiB", "name a smaller file");
  }
  return bytes;
}

bool writeFile(const std::string& path, std::span<const char> bytes, Diagnostics& diagnostics) {
  const auto fail = [&](const std::string& reason) {
    diagnostics
        .error(Code::outputNotWritten, {std::make_shared<const std::string>(path), 0, 0},
               fmt::format("cannot write '{}': {}", path, reason))
        .hint = reason == std::strerror(ENOSPC) ? "free some space, or name a file on another disk"
                                                : "name a file in an existing folder that can be written to";
    return false;
  };
  std::error_code ec;
  if (std::filesystem::is_directory(path, ec)) return fail("it is a directory");
  // Behind a link stands the file that is meant.
  const auto canonical = std::filesystem::canonical(path, ec);
  const std::string target = ec ? path : canonical.string();
  const auto before = std::filesystem::status(target, ec);
  // A device or a pipe is written to, not replaced.
  const bool special = std::filesystem::exists(before) && !std::filesystem::is_regular_file(before);
  const std::string temporary = special ? target : temporaryBeside(target);
  FilePtr file(std::fopen(temporary.c_str(), "wb"));
  if (!file) return fail(std::strerror(errno));
  const bool written =
      std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size() && std::fflush(file.get()) == 0;
  const int error = errno;
  file.reset();
  ec.clear();
  if (written && std::filesystem::is_regular_file(before))
    std::filesystem::permissions(temporary, before.permissions(), ec);
  ec.clear();
  if (written && !special) std::filesystem::rename(temporary, target, ec);
  if (!written || ec) {
    std::error_code ignored;
    if (!special) std::filesystem::remove(temporary, ignored);
    return fail(written ? ec.message() : std::strerror(error));
  }
  return true;
}

}  // namespace weft::text
