#include "app/output/output_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

namespace weft::app {

namespace {

namespace fs = std::filesystem;

void refuse(const std::string& path, const std::string& message, const std::string& hint,
            text::Diagnostics& diagnostics) {
  diagnostics.error(text::Code::outputNotWritten, {std::make_shared<const std::string>(path), 0, 0}, message)
      .hint = hint;
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

bool isAmong(const OutputFile& output, const std::string& name) {
  const auto frame = frameOf(output.pattern, name);
  return frame && *frame >= output.first && *frame <= output.last;
}

// Whether two outputs with plain names have a file in common.
bool meet(const OutputFile& a, const OutputFile& b) {
  return a.pattern == b.pattern ? a.first <= b.last && b.first <= a.last
                                : isAmong(a, b.pattern) || isAmong(b, a.pattern);
}

OutputFile plainOf(OutputFile output) {
  output.pattern = plainName(output.pattern);
  if (output.pattern.find('%') == std::string::npos) output.first = output.last = 0;
  return output;
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
                 text::Diagnostics& diagnostics) {
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
  return makeFolderOf(*first, diagnostics);
}

bool makeFolderOf(const std::string& path, text::Diagnostics& diagnostics) {
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

bool checkDistinct(std::span<const OutputFile> outputs, std::span<const std::string> inputs,
                   text::Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errorCount();
  std::vector<OutputFile> seen;  // by their plain names; those that are read have no option
  for (const std::string& input : inputs) seen.push_back(plainOf({"", input}));
  for (const OutputFile& output : outputs) {
    std::error_code ec;
    const fs::file_status there = fs::status(output.pattern, ec);
    if (output.pattern.empty() || (fs::exists(there) && !fs::is_regular_file(there))) continue;
    OutputFile plain = plainOf(output);
    const auto same = std::ranges::find_if(seen, [&](const OutputFile& other) { return meet(plain, other); });
    if (same == seen.end())
      seen.push_back(std::move(plain));
    else
      refuse(output.pattern,
             same->option.empty()
                 ? fmt::format("{} would write over '{}', which this run reads", output.option, same->pattern)
                 : fmt::format("{} and {} would write one file, '{}'", same->option, output.option,
                               output.pattern),
             "name another file", diagnostics);
  }
  return diagnostics.errorCount() == before;
}

bool checkMadeFiles(std::span<const std::string> paths, text::Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errorCount();
  for (const std::string& path : paths) {
    std::error_code ec;
    const fs::file_status found = fs::status(path, ec);
    if (fs::exists(found) && !fs::is_regular_file(found))
      refuse(
          path,
          fmt::format("there is {} of the name of a file to write", fs::is_fifo(found)        ? "a pipe"
                                                                    : fs::is_directory(found) ? "a folder"
                                                                                              : "a device"),
          "remove it, or name another folder", diagnostics);
  }
  return diagnostics.errorCount() == before;
}

bool checkFree(std::span<const std::string> paths, text::Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errorCount();
  std::error_code ec;
  for (const std::string& path : paths)
    if (fs::exists(path, ec))
      refuse(path, "the file is there already", "remove it, or choose another name or folder", diagnostics);
  return diagnostics.errorCount() == before;
}

}  // namespace weft::app
