#include "engine/base/file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <vector>

#include "engine/base/nearest.h"

namespace weft::base {

namespace {

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using FilePtr = std::unique_ptr<std::FILE, FileCloser>;

// Of a folder, to find the nearest in.
constexpr std::size_t kMaxNames = 5000;
// A pipe may be read, an endless one must not fill the memory.
constexpr std::size_t kMaxBytes = std::size_t{4} << 30;

// The first folder that is not there, or the file of the nearest name.
std::string hintForMissing(const std::filesystem::path& path) {
  std::error_code ec;
  const std::filesystem::path folder = path.parent_path().empty() ? "." : path.parent_path();
  if (!std::filesystem::is_directory(folder, ec)) {
    std::filesystem::path missing = folder;
    while (missing.has_relative_path() && !missing.parent_path().empty() &&
           !std::filesystem::exists(missing.parent_path(), ec))
      missing = missing.parent_path();
    return fmt::format("check the path: there is no folder '{}'", missing.string());
  }
  std::vector<std::string> names;
  for (auto entry = std::filesystem::directory_iterator(folder, ec);
       !ec && entry != std::filesystem::directory_iterator() && names.size() < kMaxNames; entry.increment(ec))
    names.push_back(entry->path().filename().string());
  std::ranges::sort(names);
  const std::string near = nearestName(path.filename().string(), names);
  return near.empty() ? "check the path"
                      : fmt::format("did you mean '{}'?", (path.parent_path() / near).string());
}

}  // namespace

std::optional<std::string> readFile(const std::string& path, Diagnostics& diagnostics, Code code,
                                    const Place& place) {
  return readFile(path, diagnostics, code, place, {});
}

std::optional<std::string> readFile(const std::string& path, Diagnostics& diagnostics, Code code,
                                    const Place& place, const ReadProgress& goOn) {
  const auto fail = [&](const std::string& reason, const std::string& hint) {
    Place where = place;
    if (!where.file) where.file = std::make_shared<const std::string>(path);
    diagnostics.error(code, where, fmt::format("cannot read '{}': {}", path, reason)).hint = hint;
    return std::nullopt;
  };
  std::error_code ec;
  const auto status = std::filesystem::status(path, ec);
  if (status.type() == std::filesystem::file_type::not_found)
    return fail("no such file", hintForMissing(path));
  if (status.type() == std::filesystem::file_type::directory)
    return fail("it is a directory", "name a file inside it");
  if (status.type() == std::filesystem::file_type::character ||
      status.type() == std::filesystem::file_type::block)
    return fail("it is a device", "name a file");
  const FilePtr file(std::fopen(path.c_str(), "rb"));
  if (!file) return fail(std::strerror(errno), "");
  const std::uintmax_t size =
      std::filesystem::is_regular_file(status) ? std::filesystem::file_size(path, ec) : 0;
  const std::uint64_t total = ec ? 0 : size;
  std::string bytes;
  char chunk[65536];
  // Not fread: a slow pipe is told of as it comes.
  for (;;) {
    const ssize_t got = ::read(fileno(file.get()), chunk, sizeof chunk);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return fail(std::strerror(errno), "");
    if (got == 0) break;
    bytes.append(chunk, static_cast<std::size_t>(got));
    if (goOn && !goOn(bytes.size(), total)) return std::nullopt;
    if (bytes.size() > kMaxBytes) return fail("it is larger than 4 GiB", "name a smaller file");
  }
  return bytes;
}

bool writeFile(const std::string& path, std::span<const char> bytes, Diagnostics& diagnostics) {
  const auto fail = [&](const std::string& reason) {
    diagnostics
        .error(Code::W180, {std::make_shared<const std::string>(path), 0, 0},
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
  const std::string temporary = special ? target : fmt::format("{}.{}.tmp", target, ::getpid());
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

}  // namespace weft::base
