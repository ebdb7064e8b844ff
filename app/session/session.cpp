#include "app/session/session.h"

#include <cstdlib>
#include <filesystem>
#include <future>

#include "app/output/standard_streams.h"
#include "engine/assets/environments/environment_map.h"
#include "engine/graph/compile/compile.h"
#include "engine/graph/read/read.h"
#include "engine/runtime/imports/registry.h"
#include "engine/scene/files/scene_file.h"
#include "engine/text/message_choice.h"

namespace weft::app {

std::string presetsFolder() {
  return dataFolder() + "/graphs/presets";
}

std::vector<std::string> presetFolders(const std::string& own) {
  std::vector<std::string> folders;
  if (!own.empty()) folders.push_back(own);
  const char* config = std::getenv("XDG_CONFIG_HOME");
  const char* home = std::getenv("HOME");
  if (config && *config)
    folders.push_back(std::string(config) + "/weft/presets");
  else if (home && *home)
    folders.push_back(std::string(home) + "/.config/weft/presets");
  folders.push_back(presetsFolder());
  return folders;
}

std::string presetFile(const std::string& preset, const std::string& own) {
  std::error_code ignored;
  const bool name = !preset.empty() && preset.find_first_of("/.") == std::string::npos;
  const auto here = std::filesystem::status(preset, ignored);
  if (!name || (std::filesystem::exists(here) && !std::filesystem::is_directory(here))) return preset;
  std::string file;
  for (const std::string& folder : presetFolders(own)) {
    file = folder + "/" + preset + ".json";
    if (std::filesystem::exists(file, ignored)) break;
  }
  return file;
}

runtime::WorldFacts factsWithoutWorld() {
  runtime::WorldFacts facts;
  for (const std::string& list : scene::drawListNames()) facts.lists.push_back({list, 0});
  // What the scene that could not be read has is not known, and nothing is said of it.
  facts.sun = facts.ground = true;
  facts.lamps = facts.castingLamps = 1;
  return facts;
}

graph::Settings settingsOf(const Options& options, bool software) {
  return {.screenWidth = options.width,
          .screenHeight = options.height,
          .software = software,
          .sets = options.sets,
          .disables = options.disables,
          .kept = options.kept};
}

std::string scenePathOf(const Options& options) {
  return options.scene.empty() ? dataFolder() + "/scenes/spheres.json" : options.scene;
}

scene::SceneChoice sceneChoiceOf(const Options& options) {
  return {.camera = options.camera, .materials = options.materials};
}

std::optional<runtime::World> loadWorld(const Options& options, text::Diagnostics& diagnostics) {
  std::optional<scene::Scene> scene;
  std::shared_ptr<const assets::EnvironmentMap> environment;
  if (!options.environment.empty()) {
    text::Diagnostics said;
    auto loading = std::async(std::launch::async, [&] {  // beside the scene
      return assets::loadEnvironmentMap(options.environment, said);
    });
    scene = scene::loadScene(scenePathOf(options), diagnostics, nullptr, sceneChoiceOf(options));
    if (auto map = loading.get())
      environment = std::make_shared<const assets::EnvironmentMap>(std::move(*map));
    diagnostics.append(said);
  } else {
    scene = scene::loadScene(scenePathOf(options), diagnostics, nullptr, sceneChoiceOf(options));
  }
  if (!scene || diagnostics.hasErrors()) return std::nullopt;
  runtime::World world(std::move(*scene));
  if (environment) world.setEnvironment(std::move(environment));
  return world;
}

std::shared_ptr<const graph::Plan> makePlan(const Options& options, const runtime::WorldFacts& facts,
                                            bool software, text::Diagnostics& diagnostics) {
  const auto desc = graph::readGraph(options.graph, options.presets, diagnostics);
  if (!desc) return nullptr;
  const auto registry = runtime::makeRegistry({}, facts);
  const auto flat = graph::expandGraph(*desc, registry, settingsOf(options, software), diagnostics);
  if (!flat || diagnostics.hasErrors()) return nullptr;
  auto plan = std::make_shared<const graph::Plan>(graph::compile(flat));
  return graph::checkMemory(*plan, diagnostics) ? plan : nullptr;
}

std::shared_ptr<const graph::Plan> planOf(const Options& options, text::Diagnostics& diagnostics) {
  const auto world = loadWorld(options, diagnostics);
  return makePlan(options, world ? world->facts() : factsWithoutWorld(), true, diagnostics);
}

bool isWrong(const Options& options, const runtime::WorldFacts& facts, text::Diagnostics& diagnostics) {
  std::vector<std::string> named{options.graph};
  named.insert(named.end(), options.presets.begin(), options.presets.end());
  for (const graph::Setting& set : options.sets) named.push_back(set.text);  // where the parameter is a file
  std::error_code ignored;
  for (const std::string& path : named)
    if (std::filesystem::is_fifo(path, ignored)) return false;
  text::Diagnostics said, onHardware;
  if (makePlan(options, facts, true, said) || makePlan(options, facts, false, onHardware)) return false;
  diagnostics.append(said);
  return true;
}

int report(text::Diagnostics& diagnostics, bool notes) {
  diagnostics.sortByPlace();
  printError(text::chooseMessages(diagnostics, notes).text());
  return diagnostics.hasErrors() ? 1 : 0;
}

}  // namespace weft::app
