#include "app/output/manifest.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "app/output/output_files.h"
#include "app_sentences.h"
#include "engine/text/chars.h"
#include "engine/text/files/file.h"
#include "engine/text/hash.h"
#include "engine/text/json/edit.h"

namespace weft::app {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr std::string_view kBeginning = "{\"frame\":";

// Of a file that the person named; "" of one that cannot be read, and of a pipe.
std::string hashOf(const std::string& file) {
  std::error_code ec;
  if (!fs::is_regular_file(file, ec)) return "";
  text::chooseFile(file);
  text::Diagnostics unread;
  const auto bytes = text::readFile(file, unread);
  return bytes ? fmt::format("{:016x}", text::hashBytes(*bytes)) : "";
}

// Adds a line in one write, after all that other processes add. An errno.
int addLine(const std::string& path, std::string line) {
  const int file = ::open(path.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0666);
  if (file < 0) return errno;
  int error = 0;
  while (::flock(file, LOCK_EX) != 0 && (error = errno) == EINTR) error = 0;
  struct stat status {};
  char last = '\n';
  if (error == 0 && ::fstat(file, &status) != 0) error = errno;
  if (status.st_size > 0 && ::pread(file, &last, 1, status.st_size - 1) == 1 && last != '\n')
    line = "\n" + line;  // behind a torn one
  if (error == 0) {
    errno = EIO;
    const ssize_t got = ::write(file, line.data(), line.size());
    if (got != static_cast<ssize_t>(line.size())) {
      error = got < 0 ? errno : ENOSPC;
      if (::ftruncate(file, status.st_size) != 0) error = errno;
    }
  }
  if (::close(file) != 0 && error == 0) error = errno;
  return error;
}

}  // namespace

std::string manifestNameOf(const std::string& pattern) {
  std::string name = pattern;
  if (const std::size_t at = name.find('%'); at != std::string::npos)
    name.erase(at, name.find('d', at) - at + 1);
  const fs::path path = fs::path(name).lexically_normal();
  const std::string stem = path.stem().string();
  const bool bare = stem.empty() || stem.starts_with('.');  // "%04d.png"
  return path.parent_path() / (bare ? "frames.jsonl" : stem + ".frames.jsonl");
}

bool Manifest::read(text::Diagnostics& diagnostics) {
  if (!text::isThere(path_)) return true;
  std::error_code ec;
  if (!fs::is_regular_file(path_, ec) && !fs::is_directory(path_, ec))
    return refuseOutput(diagnostics, say::manifestNotPlain, path_, path_);
  const auto bytes = text::readFile(path_, diagnostics, text::Code::outputNotWritten);
  if (!bytes) return false;
  std::string_view rest = *bytes;
  std::uint32_t wrong = 0;  // the first line that is none of a manifest
  for (std::uint32_t number = 1; !rest.empty(); ++number) {
    const std::string_view line = text::takeLine(rest);
    const Json json = text::loadJson(line);
    // Torn: its writer was killed. The next line is whole again.
    if (json.is_discarded() && (line.starts_with(kBeginning) || kBeginning.starts_with(line))) continue;
    const auto string = [&](const char* key) {
      return json.is_object() && json.contains(key) && json[key].is_string();
    };
    if (!string("settings") || !json.contains("frame") || !json["frame"].is_number_unsigned() ||
        json["frame"].get<std::uint64_t>() > ~0u || !json.contains("files") || !json["files"].is_object()) {
      if (wrong == 0) wrong = number;
      continue;
    }
    const auto frame = json["frame"].get<std::uint32_t>();
    if (json["settings"] == settings_)
      done_[frame] = json["files"];
    else
      others_.insert(frame);
  }
  if (wrong == 0) return true;
  const text::Place place{path_, wrong, 1};
  const char* const expected =
      "lines such as {\"frame\":7,\"files\":{\"f_0007.png\":\"…\"},\"settings\":\"…\"}";
  const bool damaged = !done_.empty() || !others_.empty();
  if (damaged)
    diagnostics.warning(say::damagedManifestLine, place, expected);
  else
    diagnostics.error(say::noManifest, place, path_, expected);
  return damaged;
}

std::string Manifest::nameOf(const std::string& file) const {
  const fs::path folder = fs::path(text::absolutePath(path_)).parent_path();
  const std::string name = fs::path(text::absolutePath(file)).lexically_relative(folder).string();
  return text::loadJson(text::dumpJson(name, -1, false)).get<std::string>();  // as it is read again: UTF-8
}

bool Manifest::isDone(std::uint32_t frame, std::span<const std::string> files) const {
  const auto found = done_.find(frame);
  return found != done_.end() && std::ranges::all_of(files, [&](const std::string& file) {
           const auto hash = found->second.find(nameOf(file));
           const std::string now = hashOf(file);
           return hash != found->second.end() && !now.empty() && *hash == now;
         });
}

bool Manifest::add(std::uint32_t frame, std::span<const std::string> files, double seconds,
                   text::Diagnostics& diagnostics) {
  Json line = {{"frame", frame},
               {"files", Json::object()},
               {"settings", settings_},
               {"seconds", std::round(seconds * 1e6) / 1e6}};
  for (const std::string& file : files) line["files"][nameOf(file)] = hashOf(file);
  line.update(about_);
  const int error = addLine(path_, text::dumpJson(line, -1, false) + "\n");
  return error == 0 ||
         refuseOutput(diagnostics, say::manifestNotWritten, path_, frame, path_, std::strerror(error));
}

}  // namespace weft::app
