// weft view: a graph in a window, with a camera to move; files that change on disk take effect at once.
#include "app/view/view.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include "app/live/live_environment.h"
#include "app/output/output_files.h"
#include "app/output/standard_streams.h"
#include "app/session/frame_limit.h"
#include "app/session/session.h"
#include "app/view/viewer.h"
#include "engine/scene/files/scene_file.h"

namespace weft::app {

namespace {

// The number of the last frame; 0 when nobody knows it.
std::uint32_t lastFrameOf(const Options& options) {
  return options.maxFrames ? options.maxFrames - 1 : 0;
}

// Whether saving a file may make it good: nobody is to wait for a file that is not there, or for a wrong
// command line.
bool canBeFixed(const Options& options, const base::Diagnostics& diagnostics) {
  std::error_code ignored;
  for (const std::string& file : {options.graph, scenePathOf(options)})
    if (!std::filesystem::is_regular_file(file, ignored)) return false;
  return std::ranges::none_of(diagnostics.items(), [](const base::Diagnostic& each) {
    return each.severity == base::Severity::error && !each.place.file;
  });
}

// Runs before the window opens. The frames of a recording have no end unless --max-frames gives one.
bool checkOutputs(const Options& options, base::Diagnostics& diagnostics) {
  checkFrameCount(options.maxFrames, base::placeOfOption(fmt::format("--max-frames {}", options.maxFrames)),
                  {}, diagnostics, ", or leave --max-frames out: the window then stays until it is closed");
  if (!options.screenshot.empty()) checkOutput(options.screenshot, lastFrameOf(options), false, diagnostics);
  if (!options.record.empty()) checkOutput(options.record, 0, true, diagnostics);
  return !diagnostics.hasErrors();
}

// Runs when all files that are read are known.
bool checkInputs(const Options& options, const LiveGraph& live, base::Diagnostics& diagnostics) {
  const std::uint32_t last = lastFrameOf(options);
  const OutputFile outputs[] = {{"--screenshot", outputNameOf(options.screenshot, last).value_or("")},
                                {"--record", options.record, 0, options.maxFrames ? last : ~0u}};
  std::vector<std::string> inputs = live.files();
  inputs.push_back(options.graph);
  const bool known = options.maxFrames > 0;
  return checkDistinct(outputs, inputs, diagnostics) &&
         (!known || options.record.empty() || makeFolders(options.record, 0, last, diagnostics));
}

}  // namespace

int runView(const Options& options) {
  base::Diagnostics diagnostics;
  if (!checkOutputs(options, diagnostics)) return report(diagnostics);
  Options files = options;
  if (!files.environment.empty())
    files.environment = firstEnvironment(options.environment, diagnostics).value_or("");
  if (diagnostics.hasErrors()) return report(diagnostics);
  auto session = openDevice(options, diagnostics);
  if (!session) {
    // A mistake in the files is no failure of the machine.
    const auto world = loadWorld(files, diagnostics);
    makePlan(files, world ? world->facts() : factsWithoutWorld(), true, diagnostics);
    report(diagnostics);
    return 3;
  }
  if (!session->context->window()) {
    printError(fmt::format(
        "weft view needs a window, which the backend '{}' has not: leave --backend out; without a display "
        "use `xvfb-run -a`, or `weft render`\n",
        options.backend));
    return 2;
  }
  graph::Settings settings = settingsOf(options, session->context->device().software);
  const gl::Size size = session->context->framebufferSize();
  settings.screenWidth = std::max(1u, size.width);
  settings.screenHeight = std::max(1u, size.height);
  // A recording is to be what `weft render` makes: it waits. Otherwise the environment comes while the window
  // is open.
  const bool wait = options.waitForAssets || !options.record.empty();
  Options first = files;
  if (!wait) first.environment.clear();
  // Models come while the window is open, too. A pipe can be read once: it is read by loadWorld.
  const std::string scenePath = scenePathOf(files);
  std::error_code none;
  const bool later =
      !wait && std::filesystem::is_regular_file(scenePath, none) && scene::namesModels(scenePath);
  std::optional<runtime::World> world;
  if (later) {
    scene::Scene empty;
    empty.cameras.add({.name = "default", .pose = {.position = {0, 0, 20}}});
    world.emplace(std::move(empty));
  } else {
    world = loadWorld(first, diagnostics);
  }
  if (!world) {
    if (wait && !files.environment.empty()) return report(diagnostics);
    std::error_code ignored;
    if (std::filesystem::is_regular_file(scenePathOf(files), ignored))
      diagnostics.clear();  // the scene is read again, and says it again
    world.emplace(scene::Scene{});
  }
  if (!files.environment.empty() && !world->environment()) world->expectEnvironment();
  int code = 0;
  nlohmann::ordered_json stats;
  {
    LiveGraph live(files, session->renderer, std::move(*world), std::move(settings));
    if (later) live.expectScene();
    // With a number of frames to draw there is nobody who could save a file.
    if (!live.load(diagnostics) && (options.maxFrames || !canBeFixed(options, diagnostics)))
      return report(diagnostics);
    if (!checkInputs(options, live, diagnostics)) return report(diagnostics);
    Viewer viewer(options, *session, live, std::move(diagnostics));
    code = viewer.run();
    if (options.stats) {
      stats = statsOf(*session, {{"frames", viewer.frames()}, {"redraws", viewer.redraws()}});
      stats["live_values_set"] = live.livesSet();
      if (const auto allocations = live.liveAllocations()) stats["live_allocations"] = *allocations;
    }
  }
  const std::string left = closeDevice(std::move(session));
  stats["gl_objects_left"] = left;
  if (options.stats) printStats(stats);
  return code;
}

}  // namespace weft::app
