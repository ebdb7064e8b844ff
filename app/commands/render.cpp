// weft render: frames of a graph to image files, reproducible to the byte.
#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <utility>
#include <vector>

#include "app/commands/commands.h"
#include "app/output/output_files.h"
#include "app/output/picture_writer.h"
#include "app/output/progress.h"
#include "app/output/standard_streams.h"
#include "app/session/device_session.h"
#include "app/session/session.h"
#include "engine/runtime/inspection/capture.h"
#include "engine/text/printable.h"

namespace weft::app {

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// A texture of the graph that is written to a file, or to those of a pattern.
struct PickedOutput {
  graph::Pick pick;
  std::string file;
};

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

// The items of the plan that are picked. Nothing after an error.
std::optional<std::vector<runtime::CaptureItem>> itemsOf(const RenderOptions& options,
                                                         const graph::Plan& plan,
                                                         text::Diagnostics& diagnostics) {
  std::vector<runtime::CaptureItem> items;
  const graph::FlatGraph& graph = *plan.graph;
  for (const PickedOutput& each : options.picked) {
    const auto item = runtime::captureItemOf(plan, each.pick, diagnostics);
    if (!item) continue;
    const auto at =
        std::ranges::find(graph.resourceNames, item->target.resource) - graph.resourceNames.begin();
    if (graph.resources[static_cast<std::size_t>(at)].kind == graph::ResourceKind::buffer)
      diagnostics
          .error(text::Code::outputNotWritten, {std::make_shared<const std::string>(each.file)},
                 fmt::format("'{}' is a buffer and no picture", each.pick.name))
          .hint = "weft dump writes the bytes of buffers";
    items.push_back(*item);
  }
  return diagnostics.hasErrors() ? std::nullopt : std::optional(std::move(items));
}

int runRender(RenderOptions& options) {
  const double start = now();
  if (const std::string wrong = takeOutputs(options); !wrong.empty()) {
    printError("weft render: " + text::shortened(text::printable(wrong)) + "\n");
    return 2;
  }
  text::Diagnostics diagnostics;
  const bool whole = !options.output.empty();
  std::vector<OutputFile> outputs;
  if (whole) outputs.push_back({"-o", options.output, options.firstFrame, options.lastFrame});
  for (const PickedOutput& each : options.picked) {
    options.kept.push_back(each.pick);
    outputs.push_back({"-o " + each.pick.text, each.file, options.firstFrame, options.lastFrame});
  }
  for (const OutputFile& each : outputs)
    checkOutput(each.pattern, options.firstFrame, options.lastFrame > options.firstFrame, diagnostics);
  int exitCode = 0;
  auto opened = openGraph(options, diagnostics, exitCode);
  if (!opened) return exitCode;
  std::unique_ptr<DeviceSession> session = std::move(opened->session);
  runtime::World& world = opened->world;
  runtime::Renderer& renderer = session->renderer;
  if (whole && !checkPresents(options, renderer, diagnostics)) return report(diagnostics);
  const double prepared = now();
  double firstFrame = 0;
  // Frames before the first one written run too when it may look back at them.
  const std::uint32_t begin = renderer.execution()->remembers(world) ? 0 : options.firstFrame;
  const std::uint64_t total = std::uint64_t{options.lastFrame} - begin + 1;
  const auto items = itemsOf(options, renderer.execution()->plan(), diagnostics);
  if (!checkDistinct(outputs, filesReadBy(options, renderer, world), diagnostics) || !items)
    return report(diagnostics);
  ProgressLines lines({.total = total, .lead = options.firstFrame - begin});
  renderer.device().timers.setEnabled(options.profile);
  runtime::FrameReport last;
  PictureWriter writer;
  {
    runtime::Capture capture(renderer.device());  // destroyed before the device
    std::optional<std::uint32_t> written;         // the frame, where it is to be written
    std::vector<std::uint8_t> saved(items->size());
    text::Diagnostics said;
    if (!items->empty())
      capture.start(*renderer.execution(), *items, [&](std::size_t item, runtime::Inspector& inspector) {
        if (written)
          saved[item] = saveInspected(inspector, *outputNameOf(options.picked[item].file, *written), said);
      });
    // So frame N does not depend on where the range starts.
    for (std::uint64_t done = 1; done <= total && !diagnostics.hasErrors(); ++done) {
      const auto frame = static_cast<std::uint32_t>(begin + (done - 1));
      const double before = now();
      written = frame < options.firstFrame ? std::nullopt : std::optional(frame);
      last = renderer.frame(world, runtime::headlessFrame(world, frame, options.fps, options.pointer),
                            diagnostics);
      renderer.dropUploaded(world);
      session->context->debugLog().drain(diagnostics);
      if (done == 1) {
        glFinish();
        firstFrame = now() - before;
      }
      if (total > 1 && !options.quiet) lines.countOne();
      if (!written) continue;
      diagnostics.append(std::exchange(said, {}));
      for (std::size_t i = 0; i < saved.size() && !diagnostics.hasErrors(); ++i)
        if (!std::exchange(saved[i], 0))
          diagnostics
              .error(text::Code::outputNotWritten,
                     {std::make_shared<const std::string>(options.picked[i].file)},
                     fmt::format("nothing was in '{}' to write", options.picked[i].pick.text))
              .hint = "an import that is not there has no picture, nor has a pass that did not run";
      if (whole && !diagnostics.hasErrors())
        writer.save(renderer, *outputNameOf(options.output, frame), diagnostics);
    }
    if (!items->empty()) capture.stop(*renderer.execution());
  }
  session->context->debugLog().drain(diagnostics);
  writer.tell(diagnostics);
  if (diagnostics.hasErrors()) return report(diagnostics);
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
    parseRange(text, options.firstFrame, options.lastFrame);
  };
  command.add_option_function<std::string>("--frames", takeFrames, "a frame number, or FIRST:LAST")
      ->check(CLI::Validator(checkRange, "A:B"));
  options.addFps(command);
  options.addPointer(command);
  command.add_flag("--wait-for-assets")
      ->description("as always without a window: the first frame waits for all that it needs");
  command.add_flag("--quiet", options.quiet, "no progress bar and no notes");
}

}  // namespace weft::app
