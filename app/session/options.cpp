#include "app/session/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <tuple>

#include "app/session/session.h"
#include "engine/text/chars.h"
#include "engine/text/files/file.h"

namespace weft::app {

namespace {

constexpr int kMaxPixels = 16384;  // of a side of a picture

// "640x360" and its kind.
template <class Number>
std::optional<std::pair<Number, Number>> pairIn(std::string_view text, char separator) {
  const std::size_t at = std::min(text.find(separator), text.size());
  const auto first = text::numberIn<Number>(text.substr(0, at));
  const auto second = text::numberIn<Number>(text.substr(std::min(at + 1, text.size())));
  return first && second ? std::optional(std::pair(*first, *second)) : std::nullopt;
}

}  // namespace

CLI::Option* Options::addGraph(CLI::App& command) {
  CLI::Option* file = addPath(command, "graph", graph, "graph file (JSON)")->required();
  addWorld(command);
  addPath(command, "--preset", presets,
          "overlay over the graph: a file or a name of 'weft presets'; repeatable");
  addPresetFolder(command);
  addDisables(command, "--disable", disables, "disable a pass (any unique suffix of its name); repeatable");
  addSets(command, "--set", sets, "set a parameter (any unique suffix of its name); repeatable");
  return file;
}

void Options::addWorld(CLI::App& command) {
  addPath(command, "--scene", scene, "scene file (default: the bundled scenes/spheres.json)");
  command.add_option("--camera", camera,
                     "camera of the scene (default: its first), or a pose as the viewer prints it (C)");
  addPath(command, "--materials", materials, "material library for the scene's grid");
  addPath(command, "--environment", environment, "environment map, .hdr or .exr; view: also a folder");
  addSize(command);
}

void OtherOptions::addOther(CLI::App& command) {
  addPath(command, "other", other, "the other graph (default: the same)");
  addSets(command, "--other-set", otherSets, "set a parameter of the other alone; repeatable");
  addDisables(command, "--other-disable", otherDisables, "disable a pass of the other alone; repeatable");
  addPath(command, "--other-preset", otherPresets, "overlay over the other alone; repeatable");
}

Options OtherOptions::otherSide() const {
  Options side = *this;
  if (!other.empty()) side.graph = other;
  side.sets.insert(side.sets.end(), otherSets.begin(), otherSets.end());
  side.disables.insert(side.disables.end(), otherDisables.begin(), otherDisables.end());
  side.presets.insert(side.presets.end(), otherPresets.begin(), otherPresets.end());
  side.finish();
  return side;
}

void Options::addSize(CLI::App& command) {
  addTaken(
      command, "--size", [this](const std::string& text) { return takeSize(text, width, height); }, "WxH",
      "size of the screen in pixels");
}

void Options::addPresetFolder(CLI::App& command) {
  command.add_option("--preset-folder", presetFolder, "where names of presets are looked for first")
      ->check(CLI::ExistingDirectory)
      ->type_name("FOLDER");
}

void Options::addMeasurements(CLI::App& command) {
  command.add_flag("--stats", stats, "print counters and times as JSON on standard error when done");
  command.add_flag("--profile", profile, "measure each pass (slower on software)");
}

CLI::Option* Options::addFrame(CLI::App& command, const char* name) {
  return addTaken(
      command, name, [this](const std::string& text) { return takeCount(text, lastFrame); }, "FRAME",
      "frame to look at (default: 0)");
}

void Options::addFps(CLI::App& command, const char* doc) {
  command.add_option("--fps", fps, doc)->check(numberFrom(1, 1000));
}

void Options::addDrawing(CLI::App& command) {
  addFps(command);
  addBackend(command);
  addTaken(
      command, "--mouse", [this](const std::string& text) { return takePointer(text, pointer); },
      "X,Y[,down]", "where the mouse is: pixels from the lower left corner; down: its button is held");
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

std::string quoted(const std::string& word) {
  const bool plain = !word.empty() && std::ranges::all_of(word, [](unsigned char c) {
    return std::isalnum(c) ||
           std::string_view("_-./=,:+@%").find(static_cast<char>(c)) != std::string_view::npos;
  });
  std::string out;
  for (const char c : word) out += c == '\'' ? "'\\''" : std::string(1, c);
  return plain ? word : "'" + out + "'";
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
    const auto x = text::numberIn<double>(text);
    if (x && *x >= low && *x <= high) return {};
    return fmt::format("expected a number from {} to {}, found '{}'", low, high, text);
  };
  return {check, fmt::format("{} to {}", low, high)};
}

CLI::Option* addTaken(CLI::App& command, const char* name,
                      const std::function<std::string(const std::string&)>& take, const char* type,
                      const std::string& doc) {
  const auto ignore = [](const std::string&) {};  // the check has taken it
  return command.add_option_function<std::string>(name, ignore, doc)->check(CLI::Validator(take, type));
}

std::string takeSize(const std::string& text, std::uint32_t& width, std::uint32_t& height) {
  const auto isSide = [](std::uint32_t pixels) { return pixels >= 1 && pixels <= kMaxPixels; };
  const auto size = pairIn<std::uint32_t>(text, 'x');
  if (!size || !isSide(size->first) || !isSide(size->second))
    return fmt::format("expected WIDTHxHEIGHT, each from 1 to {}, found '{}'", kMaxPixels, text);
  std::tie(width, height) = *size;
  return {};
}

std::string takeCount(const std::string& text, std::uint32_t& count) {
  const auto number = text::numberIn<std::uint32_t>(text);
  count = number.value_or(0);
  return number ? "" : fmt::format("expected a number of frames up to {}, found '{}'", ~0u, text);
}

std::string takePointer(const std::string& text, imports::Pointer& pointer) {
  constexpr std::string_view kHeld = ",down";
  const bool held = text.ends_with(kHeld);
  const auto isIn = [](float pixels) { return pixels >= 0 && pixels <= kMaxPixels; };
  const auto at = pairIn<float>(text.substr(0, text.size() - (held ? kHeld.size() : 0)), ',');
  if (!at || !isIn(at->first) || !isIn(at->second))
    return fmt::format("expected X,Y or X,Y,down, pixels from 0 to {}, found '{}'", kMaxPixels, text);
  pointer = {.position = {at->first, at->second}, .down = held};
  if (held) pointer.pressed = pointer.dragged = pointer.position;
  return {};
}

std::string checkSet(const std::string& text) {
  const std::size_t at = text.find('=');
  return at != std::string::npos && at > 0 ? "" : "expected NAME=VALUE, found '" + text + "'";
}

}  // namespace weft::app
