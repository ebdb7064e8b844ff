// weft render: frames of a graph to image files, reproducible to the byte.
#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "app/commands/commands.h"
#include "app/output/output_files.h"
#include "app/output/picture_writer.h"
#include "app/output/progress.h"
#include "app/output/standard_streams.h"
#include "app/session/device_session.h"
#include "app/session/frame_limit.h"
#include "app/session/pick_outputs.h"
#include "app/session/session.h"
#include "engine/base/printable.h"

namespace weft::app {

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct RenderOptions : Options {
  std::vector<std::string> outputs;  // -o, as they were written
  std::string present;
  std::string output;  // the presented picture; empty: only `picked`
  std::vector<PickedOutput> picked;
  bool quiet = false;
};

// Whether what stands before a '=' names a texture, and is not the beginning of a path.
bool isMeantAsName(const std::string& text) {
  return !text.empty() && text.find('/') == std::string::npos &&
         (text.find('.') == std::string::npos || text.find_first_of("#[@") != std::string::npos ||
          graph::parsePick(text));
}

// `-o FILE`, `-o NAME=FILE` and `--present NAME`. What is wrong with them, or nothing.
std::string takeOutputs(RenderOptions& options) {
  for (const std::string& text : options.outputs) {
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
  if (options.present.empty()) return {};
  std::optional<graph::Pick> shown = graph::parsePick(options.present);
  if (!shown)
    return fmt::format("--present takes a texture such as depth, hdr#1 or 'glow.mip[2]', found '{}'",
                       options.present);
  if (options.output.empty()) return "--present needs a file: -o FILE";
  shown->option = "--present";
  options.picked.insert(options.picked.begin(), {std::move(*shown), std::exchange(options.output, {})});
  return {};
}

base::Where placeOfFrames(const Options& options) {
  return base::placeOfOption(options.firstFrame == options.lastFrame
                                 ? fmt::format("--frames {}", options.firstFrame)
                                 : fmt::format("--frames {}:{}", options.firstFrame, options.lastFrame));
}

int runRender(RenderOptions& options) {
  const double start = now();
  if (const std::string wrong = takeOutputs(options); !wrong.empty()) {
    printError("weft render: " + base::shortened(base::printable(wrong)) + "\n");
    return 2;
  }
  for (const PickedOutput& each : options.picked) options.kept.push_back(each.pick);
  base::Diagnostics diagnostics;
  const bool whole = !options.output.empty();
  if (whole)
    checkOutput(options.output, options.firstFrame, options.lastFrame > options.firstFrame, diagnostics);
  PickOutputs(options, options.picked).check(diagnostics);
  checkFrameCount(std::uint64_t{options.lastFrame} - options.firstFrame + 1, placeOfFrames(options), {},
                  diagnostics);
  int exitCode = 0;
  auto opened = openGraph(options, diagnostics, exitCode);
  if (!opened) return exitCode;
  std::unique_ptr<DeviceSession> session = std::move(opened->session);
  runtime::World& world = opened->world;
  PickOutputs picks(options, options.picked);  // destroyed before the device
  if (whole && session->renderer.execution()->presented().id == 0) {
    diagnostics
        .error(base::Code::presentsNothing, {std::make_shared<const std::string>(options.graph), 1, 1},
               "the graph presents nothing to write")
        .hint = "add \"present\": \"<texture>\", and enable a pass that writes it";
    return report(diagnostics);
  }
  const double prepared = now();
  double firstFrame = 0;
  // Frames before the first one written run too when it may look back at them.
  const std::uint32_t begin = session->renderer.execution()->remembers(world) ? 0 : options.firstFrame;
  const std::uint64_t total = std::uint64_t{options.lastFrame} - begin + 1;
  std::vector<OutputFile> outputs = {{"-o", options.output, options.firstFrame, options.lastFrame}};
  picks.append(outputs);
  if (!checkFrameCount(total, placeOfFrames(options), kRemembers, diagnostics) ||
      !checkDistinct(outputs, filesReadBy(options, session->renderer, world), diagnostics) ||
      !makeFolders(options.output, options.firstFrame, options.lastFrame, diagnostics) ||
      !picks.makeAllFolders(diagnostics) || !picks.start(session->renderer, diagnostics))
    return report(diagnostics);
  const bool progress = total > 1 && !options.quiet;
  ProgressLines lines(isTerminal());
  session->renderer.device().timers.setEnabled(options.profile);
  runtime::FrameReport last;
  PictureWriter writer;
  // So frame N does not depend on where the range starts.
  for (std::uint64_t done = 1; done <= total; ++done) {
    const auto frame = static_cast<std::uint32_t>(begin + (done - 1));
    const double before = now();
    picks.expect(frame < options.firstFrame ? std::nullopt : std::optional(frame));
    last = session->renderer.frame(world, runtime::headlessFrame(world, frame, options.fps, options.pointer),
                                   diagnostics);
    session->renderer.dropUploaded(world);
    session->context->debugLog().drain(diagnostics);
    if (done == 1) {
      glFinish();
      firstFrame = now() - before;
    }
    if (progress)
      printError(lines.after(
          {.done = done, .total = total, .lead = options.firstFrame - begin, .seconds = now() - prepared}));
    if (frame < options.firstFrame) continue;
    if (!picks.finish(diagnostics) || diagnostics.hasErrors() ||
        (whole && !writer.save(session->renderer, *outputNameOf(options.output, frame), diagnostics))) {
      writer.tell(diagnostics);
      return report(diagnostics);
    }
  }
  session->context->debugLog().drain(diagnostics);
  writer.tell(diagnostics);
  picks.stop(session->renderer);
  if (options.stats) {
    auto stats = statsOf(*session, {{"setup_ms", (prepared - start) * 1e3},
                                    {"first_frame_ms", firstFrame * 1e3},
                                    {"total_ms", (now() - start) * 1e3},
                                    {"frames_run", total},
                                    {"passes_run_last_frame", last.passesRun},
                                    {"passes_skipped_last_frame", last.passesSkipped},
                                    {"barriers_last_frame", last.barriers}});
    stats["pictures"] = {{"written", writer.counts().pictures},
                         {"with_nan_or_infinity", writer.counts().broken},
                         {"pixels_nan_or_infinite", writer.counts().pixels}};
    stats["gl_objects_left"] = closeDevice(std::move(session));
    printStats(stats);
  }
  return report(diagnostics, !options.quiet);
}

}  // namespace

void addRender(CommandLine& line) {
  const auto [command, options] =
      line.add("render", "render frames of a graph to image files, without a display", runRender);
  options.addGraph(command);
  options.addBackend(command);
  options.addMeasurements(command);
  addPath(
      command, "-o,--output", options.outputs,
      "image to write, .png or .exr; for several frames a pattern: f_%04d.png; NAME=FILE writes a texture "
      "of the graph: depth=depth.png, 'glow.mip[2]=glow.exr'; repeatable")
      ->required();
  command.add_option(
      "--present", options.present,
      "show this texture instead of the graph's picture, as the viewer's inspector does: depth, "
      "'hdr after skybox', 'glow.mip[2]'");
  const auto takeFrames = [&options](const std::string& text) {
    if (parsePair(text, ':', options.firstFrame, options.lastFrame)) return;
    parseNumber(text, options.firstFrame);
    options.lastFrame = options.firstFrame;
  };
  command.add_option_function<std::string>("--frames", takeFrames, "a frame number, or FIRST:LAST")
      ->check(CLI::Validator(checkFrames, "A:B"));
  options.addFps(command);
  options.addPointer(command);
  command.add_flag("--wait-for-assets")
      ->description("as always without a window: the first frame waits for all that it needs");
  command.add_flag("--quiet", options.quiet, "no progress bar and no notes");
}

}  // namespace weft::app
