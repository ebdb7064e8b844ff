#include "app/session/option_checks.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>

#include "engine/base/files/file_access.h"
#include "engine/base/limits.h"

namespace weft::app {

namespace {
constexpr int kMostPixels = 16384;  // of a side of a picture
}  // namespace

bool parseNumber(const std::string& text, std::uint32_t& out) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  return error == std::errc{} && end == text.data() + text.size();
}

bool parsePair(const std::string& text, char separator, std::uint32_t& a, std::uint32_t& b) {
  const std::size_t at = text.find(separator);
  return at != std::string::npos && parseNumber(text.substr(0, at), a) && parseNumber(text.substr(at + 1), b);
}

std::optional<imports::Pointer> parsePointer(const std::string& text) {
  const std::string_view held = ",down";
  std::string_view rest = text;
  imports::Pointer pointer;
  pointer.down = rest.ends_with(held);
  if (pointer.down) rest.remove_suffix(held.size());
  const std::size_t comma = rest.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const std::string_view parts[] = {rest.substr(0, comma), rest.substr(comma + 1)};
  for (int i = 0; i < 2; ++i) {
    float x = 0;
    const auto [end, error] = std::from_chars(parts[i].data(), parts[i].data() + parts[i].size(), x);
    if (error != std::errc{} || end != parts[i].data() + parts[i].size() || !(x >= 0 && x <= kMostPixels))
      return std::nullopt;
    pointer.position[i] = x;
  }
  if (pointer.down) pointer.pressed = pointer.dragged = pointer.position;
  return pointer;
}

std::string checkPointer(const std::string& text) {
  if (parsePointer(text)) return "";
  return fmt::format(
      "expected X,Y or X,Y,down: pixels from the lower left corner of the picture, each from 0 to {}, found "
      "'{}'",
      kMostPixels, text);
}

std::string checkSize(const std::string& text) {
  std::uint32_t width = 0, height = 0;
  const bool good = parsePair(text, 'x', width, height) && width >= 1 && height >= 1 &&
                    width <= kMostPixels && height <= kMostPixels;
  return good ? "" : fmt::format("expected WIDTHxHEIGHT, each from 1 to {}, found '{}'", kMostPixels, text);
}

CLI::Validator numberFrom(double low, double high) {
  const auto check = [low, high](const std::string& text) -> std::string {
    double x = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
    const bool good = error == std::errc{} && end == text.data() + text.size() && x >= low && x <= high;
    return good ? "" : fmt::format("expected a number from {} to {}, found '{}'", low, high, text);
  };
  return {check, fmt::format("{} to {}", low, high)};
}

std::string checkFrames(const std::string& text) {
  std::uint32_t first = 0, last = 0;
  const bool good = text.find(':') == std::string::npos ? parseNumber(text, first)
                                                        : parsePair(text, ':', first, last) && first <= last;
  return good ? ""
              : "expected FRAME or FIRST:LAST with FIRST <= LAST, whole numbers from 0 to 4294967295, found "
                "'" +
                    text + "'";
}

std::string checkFrame(const std::string& text) {
  std::uint32_t frame = 0;
  return parseNumber(text, frame)
             ? ""
             : fmt::format("expected a frame number from 0 to {}, found '{}'", ~0u, text);
}

std::string checkCount(const std::string& text) {
  std::uint32_t count = 0;
  return parseNumber(text, count)
             ? ""
             : fmt::format("expected a number of frames up to {}, found '{}'", ~0u, text);
}

// Sets the limit, for this process.
std::string takeLimit(const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0) return "expected NAME=VALUE, found '" + text + "'";
  return base::setLimit(text.substr(0, at), text.substr(at + 1)).value_or("");
}

// Confines reading, for this process.
std::string takeConfinement(const std::string& folder) {
  return base::confineTo(folder).value_or("");
}

std::string checkFolder(const std::string& path) {
  std::error_code ec;
  if (std::filesystem::is_directory(path, ec)) return "";
  return fmt::format(
      "{} '{}'",
      std::filesystem::exists(path, ec) ? "expected a folder, found the file" : "there is no folder", path);
}

std::string checkCacheFolder(const std::string& path) {
  std::error_code ec;
  if (path == "none") return "";
  // The folder itself, or the nearest above it that is there.
  std::filesystem::path there = path;
  while (!std::filesystem::exists(there, ec) && there.has_parent_path() && there.parent_path() != there)
    there = there.parent_path();
  if (!std::filesystem::exists(there, ec) || std::filesystem::is_directory(there, ec)) return "";
  return fmt::format("expected a folder, or a name for a new one, found the file '{}'", there.string());
}

std::string checkSet(const std::string& text) {
  const std::size_t at = text.find('=');
  return at != std::string::npos && at > 0 ? "" : "expected NAME=VALUE, found '" + text + "'";
}

std::string findEmptyName(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    const std::string type = option->get_type_name();
    const bool folder = type.find("FOLDER") != std::string::npos;
    if (option->get_positional() || (!folder && type.find("FILE") == std::string::npos)) continue;
    for (const std::string& value : option->results())
      if (value.empty())
        return fmt::format("{}: expected the name of a {}, found ''", option->get_name(),
                           folder ? "folder" : "file");
  }
  for (const CLI::App* inner : command.get_subcommands())
    if (std::string wrong = findEmptyName(*inner); !wrong.empty()) return wrong;
  return {};
}

}  // namespace weft::app
