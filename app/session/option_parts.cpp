#include "app/session/option_parts.h"

#include "app/session/option_checks.h"

namespace weft::app {

CLI::Option* addGraphOptions(CLI::App& command, Options& options, RawOptions& raw) {
  CLI::Option* graph =
      command.add_option("graph", options.graph, "graph file (JSON)")->required()->type_name("FILE");
  command.add_option("--scene", options.scene, "scene file (default: the bundled scenes/spheres.json)")
      ->type_name("FILE");
  command.add_option("--camera", options.camera, "camera of the scene to look through (default: its first)");
  command
      .add_option("--materials", options.materials,
                  "material library for the scene's grid, instead of the one it names")
      ->type_name("FILE");
  command
      .add_option("--environment", options.environment,
                  "environment map, .hdr or .exr; for view also a folder of them")
      ->type_name("FILE");
  command.add_option("--size", raw.size, "size of the screen in pixels")
      ->check(CLI::Validator(checkSize, "WxH"));
  command
      .add_option(
          "--preset", options.presets,
          "lay an overlay over the graph: a file, or the name of one that 'weft presets' lists; repeatable")
      ->type_name("FILE");
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

void addPointerOption(CLI::App& command, Options& options) {
  command
      .add_option(
          "--mouse", options.mouse,
          "where the mouse points in every frame, for graphs that read it: pixels from the lower left "
          "corner of the picture; with ',down' its button is held from frame 0 on (default: 0,0)")
      ->check(CLI::Validator(checkPointer, "X,Y[,down]"));
}

void addBackendOptions(CLI::App& command, Options& options) {
  command.add_option("--backend", options.backend, "where OpenGL comes from")
      ->check(CLI::IsMember({"auto", "osmesa", "egl", "glfw"}));
  command.add_option("--program-cache", options.cacheFolder, "folder for program binaries, or 'none'")
      ->check(CLI::Validator(checkCacheFolder, "FOLDER"));
}

void addDeviceOptions(CLI::App& command, Options& options) {
  addBackendOptions(command, options);
  command.add_flag("--stats", options.stats, "print counters and times as JSON on standard error when done");
  command.add_flag("--profile", options.profile,
                   "measure each pass (slower: waits for the GPU after every pass on software)");
}

std::vector<graph::Setting> settingsFrom(const std::vector<std::string>& texts, const char* option) {
  std::vector<graph::Setting> settings;
  for (const std::string& text : texts) {
    const std::size_t at = text.find('=');
    settings.emplace_back(text.substr(0, at), text.substr(at + 1)).option = option;
  }
  return settings;
}

}  // namespace weft::app
