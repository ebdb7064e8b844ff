#include "app/session/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>

#include "app/session/session.h"
#include "engine/text/files/file_access.h"

namespace weft::app {

namespace {

constexpr int kMaxPixels = 16384;  // of a side of a picture

std::optional<double> numberIn(std::string_view text, double low, double high) {
  double x = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  const bool good = error == std::errc{} && end == text.data() + text.size() && x >= low && x <= high;
  return good ? std::optional(x) : std::nullopt;
}

}  // namespace

CLI::Option* Options::addGraph(CLI::App& command) {
  CLI::Option* file = addPath(command, "graph", graph, "graph file (JSON)")->required();
  addPath(command, "--scene", scene, "scene file (default: the bundled scenes/spheres.json)");
  command.add_option("--camera", camera, "camera of the scene to look through (default: its first)");
  addPath(command, "--materials", materials,
          "material library for the scene's grid, instead of the one it names");
  addPath(command, "--environment", environment,
          "environment map, .hdr or .exr; for view also a folder of them");
  addSize(command);
  addPath(command, "--preset", presets,
          "lay an overlay over the graph: a file, or the name of one that 'weft presets' lists; repeatable");
  addPresetFolder(command);
  addDisables(command, "--disable", disables, "disable a pass (any unique suffix of its name); repeatable");
  addSets(command, "--set", sets, "set a parameter (any unique suffix of its name); repeatable");
  return file;
}

void Options::addSize(CLI::App& command) {
  command
      .add_option_function<std::string>(
          "--size", [this](const std::string& text) { parsePair(text, 'x', width, height); },
          "size of the screen in pixels")
      ->check(CLI::Validator(checkSize, "WxH"));
}

void Options::addPresetFolder(CLI::App& command) {
  command
      .add_option(
          "--preset-folder", presetFolder,
          "look for the names of presets here first, then in ~/.config/weft/presets, then in graphs/presets")
      ->check(CLI::ExistingDirectory)
      ->type_name("FOLDER");
}

void Options::addMeasurements(CLI::App& command) {
  command.add_flag("--stats", stats, "print counters and times as JSON on standard error when done");
  command.add_flag("--profile", profile,
                   "measure each pass (slower: waits for the GPU after every pass on software)");
}

CLI::Option* Options::addFrame(CLI::App& command, const char* name) {
  return command.add_option(name, lastFrame, "number of the frame to look at (default: 0)")
      ->check(CLI::Validator(checkCount, "FRAME"));
}

void Options::addFps(CLI::App& command, const char* doc) {
  command.add_option("--fps", fps, doc)->check(numberFrom(1, 1000));
}

void Options::addPointer(CLI::App& command) {
  command
      .add_option_function<std::string>(
          "--mouse", [this](const std::string& text) { pointer = *parsePointer(text); },
          "where the mouse points in every frame, for graphs that read it: pixels from the lower left "
          "corner of the picture; with ',down' its button is held from frame 0 on (default: 0,0)")
      ->check(CLI::Validator(checkPointer, "X,Y[,down]"));
}

void Options::addBackend(CLI::App& command) {
  addChoice(command, "--backend", backend, "where OpenGL comes from", {"auto", "osmesa", "egl", "glfw"});
  command.add_option("--program-cache", cacheFolder, "folder for program binaries, or 'none'")
      ->check(CLI::ExistingDirectory | CLI::NonexistentPath)
      ->type_name("FOLDER");
}

void Options::finish() {
  for (std::string& preset : presets) text::chooseFile(preset = presetFile(preset, presetFolder));
  for (const graph::Setting& set : sets) text::chooseFile(set.text);  // where the parameter is a file
}

CLI::Option* addPath(CLI::App& command, const std::string& name, std::string& path, const std::string& doc,
                     const char* type) {
  return command.add_option(name, path, doc)->type_name(type);
}

CLI::Option* addPath(CLI::App& command, const std::string& name, std::vector<std::string>& paths,
                     const std::string& doc) {
  return command.add_option(name, paths, doc)->type_name("FILE");
}

CLI::Option* addChoice(CLI::App& command, const std::string& name, std::string& word, const std::string& doc,
                       const std::vector<std::string>& words) {
  return command.add_option(name, word, doc)->check(CLI::IsMember(words));
}

CLI::Option* addSets(CLI::App& command, const char* name, std::vector<graph::Setting>& sets,
                     const std::string& doc) {
  const auto take = [&sets, name](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      const std::size_t at = text.find('=');
      sets.emplace_back(text.substr(0, at), text.substr(at + 1)).option = name;
    }
  };
  return command.add_option_function<std::vector<std::string>>(name, take, doc)
      ->check(CLI::Validator(checkSet, "NAME=VALUE"));
}

CLI::Option* addDisables(CLI::App& command, const char* name, std::vector<graph::Disable>& disables,
                         const std::string& doc) {
  const auto take = [&disables, name](const std::vector<std::string>& passes) {
    for (const std::string& pass : passes) disables.emplace_back(pass).option = name;
  };
  return command.add_option_function<std::vector<std::string>>(name, take, doc);
}

CLI::Validator numberFrom(double low, double high) {
  const auto check = [low, high](const std::string& text) -> std::string {
    return numberIn(text, low, high)
               ? ""
               : fmt::format("expected a number from {} to {}, found '{}'", low, high, text);
  };
  return {check, fmt::format("{} to {}", low, high)};
}

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
  const std::size_t comma = std::min(rest.find(','), rest.size());
  const auto x = numberIn(rest.substr(0, comma), 0, kMaxPixels);
  const auto y = numberIn(rest.substr(std::min(comma + 1, rest.size())), 0, kMaxPixels);
  if (!x || !y) return std::nullopt;
  pointer.position[0] = static_cast<float>(*x);
  pointer.position[1] = static_cast<float>(*y);
  if (pointer.down) pointer.pressed = pointer.dragged = pointer.position;
  return pointer;
}

std::string checkCount(const std::string& text) {
  std::uint32_t count = 0;
  return parseNumber(text, count)
             ? ""
             : fmt::format("expected a number of frames up to {}, found '{}'", ~0u, text);
}

std::string checkPointer(const std::string& text) {
  if (parsePointer(text)) return "";
  return fmt::format(
      "expected X,Y or X,Y,down: pixels from the lower left corner of the picture, each from 0 to {}, found "
      "'{}'",
      kMaxPixels, text);
}

std::string checkSize(const std::string& text) {
  std::uint32_t width = 0, height = 0;
  const bool good = parsePair(text, 'x', width, height) && width >= 1 && height >= 1 && width <= kMaxPixels &&
                    height <= kMaxPixels;
  return good ? "" : fmt::format("expected WIDTHxHEIGHT, each from 1 to {}, found '{}'", kMaxPixels, text);
}

bool parseRange(const std::string& text, std::uint32_t& first, std::uint32_t& last) {
  if (text.find(':') != std::string::npos) return parsePair(text, ':', first, last) && first <= last;
  const bool good = parseNumber(text, first);
  last = first;
  return good;
}

std::string checkRange(const std::string& text) {
  std::uint32_t first = 0, last = 0;
  if (parseRange(text, first, last)) return "";
  return fmt::format(
      "expected NUMBER or FIRST:LAST with FIRST <= LAST, whole numbers from 0 to {}, found '{}'", ~0u, text);
}

std::string checkSet(const std::string& text) {
  const std::size_t at = text.find('=');
  return at != std::string::npos && at > 0 ? "" : "expected NAME=VALUE, found '" + text + "'";
}

}  // namespace weft::app
