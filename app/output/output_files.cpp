#include "app/output/output_files.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace weft::app {

namespace {

namespace fs = std::filesystem;

void refuse(const std::string& path, const std::string& message, const std::string& hint,
            base::Diagnostics& diagnostics) {
  diagnostics.error(base::Code::outputNotWritten, {std::make_shared<const std::string>(path), 0, 0}, message)
      .hint = hint;
}

// Which file a name leads to, through links; nothing when there is none or it is no plain file.
using FileId = std::pair<std::uint64_t, std::uint64_t>;  // device, inode
std::optional<FileId> idOf(const std::string& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return std::nullopt;
  return FileId{found.st_dev, found.st_ino};
}

// The one name that all spellings of a path have, of a file that may not be there yet.
std::string plainName(const std::string& path) {
  std::error_code ec;
  const fs::path whole = fs::absolute(path, ec);
  if (ec) return path;
  const fs::path plain = fs::weakly_canonical(whole, ec);
  return (ec ? whole.lexically_normal() : plain).string();
}

// The frame whose file of `pattern` is `name`.
std::optional<std::uint32_t> frameOf(const std::string& pattern, const std::string& name) {
  const std::size_t at = pattern.find('%');
  if (at == std::string::npos) return pattern == name ? std::optional(0u) : std::nullopt;
  if (name.compare(0, at, pattern, 0, at) != 0) return std::nullopt;
  std::size_t begin = at;
  while (begin < name.size() && name[begin] == ' ') ++begin;  // of "%4d"
  std::uint32_t frame = 0;
  const auto [end, error] = std::from_chars(name.data() + begin, name.data() + name.size(), frame);
  return error == std::errc{} && outputNameOf(pattern, frame) == name ? std::optional(frame) : std::nullopt;
}

bool isAmong(const OutputFile& output, std::optional<std::uint32_t> frame) {
  const bool several = output.pattern.find('%') != std::string::npos;
  return frame && (!several || (*frame >= output.first && *frame <= output.last));
}

// Calls `visit(path)` for every file of `output` that is there. One component of a pattern has the number:
// what its folder holds is looked through, so that a million frames cost nothing.
template <class Visit>
void visitExisting(const OutputFile& output, const Visit& visit) {
  const std::size_t at = output.pattern.find('%');
  if (at == std::string::npos) return visit(output.pattern);
  const std::size_t slash = output.pattern.rfind('/', at), next = output.pattern.find('/', at);
  const std::string folder = slash == std::string::npos ? "" : output.pattern.substr(0, slash + 1);
  const std::string component =
      output.pattern.substr(folder.size(), next == std::string::npos ? next : next - folder.size());
  const std::string rest = next == std::string::npos ? "" : output.pattern.substr(next);
  std::error_code ec;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, ec), end; !ec && entry != end;
       entry.increment(ec)) {
    const std::string name = entry->path().filename().string();
    if (isAmong(output, frameOf(component, name))) visit(folder + name + rest);
  }
}

constexpr const char* kNameAnother = "name another file";

std::map<FileId, std::string> filesByIdOf(std::span<const std::string> paths) {
  std::map<FileId, std::string> files;
  for (const std::string& path : paths)
    if (const auto id = idOf(path)) files.emplace(*id, path);
  return files;
}

void refuseInput(const std::string& path, const std::string& option, const std::string& input,
                 base::Diagnostics& diagnostics) {
  refuse(path, fmt::format("{} would write over '{}', which this run reads", option, input), kNameAnother,
         diagnostics);
}

}  // namespace

std::optional<std::string> outputNameOf(const std::string& pattern, std::uint32_t frame) {
  const std::size_t at = pattern.find('%');
  if (at == std::string::npos) return pattern;
  std::size_t end = at + 1;
  std::string width;
  while (end < pattern.size() && pattern[end] >= '0' && pattern[end] <= '9') width += pattern[end++];
  if (end >= pattern.size() || pattern[end] != 'd' || pattern.find('%', end) != std::string::npos ||
      width.size() > 3)
    return std::nullopt;
  const int digits = width.empty() ? 0 : std::atoi(width.c_str());
  const std::string number = !width.empty() && width[0] == '0' ? fmt::format("{:0{}}", frame, digits)
                                                               : fmt::format("{:{}}", frame, digits);
  return pattern.substr(0, at) + number + pattern.substr(end + 1);
}

std::string pictureKindOf(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  for (char& letter : extension)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return extension;
}

bool checkOutput(const std::string& pattern, std::uint32_t firstFrame, bool several,
                 base::Diagnostics& diagnostics) {
  const auto fail = [&](const std::string& message, const std::string& hint) {
    refuse(pattern, message, hint, diagnostics);
    return false;
  };
  const auto first = outputNameOf(pattern, firstFrame);
  if (!first)
    return fail(fmt::format("'{}' is no pattern for frame numbers", pattern),
                "write one %d or %04d, and no other %");
  if (several && pattern.find('%') == std::string::npos)
    return fail(fmt::format("several frames would all be written to '{}'", pattern),
                "put a frame number into the name: f_%04d.png");
  if (const std::string kind = pictureKindOf(*first); kind != ".png" && kind != ".exr")
    return fail(fmt::format("cannot write '{}': unknown kind of image '{}'", *first,
                            fs::path(*first).extension().string()),
                "name a .png or an .exr file");
  base::Diagnostics said;
  if (!makeFolderOf(*first, said)) {
    for (base::Diagnostic each : said.items()) {
      each.place.file = std::make_shared<const std::string>(pattern);
      diagnostics.add(std::move(each));
    }
    return false;
  }
  std::error_code ec;
  if (fs::is_directory(*first, ec))
    return fail(fmt::format("cannot write '{}': it is a directory", *first), "name a file");
  return true;
}

bool makeFolderOf(const std::string& path, base::Diagnostics& diagnostics) {
  const fs::path folder = fs::path(path).parent_path();
  std::error_code ec;
  if (folder.empty() || fs::is_directory(folder, ec)) return true;
  ec.clear();
  fs::create_directories(folder, ec);
  if (!ec) return true;
  refuse(path, fmt::format("cannot make the folder '{}': {}", folder.string(), ec.message()),
         "name a file in a folder that can be made or written to", diagnostics);
  return false;
}

bool makeFolders(const std::string& pattern, std::uint32_t first, std::uint32_t last,
                 base::Diagnostics& diagnostics) {
  const std::size_t at = pattern.find('%'), slash = pattern.rfind('/');
  if (at == std::string::npos || slash == std::string::npos || at > slash) return true;
  for (std::uint64_t frame = first; frame <= last; ++frame)
    if (!makeFolderOf(*outputNameOf(pattern, static_cast<std::uint32_t>(frame)), diagnostics)) return false;
  return true;
}

bool checkDistinct(std::span<const OutputFile> outputs, std::span<const std::string> inputs,
                   base::Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errorCount();
  const std::map<FileId, std::string> read = filesByIdOf(inputs);
  std::map<FileId, const OutputFile*> written;  // what is there already
  std::vector<OutputFile> seen;                 // by their plain names
  for (const OutputFile& output : outputs) {
    if (output.pattern.empty()) continue;
    const auto twice = [&](const OutputFile& other) {
      refuse(output.pattern,
             fmt::format("{} and {} would write one file, '{}'", other.option, output.option, output.pattern),
             kNameAnother, diagnostics);
    };
    std::size_t found = 0;
    visitExisting(output, [&](const std::string& path) {
      const auto id = idOf(path);
      if (!id || found > 0) return;
      if (const auto input = read.find(*id); input != read.end()) {
        refuseInput(path, output.option, input->second, diagnostics);
        ++found;
      } else if (const auto other = written.emplace(*id, &output).first; other->second != &output) {
        twice(*other->second);
        ++found;
      }
    });
    OutputFile plain = output;
    plain.pattern = plainName(output.pattern);
    struct stat special {};
    const bool file = ::stat(output.pattern.c_str(), &special) != 0 || S_ISREG(special.st_mode);
    for (const OutputFile& other : seen) {
      if (found > 0 || !file) break;
      // Two patterns meet where they are spelled alike; a plain name is a frame of a pattern or not.
      const bool meet = plain.pattern == other.pattern
                            ? plain.first <= other.last && other.first <= plain.last
                            : isAmong(other, frameOf(other.pattern, plain.pattern)) ||
                                  isAmong(plain, frameOf(plain.pattern, other.pattern));
      if (meet) {
        twice(other);
        ++found;
      }
    }
    seen.push_back(std::move(plain));
  }
  return diagnostics.errorCount() == before;
}

bool checkMadeFiles(std::span<const std::string> paths, std::span<const std::string> inputs,
                    const std::string& option, base::Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errorCount();
  const std::map<FileId, std::string> read = filesByIdOf(inputs);
  for (const std::string& path : paths) {
    struct stat found {};
    if (::stat(path.c_str(), &found) != 0) continue;
    if (!S_ISREG(found.st_mode)) {
      refuse(path,
             fmt::format("{} stands where a file would be written", S_ISFIFO(found.st_mode)   ? "a pipe"
                                                                    : S_ISDIR(found.st_mode)  ? "a folder"
                                                                    : S_ISSOCK(found.st_mode) ? "a socket"
                                                                                              : "a device"),
             "remove it, or name another folder", diagnostics);
    } else if (const auto input = read.find(FileId{found.st_dev, found.st_ino}); input != read.end()) {
      refuseInput(path, option, input->second, diagnostics);
    }
  }
  return diagnostics.errorCount() == before;
}

}  // namespace weft::app
