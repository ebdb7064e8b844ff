#include "app/session/option_parts.h"

#include <fmt/format.h>

#include <charconv>

namespace weft::app {

bool parseNumber(const std::string& text, std::uint32_t& out) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  return error == std::errc{} && end == text.data() + text.size();
}

bool parsePair(const std::string& text, char separator, std::uint32_t& a, std::uint32_t& b) {
  const std::size_t at = text.find(separator);
  return at != std::string::npos && parseNumber(text.substr(0, at), a) && parseNumber(text.substr(at + 1), b);
}

std::string checkSize(const std::string& text) {
  std::uint32_t width = 0, height = 0;
  const bool good =
      parsePair(text, 'x', width, height) && width >= 1 && height >= 1 && width <= 16384 && height <= 16384;
  return good ? "" : "expected WIDTHxHEIGHT, each from 1 to 16384, found '" + text + "'";
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

std::string checkSet(const std::string& text) {
  const std::size_t at = text.find('=');
  return at != std::string::npos && at > 0 ? "" : "expected NAME=VALUE, found '" + text + "'";
}

CLI::Option* addGraphOptions(CLI::App& command, Options& options, RawOptions& raw) {
  CLI::Option* graph = command.add_option("graph", options.graph, "graph file (JSON)")->required();
  command.add_option("--scene", options.scene, "scene file (default: the bundled scenes/spheres.json)");
  command.add_option("--camera", options.camera, "camera of the scene to look through (default: its first)");
  command.add_option("--materials", options.materials,
                     "material library for the scene's grid, instead of the one it names");
  command.add_option("--environment", options.environment,
                     "environment map, .hdr or .exr; for view also a folder of them");
  command.add_option("--size", raw.size, "size of the screen in pixels")
      ->check(CLI::Validator(checkSize, "WxH"));
  command.add_option(
      "--preset", options.presets,
      "lay an overlay over the graph: a file, or the name of one in graphs/presets; repeatable");
  command.add_option("--disable", options.disables,
                     "disable a pass (any unique suffix of its name); repeatable");
  command.add_option("--set", raw.sets, "set a parameter (any unique suffix of its name); repeatable")
      ->check(CLI::Validator(checkSet, "NAME=VALUE"));
  return graph;
}

void addBackendOptions(CLI::App& command, Options& options) {
  command.add_option("--backend", options.backend, "where OpenGL comes from")
      ->check(CLI::IsMember({"auto", "osmesa", "egl", "glfw"}));
  command.add_option("--program-cache", options.cacheFolder, "folder for program binaries, or 'none'");
}

void addDeviceOptions(CLI::App& command, Options& options) {
  addBackendOptions(command, options);
  command.add_flag("--stats", options.stats, "print counters and times as JSON on standard error when done");
  command.add_option("--trace", options.trace,
                     "write a Chrome trace of the frames, for ui.perfetto.dev (measures each pass)");
  command.add_flag("--profile", options.profile,
                   "measure each pass (slower: waits for the GPU after every pass on software)");
}

std::vector<graph::Setting> settingsFrom(const std::vector<std::string>& texts) {
  std::vector<graph::Setting> settings;
  for (const std::string& text : texts) {
    const std::size_t at = text.find('=');
    settings.emplace_back(text.substr(0, at), text.substr(at + 1));
  }
  return settings;
}

}  // namespace weft::app
