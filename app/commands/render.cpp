// weft render: frames of a graph to image files, reproducible to the byte.
#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
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

namespace weft::app {

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

base::Where placeOfFrames(const Options& options) {
  return base::placeOfOption(options.firstFrame == options.lastFrame
                                 ? fmt::format("--frames {}", options.firstFrame)
                                 : fmt::format("--frames {}:{}", options.firstFrame, options.lastFrame));
}

}  // namespace

int runRender(const Options& options) {
  const double start = now();
  base::Diagnostics diagnostics;
  const bool whole = !options.output.empty();
  if (whole)
    checkOutput(options.output, options.firstFrame, options.lastFrame > options.firstFrame, diagnostics);
  PickOutputs(options).check(diagnostics);
  checkFrameCount(std::uint64_t{options.lastFrame} - options.firstFrame + 1, placeOfFrames(options), {},
                  diagnostics);
  int exitCode = 0;
  auto opened = openGraph(options, diagnostics, exitCode);
  if (!opened) return exitCode;
  std::unique_ptr<DeviceSession> session = std::move(opened->session);
  runtime::World& world = opened->world;
  PickOutputs picks(options);  // destroyed before the device
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

}  // namespace weft::app
