// weft view: a graph in a window, with a camera to move; files that change on disk take effect at once. Declared in viewer.h.

#include <filesystem>

#include "app/output/output_files.h"
#include "app/output/standard_streams.h"
#include "app/view/viewer.h"

namespace weft::app {

namespace {

// Whether saving a file may make it good: it is there, and the command line is right.
bool canBeFixed(const ViewOptions& options, const text::Diagnostics& diagnostics) {
  std::error_code ignored;
  for (const std::string& file : {options.graph, scenePathOf(options)})
    if (!std::filesystem::is_regular_file(file, ignored)) return false;
  return std::ranges::none_of(diagnostics.items(), [](const text::Diagnostic& each) {
    return each.severity == text::Severity::error && !each.place.file;
  });
}

int runView(ViewOptions& options) {
  text::Diagnostics diagnostics;
  options.window = true;
  options.recallPlaces();
  const std::uint32_t last = options.maxFrames ? options.maxFrames - 1 : 0;
  if (!options.screenshot.empty()) checkOutput(options.screenshot, last, false, diagnostics);
  if (!options.record.empty()) checkOutput(options.record, 0, true, diagnostics);
  Options files = options;
  if (!files.environment.empty())
    files.environment = firstEnvironment(options.environment, diagnostics).value_or("");
  if (diagnostics.hasErrors()) return report(diagnostics);
  auto session = openDevice(options, diagnostics);
  if (!session) {
    planOf(files,
           diagnostics);  // a mistake in the files is no failure of the machine
    report(diagnostics);
    return 3;
  }
  if (!session->context->window()) {
    printError(fmt::format(
        "weft view needs a window, which '{}' has not: leave --backend out, or use `xvfb-run -a`\n",
        options.backend));
    return 2;
  }
  graph::Settings settings = settingsOf(options, session->context->device().software, true);
  const gl::Size size = session->context->framebufferSize();
  settings.screenWidth = std::max(1u, size.width);
  settings.screenHeight = std::max(1u, size.height);
  // A recording is to be what `weft render` makes: it waits for the environment.
  const bool wait = options.waitForAssets || !options.record.empty();
  Options first = files;
  if (!wait) first.environment.clear();
  // Models come while the window is open, too.
  const bool later = !wait && scene::namesModels(scenePathOf(files));
  auto world = later ? std::nullopt : loadWorld(first, diagnostics);
  if (!world) {
    if (wait && !files.environment.empty()) return report(diagnostics);
    diagnostics.clear();  // the scene is read again, and says it again
    scene::Scene empty;
    if (later) empty.cameras.add({.name = "default", .pose = {.position = {0, 0, 20}}});
    world.emplace(std::move(empty));
  }
  if (!files.environment.empty() && !world->environment()) world->expectEnvironment();
  int code = 0;
  nlohmann::ordered_json stats;
  {
    LiveGraph live(files, session->renderer, std::move(*world), std::move(settings));
    if (later) live.expectScene();
    const auto server = options.serve ? PageServer::open(*options.serve, diagnostics) : nullptr;
    if (options.serve && !server) return report(diagnostics);
    if (server) printNow(fmt::format("serving {}\n", server->address()));
    Viewer viewer(options, *session, live, server.get());
    // With a number of frames to draw there is nobody who could save a file.
    if (!live.load(diagnostics) && (options.maxFrames || !canBeFixed(options, diagnostics)))
      return report(diagnostics);
    const OutputFile outputs[] = {{"--screenshot", outputNameOf(options.screenshot, last).value_or("")},
                                  {"--record", options.record}};
    if (!checkDistinct(outputs, diagnostics, live.files())) return report(diagnostics);
    code = viewer.run(std::move(diagnostics));
    if (options.stats) {
      stats = statsOf(*session, {{"frames", viewer.frames()}, {"redraws", viewer.redraws()}});
      stats["live_values_set"] = live.livesSet();
    }
  }
  const std::string left = closeDevice(std::move(session));
  stats["gl_objects_left"] = left;
  if (options.stats) printError(text::dumpJson(stats) + "\n");
  return code;
}

}  // namespace

void addView(CommandLine& line) {
  const auto [command, options] =
      line.add("view", "run a graph in a window (without a display: xvfb-run -a)", runView);
  options.addGraph(command);
  options.width = options.height = 0;  // as before, unless --size says
  options.addBackend(command);
  options.addMeasurements(command);
  addTaken(
      command, "--max-frames",
      [&frames = options.maxFrames](const std::string& text) { return takeCount(text, frames); }, "FRAMES",
      "close after so many frames (0: never)");
  command.add_flag("--wait-for-assets", options.waitForAssets,
                   "show nothing before the environment is there");
  command.add_option("--panels", options.panels, "panels to bring to the front at the start")
      ->delimiter(',')
      ->check(CLI::IsMember(ui::Panels::names()));
  command.add_option("--editor", options.editor,
                     "text editor, as 'code -g {file}:{line}' (default: VISUAL or EDITOR, with +LINE FILE)");
  command
      .add_option("--serve", options.serve,
                  "show the page of `weft report`, live, at a port of this machine (0: any free one)")
      ->type_name("PORT")
      ->check(CLI::Range(0, 65535));
  command.add_flag("--events", options.events, "say what happens, a line each, for scripts");
  command.add_flag("!--no-ui", options.ui, "the picture alone, without panels");
  addPath(command, "--screenshot", options.screenshot, "picture of the last frame, .png or .exr");
  addPath(command, "--record", options.record, "write every frame, at a fixed step: f_%04d.png");
  options.addFps(command, "frames per second of recordings");
  command.add_flag("!--no-vsync", options.vsync, "do not wait for the screen's refresh");
  command.add_flag("--idle", options.idle, "draw only when something changed");
  command.add_option("--render-scale", options.renderScale, "pixels of the scene per pixel of the window")
      ->check(numberFrom(0.1, 4));
  command
      .add_option("--moving-scale", options.movingScale,
                  "of the render scale, while the camera is moved (default: where frames are slow, half or a "
                  "quarter)")
      ->check(numberFrom(0.1, 1));
  command.add_option("--ui-scale", options.uiScale, "size of the panels (default: the screen's)")
      ->check(numberFrom(0.25, 8));
}

}  // namespace weft::app
