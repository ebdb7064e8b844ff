#include "app/session/option_parts.h"

#include "app/session/option_checks.h"

namespace weft::app {

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
      "lay an overlay over the graph: a file, or the name of one that 'weft presets' lists; repeatable");
  addPresetFolder(command, options);
  command.add_option("--disable", options.disables,
                     "disable a pass (any unique suffix of its name); repeatable");
  command.add_option("--set", raw.sets, "set a parameter (any unique suffix of its name); repeatable")
      ->check(CLI::Validator(checkSet, "NAME=VALUE"));
  return graph;
}

void addPresetFolder(CLI::App& command, Options& options) {
  command
      .add_option(
          "--preset-folder", options.presetFolder,
          "look for the names of presets here first, then in ~/.config/weft/presets, then in graphs/presets")
      ->check(CLI::Validator(checkFolder, "FOLDER"));
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
