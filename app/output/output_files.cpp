#include "app/output/output_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app_sentences.h"
#include "engine/text/files/file.h"

namespace weft::app {

namespace {

namespace fs = std::filesystem;

// The one name that all spellings of a path have, of a file that may not be there yet.
std::string plainName(const std::string& path) {
  std::error_code ec;
  const fs::path whole = fs::absolute(path, ec);
  if (ec) return path;
  const fs::path plain = fs::weakly_canonical(whole, ec);
  return (ec ? whole.lexically_normal() : plain).string();
}

// Whether `name` is the pattern, or that of a frame of it.
bool fits(const std::string& pattern, const std::string& name) {
  const std::size_t at = pattern.find('%'), end = pattern.find('d', at);
  if (pattern == name || at == std::string::npos || end == std::string::npos) return pattern == name;
  const std::string before = pattern.substr(0, at), behind = pattern.substr(end + 1);
  const std::size_t digits = name.size() - std::min(name.size(), before.size() + behind.size());
  return digits > 0 && name.starts_with(before) && name.ends_with(behind) &&
         name.substr(at, digits).find_first_not_of(" 0123456789") == std::string::npos;
}

// The link that a file is, or that a folder of it below `inside` is; or "".
std::string linkOnTheWay(const std::string& file, const std::string& inside) {
  std::error_code ec;
  for (fs::path path = file; path.string().size() > inside.size(); path = path.parent_path()) {
    if (fs::is_symlink(fs::symlink_status(path, ec))) return path.string();
    if (inside.empty() || path == path.parent_path()) break;
  }
  return "";
}

}  // namespace

std::optional<std::string> outputNameOf(const std::string& pattern, std::uint32_t frame) {
  const std::size_t at = pattern.find('%');
  if (at == std::string::npos) return pattern;
  const std::size_t end = pattern.find_first_not_of("0123456789", at + 1);
  const std::string width = pattern.substr(at + 1, end - at - 1);
  if (end == std::string::npos || pattern[end] != 'd' || pattern.find('%', end) != std::string::npos ||
      width.size() > 3)
    return std::nullopt;
  // Digits as printf has them: a width of spaces, or of zeros behind a 0.
  return pattern.substr(0, at) + fmt::format(fmt::runtime("{:" + width + "}"), frame) +
         pattern.substr(end + 1);
}

bool checkOutput(const std::string& pattern, std::uint32_t firstFrame, bool several,
                 text::Diagnostics& diagnostics) {
  const auto first = outputNameOf(pattern, firstFrame);
  if (!first) return refuseOutput(diagnostics, say::badPattern, pattern, pattern);
  if (several && pattern.find('%') == std::string::npos)
    return refuseOutput(diagnostics, say::framesToOneFile, pattern, pattern);
  if (const std::string kind = text::lowerExtension(*first); kind != ".png" && kind != ".exr")
    return refuseOutput(diagnostics, say::unknownImageKind, pattern, *first, kind);
  return makeFolderOf(*first, diagnostics);
}

std::optional<std::string> filledIn(const std::string& file,
                                    const std::vector<std::pair<std::string_view, std::string>>& words,
                                    text::Diagnostics& diagnostics) {
  const auto text = text::readTextFile(text::dataFolder() + "/app/" + file, diagnostics);
  if (!text) return std::nullopt;
  std::string out;
  for (std::string_view rest = *text; !rest.empty();) {
    const auto word =
        std::ranges::find_if(words, [&](const auto& each) { return rest.starts_with(each.first); });
    out += word == words.end() ? std::string(1, rest[0]) : word->second;
    rest.remove_prefix(word == words.end() ? 1 : word->first.size());
  }
  return out;
}

bool makeFolderOf(const std::string& path, text::Diagnostics& diagnostics) {
  const fs::path folder = fs::path(path).parent_path();
  std::error_code ec;
  if (folder.empty() || fs::is_directory(folder, ec)) return true;
  ec.clear();
  fs::create_directories(folder, ec);
  if (!ec) return true;
  return refuseOutput(diagnostics, say::folderNotMade, path, folder.string(), ec.message());
}

bool checkDistinct(std::span<const OutputFile> outputs, text::Diagnostics& diagnostics,
                   std::span<const std::string> inputs) {
  const std::size_t before = diagnostics.errorCount();
  std::vector<OutputFile> seen;  // by their plain names; those that are read have no option
  for (const std::string& input : inputs) seen.push_back({"", plainName(input)});
  for (const std::string& file : text::filesRead()) seen.push_back({"", plainName(file)});
  for (const OutputFile& output : outputs) {
    if (output.pattern.empty()) continue;
    const auto refuse = [&]<class... Args>(text::Saying<Args...> what, Args&&... args) {
      diagnostics.error<Args...>(what, {output.pattern}, std::forward<Args>(args)...);
    };
    std::error_code ec;
    const fs::file_status found = fs::status(output.pattern, ec);
    const bool ours = output.over != OutputFile::Over::anything;
    const std::string link = ours ? linkOnTheWay(output.pattern, output.inside) : "";
    const bool plain = !fs::exists(found) || fs::is_regular_file(found);
    if (!link.empty()) {
      refuse(say::linkNotFollowed, link);
    } else if (fs::exists(found) && output.over == OutputFile::Over::nothing) {
      refuse(say::fileThere);
    } else if (!plain && ours) {
      refuse(say::otherThingThere, fs::is_fifo(found)        ? "a pipe"
                                   : fs::is_directory(found) ? "a folder"
                                                             : "a device");
    } else if (plain) {
      const std::string name = plainName(output.pattern);
      const auto same = std::ranges::find_if(seen, [&](const OutputFile& other) {
        return fits(name, other.pattern) || fits(other.pattern, name);
      });
      if (same == seen.end())
        seen.push_back({output.option, name});
      else if (same->option.empty())
        refuse(say::overwritesInput, output.option, same->pattern);
      else
        refuse(say::oneFileForTwo, same->option, output.option, output.pattern);
    }
  }
  return diagnostics.errorCount() == before;
}

}  // namespace weft::app
