#include "app/session/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <sstream>
#include <utility>

#include "app/output/standard_streams.h"
#include "app/session/option_checks.h"
#include "app/session/option_parts.h"
#include "app/session/session.h"
#include "app/session/trial_options.h"
#include "engine/base/files/file_access.h"
#include "engine/base/nearest.h"
#include "engine/base/printable.h"

namespace weft::app {

namespace {

// What the command line names is the person's own choice, also where reading is confined, and may be a pipe.
void chooseFiles(const Options& options) {
  for (const std::string* file :
       {&options.graph, &options.otherGraph, &options.scene, &options.environment, &options.materials,
        &options.frameGraph, &options.trial.folder, &options.foreignFile})
    base::chooseFile(*file);
  for (const std::string& preset : options.presets) base::chooseFile(preset);
  for (const std::string& preset : options.trial.otherPresets) base::chooseFile(preset);
  for (const std::string& file : options.files) base::chooseFile(file);
  for (const graph::Setting& set : options.sets) base::chooseFile(set.text);  // where the parameter is a file
  for (const char* folder : {"graphs", "shaders", "scenes", "materials"})
    base::allowFolder(dataFolder() + "/" + folder);
}

// With those of commands behind them: "pass" of "new".
std::vector<CLI::App*> allCommands(CLI::App& app) {
  std::vector<CLI::App*> commands;
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
    commands.push_back(command);
    const std::vector<CLI::App*> inner = allCommands(*command);
    commands.insert(commands.end(), inner.begin(), inner.end());
  }
  return commands;
}

// Text as messages print it.
std::string shown(const std::string& text) {
  return base::shortened(base::printable(text));
}

// Whether there was one.
bool tellUnknownOption(const CLI::App& command, int argc, char** argv) {
  std::vector<std::string> names;
  std::string title = command.get_name();
  const auto take = [&](const CLI::App& part) {
    for (const CLI::Option* option : part.get_options())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  };
  take(command);
  for (const CLI::App* inner : command.get_subcommands()) {  // what was written: "pass" behind "new"
    take(*inner);
    title += " " + inner->get_name();
  }
  bool told = false;
  for (int i = 2; i < argc; ++i) {
    const std::string argument = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
    if (!argument.starts_with("--") || std::ranges::find(names, argument) != names.end()) continue;
    const std::string near = base::nearestName(argument, names);
    printError(
        fmt::format("weft {}: unknown option '{}'; {}\n", title, shown(argument),
                    near.empty() ? "--help lists what there is" : fmt::format("did you mean '{}'?", near)));
    told = true;
  }
  return told;
}

// Help, the version, or what is wrong. 0 when it was asked for.
int tell(const CLI::App& app, const CLI::ParseError& error) {
  std::ostringstream out, err;
  const int code = app.exit(error, out, err);
  print(out.str());
  // What is wrong repeats what was written; the rest is of the parser.
  const std::string said = err.str(), what = error.what();
  const std::size_t twice = what.find(": At Most 1 required");
  const std::string own =
      twice == std::string::npos ? what : what.substr(0, twice) + ": given more than once";
  printError(said.starts_with(what) ? shown(own) + said.substr(what.size()) : said);
  return code;
}

// Whether what stands before a '=' names a texture, and is not the beginning of a path.
bool isMeantAsName(const std::string& text) {
  return !text.empty() && text.find('/') == std::string::npos &&
         (text.find('.') == std::string::npos || text.find_first_of("#[@") != std::string::npos ||
          graph::parsePick(text));
}

// `-o FILE`, `-o NAME=FILE` and `--present NAME`. What is wrong with them, or nothing.
std::string takeOutputs(const RawOptions& raw, Options& options) {
  for (const std::string& text : raw.outputs) {
    const std::size_t at = text.find('=');
    const std::string name = at == std::string::npos ? "" : text.substr(0, at);
    if (at == 0)
      return fmt::format("'-o {0}' has no NAME before the '='; a file of that name is './{0}'", text);
    if (isMeantAsName(name) && at + 1 == text.size())
      return fmt::format("'-o {0}' has no FILE behind the '='; write {0}picture.png", text);
    if (isMeantAsName(name)) {
      // A word that is spelled in another way names nothing; then the graph's names tell which one is near.
      graph::Pick pick = graph::parsePick(name).value_or(graph::Pick{.text = name, .name = name, .pass = {}});
      pick.option = "-o";
      options.picked.push_back({std::move(pick), text.substr(at + 1)});
    } else if (options.output.empty()) {
      options.output = text;
    } else {
      return fmt::format(
          "the picture would be written to '{}' and to '{}'; write NAME=FILE for another texture",
          options.output, text);
    }
  }
  if (raw.present.empty()) return {};
  std::optional<graph::Pick> shown = graph::parsePick(raw.present);
  if (!shown)
    return fmt::format("--present takes a texture such as depth, hdr#1 or 'glow.mip[2]', found '{}'",
                       raw.present);
  if (options.output.empty()) return "--present needs a file: -o FILE";
  shown->option = "--present";
  options.picked.insert(options.picked.begin(), {std::move(*shown), std::exchange(options.output, {})});
  return {};
}

constexpr const char* kWaitForAssets = "--wait-for-assets";

}  // namespace

std::optional<Options> parseOptions(int argc, char** argv, int& exitCode) {
  Options options;
  RawOptions raw;
  CLI::App app("Weft: a frame is a JSON file", "weft");
  app.require_subcommand(1);
  const auto asJson = [&options] { options.format = "json"; };
  app.set_version_flag("--version", fmt::format("weft {}", kVersion));

  CLI::App* render =
      app.add_subcommand("render", "render frames of a graph to image files, without a display");
  addGraphOptions(*render, options, raw);
  addDeviceOptions(*render, options);
  render
      ->add_option("-o,--output", raw.outputs,
                   "image to write, .png or .exr; for several frames a pattern: f_%04d.png; NAME=FILE writes "
                   "a texture of "
                   "the graph: depth=depth.png, 'glow.mip[2]=glow.exr'; repeatable")
      ->type_name("FILE")
      ->required();
  render->add_option(
      "--present", raw.present,
      "show this texture instead of the graph's picture, as the viewer's inspector does: depth, "
      "'hdr after skybox', 'glow.mip[2]'");
  render->add_option("--frames", raw.frames, "a frame number, or FIRST:LAST")
      ->check(CLI::Validator(checkFrames, "A:B"));
  render->add_option("--fps", options.fps, "frames per second of the clock")->check(numberFrom(1, 1000));
  addPointerOption(*render, options);
  render->add_flag(kWaitForAssets, options.waitForAssets,
                   "the first frame waits for everything it needs; always so without a window");
  render->add_flag("--quiet", options.quiet, "no progress bar and no notes");

  CLI::App* dump = app.add_subcommand("dump",
                                      "write what each pass wrote of some resources, as pictures (.png), "
                                      "values (.exr) and bytes (.bin): weft dump "
                                      "graphs/glow.json 'glow*' -o out");
  addGraphOptions(*dump, options, raw);
  dump->add_option(
          "name", options.patterns,
          "names of resources, or any suffix of theirs; * stands for any letters; hdr#2 is a version")
      ->required();
  dump->add_option("-o,--output", options.output, "folder to write to")->required()->type_name("FOLDER");
  dump->add_option("--frames", raw.frames, "the frame to look at")
      ->check(CLI::Validator(checkFrame, "FRAME"));
  dump->add_option("--fps", options.fps, "frames per second of the clock")->check(numberFrom(1, 1000));
  addPointerOption(*dump, options);
  addBackendOptions(*dump, options);
  dump->add_flag("--quiet", options.quiet, "no list of files and no notes");

  CLI::App* view =
      app.add_subcommand("view", "open a window and run a graph in it (without a display: xvfb-run -a)");
  addGraphOptions(*view, options, raw);
  addDeviceOptions(*view, options);
  view->add_option("--max-frames", options.maxFrames,
                   "close after this many frames (0: when the window is closed)")
      ->check(CLI::Validator(checkCount, "FRAMES"));
  view->add_flag(kWaitForAssets, options.waitForAssets,
                 "open the window when the environment is there, not before");
  view->add_option("--panels", options.panels,
                   "show (or hide) at the start: parameters, passes, inspector, profiler, storage, histogram")
      ->delimiter(',')
      ->check(CLI::IsMember({"parameters", "passes", "inspector", "profiler", "storage", "histogram"}));
  view->add_flag("--events", options.events, "say on standard output what happens, a line each, for scripts");
  view->add_flag("!--no-ui", options.ui, "no panels over the picture");
  view->add_option("--screenshot", options.screenshot,
                   "picture to write of the last frame before closing, .png or .exr")
      ->type_name("FILE");
  view->add_option("--record", options.record,
                   "write every frame from the first on, at a fixed step: f_%04d.png, or .exr")
      ->type_name("FILE");
  view->add_option("--fps", options.fps, "frames per second of recordings")->check(numberFrom(1, 1000));
  view->add_flag("!--no-vsync", options.vsync, "do not wait for the screen's refresh");
  view->add_flag("--idle", options.idle, "draw only when something changed");
  view->add_option("--render-scale", options.renderScale,
                   "pixels of the scene per pixel of the window, each way")
      ->check(numberFrom(0.1, 4));
  view->add_option("--ui-scale", options.uiScale, "size of the panels (default: as the screen says)")
      ->check(numberFrom(0.25, 8));

  CLI::App* check =
      app.add_subcommand("check", "report everything wrong with a graph; exit 1 when it cannot run");
  addGraphOptions(*check, options, raw);
  check->add_flag("!--no-shaders", options.shaders, "do not compile the shaders (needs no OpenGL)");
  check->add_option("--format", options.format, "text, json, or sarif for code hosts and editors")
      ->check(CLI::IsMember({"text", "json", "sarif"}));
  check->add_flag(
      "--matrix", options.matrix,
      "also with each pass disabled, each pair of passes, and each value that a parameter offers");
  check->add_flag("--all", options.allVariants,
                  "compile every shader variant that disabling a pass or setting a parameter reaches");
  check->add_flag("--watch", options.watch, "check again whenever a file that was read changes, until ended");

  CLI::App* explain = app.add_subcommand(
      "explain",
      "say what is known of one pass, resource or parameter: order, storage, barriers, readers; or, with a "
      "code such as W053 alone, what it means");
  addGraphOptions(*explain, options, raw);
  explain->add_option("name", options.name, "any unique suffix of its name");

  CLI::App* expand =
      app.add_subcommand("expand", "print the expanded graph as a graph file that gives the same plan");
  addGraphOptions(*expand, options, raw);

  CLI::App* diff = app.add_subcommand(
      "diff", "say how the plan of another graph differs: passes, barriers, bytes; exit 1 when it does");
  addGraphOptions(*diff, options, raw);
  diff->add_option("other", options.otherGraph, "the other graph file")->required()->type_name("FILE");
  addDiffOptions(*diff, options, raw);

  CLI::App* params =
      app.add_subcommand("params", "list the parameters of a graph: name, type, value, range, label");
  addGraphOptions(*params, options, raw);
  params->add_flag_callback("--json", asJson, "as JSON");

  CLI::App* presets = app.add_subcommand("presets", "list the presets that --preset finds by name");
  presets->add_flag_callback("--json", asJson, "as JSON");
  addPresetFolder(*presets, options);

  CLI::App* dot = app.add_subcommand("dot", "print the compiled plan as a Graphviz graph");
  addGraphOptions(*dot, options, raw);

  CLI::App* plan = app.add_subcommand("plan", "print the compiled plan: order, barriers, storage, bytes");
  addGraphOptions(*plan, options, raw);
  plan->add_option("--format", options.format, "text or json")->check(CLI::IsMember({"text", "json"}));
  plan->add_flag("--explain", options.explain, "say why: passes, barrier bits, shared storage");

  CLI::App* bench = app.add_subcommand(
      "bench", "measure; prints JSON; by default --edit and --frame of graphs/studio.json");
  bench
      ->add_option("--frame", options.frameGraph, "a graph file: the cost of its frame in full-screen copies")
      ->type_name("FILE");
  bench
      ->add_option("--edit", options.editGraph,
                   "a graph file: what a changed parameter and a saved file cost before the next frame")
      ->type_name("FILE")
      ->excludes("--frame");
  bench
      ->add_option("--environment", options.environment,
                   "environment map for --frame and --edit, .hdr or .exr")
      ->type_name("FILE");
  bench->add_option("--scene", options.scene, "scene file for --frame and --edit")->type_name("FILE");
  bench->add_option("--camera", options.camera, "camera of the scene for --frame and --edit");
  bench->add_option("--materials", options.materials, "material library for --frame and --edit")
      ->type_name("FILE");
  bench->add_option("--size", raw.size, "size of the screen for --frame and --edit")
      ->check(CLI::Validator(checkSize, "WxH"));
  addBackendOptions(*bench, options);

  CLI::App* format =
      app.add_subcommand("format", "give graph files, overlays and presets the one layout, comments kept");
  format->add_option("file", options.files, "JSON files")->required()->type_name("FILE");
  format->add_flag("--check", options.checkOnly,
                   "write nothing; exit 1 and name the first line that differs");

  CLI::App* lsp = app.add_subcommand(
      "lsp", "language server for editors, on standard input and output (docs/editors.md); needs no OpenGL");
  lsp->add_option("--scene", options.scene, "scene that graphs are checked with (default: the bundled one)")
      ->type_name("FILE");
  lsp->add_option("--size", raw.size, "size of the screen")->check(CLI::Validator(checkSize, "WxH"));
  lsp->add_flag("--stdio", options.stdio, "as editors say it; there is no other way");
  lsp->footer("Example, for Neovim: vim.lsp.start({ name = 'weft', cmd = { 'weft', 'lsp' } })");

  addTrialCommands(app, options, raw);
  CLI::App* import = app.add_subcommand(
      "import", "make a graph and its shaders of an ISF file (.fs) or a user shader of mpv (.glsl, .hook)");
  import->add_option("file", options.foreignFile, "the file; a .vs beside a .fs is read, too")
      ->required()
      ->type_name("FILE");
  import->add_option("-o,--output", options.folder, "folder to write into; made where it is missing")
      ->required()
      ->type_name("FOLDER");
  import->add_option("--image", options.images, "a picture for an input of the file; repeatable")
      ->check(CLI::Validator(checkSet, "NAME=FILE"));
  import->add_option("--name", options.newName, "name of the graph (default: that of the file)");
  import->add_flag("--overwrite", options.overwrite, "replace files that are there");
  import->footer("Example: weft import glow.fs -o glow --image inputImage=photo.png");

  app.add_subcommand("schema", "print the JSON Schema of graph files");
  app.add_subcommand("types", "print the pass types, imports and formats that a graph may name");

  for (CLI::App* command : allCommands(app)) {
    command
        ->add_option("--confine", raw.folders,
                     "read only below this folder and those named on the command line, whatever files name; "
                     "repeatable")
        ->check(CLI::Validator(takeConfinement, "FOLDER"));
    command
        ->add_option("--limit", raw.limits,
                     "raise or lower a limit of docs/limits.md for this run; repeatable")
        ->check(CLI::Validator(takeLimit, "NAME=VALUE"));
  }
  std::vector<std::string> commands;
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; }))
    commands.push_back(command->get_name());
  if (argc > 1 && argv[1][0] != '-' && std::ranges::find(commands, argv[1]) == commands.end()) {
    printError(fmt::format("weft: unknown command '{}'; {}\n", shown(argv[1]),
                           base::nearestHint(argv[1], commands)));
    exitCode = 2;
    return std::nullopt;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ExtrasError& error) {
    const auto chosen = app.get_subcommands();
    if (chosen.empty() || !tellUnknownOption(*chosen.front(), argc, argv)) tell(app, error);
    exitCode = 2;
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    exitCode = tell(app, error) == 0 ? 0 : 2;
    return std::nullopt;
  }
  options.command = app.get_subcommands().front()->get_name();
  if (const std::string wrong = findEmptyName(*app.get_subcommands().front()); !wrong.empty()) {
    printError(fmt::format("weft {}: {}\n", options.command, shown(wrong)));
    exitCode = 2;
    return std::nullopt;
  }
  parsePair(raw.size, 'x', options.width, options.height);
  if (!parsePair(raw.frames, ':', options.firstFrame, options.lastFrame)) {
    parseNumber(raw.frames, options.firstFrame);
    options.lastFrame = options.firstFrame;
  }
  if (const std::string wrong = takeOutputs(raw, options); !wrong.empty()) {
    printError("weft render: " + shown(wrong) + "\n");
    exitCode = 2;
    return std::nullopt;
  }
  for (std::string& preset : options.presets) preset = presetFile(preset, options.presetFolder);
  options.pointer = parsePointer(options.mouse).value_or(imports::Pointer{});
  options.sets = settingsFrom(raw.sets, "--set");
  options.trial.otherSets = settingsFrom(raw.otherSets, "--other-set");
  for (std::string& preset : options.trial.otherPresets) preset = presetFile(preset, options.presetFolder);
  chooseFiles(options);
  return options;
}

}  // namespace weft::app
