// weft render: frames of a graph to image files, reproducible to the byte.
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/device_session.h"
#include "app/output_files.h"
#include "app/progress.h"
#include "app/session.h"
#include "app/trace_recorder.h"

namespace weft::app {

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void showProgress(const Progress& progress) {
  fmt::print(stderr, "\r{}\033[K", progressText(progress));
  if (progress.done == progress.total) std::fputc('\n', stderr);
  std::fflush(stderr);
}

}  // namespace

int runRender(const Options& options) {
  const double start = now();
  base::Diagnostics diagnostics;
  checkOutput(options.output, options.firstFrame, options.lastFrame > options.firstFrame, diagnostics);
  auto world = loadWorld(options, diagnostics);
  if (!world || diagnostics.hasErrors()) {
    // The graph's own mistakes are reported in the same run.
    makePlan(options, world ? world->facts() : factsWithoutWorld(), true, diagnostics);
    return report(diagnostics);
  }
  auto session = openDevice(options, diagnostics);
  if (!session) {
    // The graph's own mistakes are no matter of the machine.
    makePlan(options, world->facts(), true, diagnostics);
    report(diagnostics);
    return 3;
  }
  if (!session->renderer.load(settingsOf(options, session->context->device().software), *world, diagnostics))
    return report(diagnostics);
  if (session->renderer.execution()->presented().id == 0) {
    diagnostics.error(base::Code::W188, {std::make_shared<const std::string>(options.graph), 1, 1},
                      "the graph presents nothing to write").hint = "add \"present\": \"<texture>\"";
    return report(diagnostics);
  }
  const double prepared = now();
  double firstFrame = 0;
  // Frames before the first one written run too when it may look back at them.
  const std::uint32_t begin = session->renderer.execution()->remembers(*world) ? 0 : options.firstFrame;
  const std::uint32_t total = options.lastFrame - begin + 1;
  const bool progress = total > 1 && !options.quiet;
  session->renderer.device().timers.setEnabled(options.profile);
  auto recorder = std::make_unique<TraceRecorder>(session->renderer.device().timers);
  if (!options.trace.empty() && !recorder->start(options.trace, diagnostics)) return report(diagnostics);
  runtime::FrameReport last;
  // So that frame N does not depend on where the range starts.
  for (std::uint32_t frame = begin; frame <= options.lastFrame; ++frame) {
    const double before = now();
    recorder->begin(session->renderer.execution()->plan(), frame);
    last = session->renderer.frame(*world, runtime::headlessFrame(*world, frame, options.fps), diagnostics);
    recorder->end(last);
    session->renderer.dropUploaded(*world);
    session->context->debugLog().drain(diagnostics);
    if (frame == begin) {
      glFinish();
      firstFrame = now() - before;
    }
    if (progress) showProgress({.done = frame - begin + 1, .total = total, .lead = options.firstFrame - begin, .seconds = now() - prepared});
    if (frame < options.firstFrame) continue;
    if (diagnostics.hasErrors() || !savePresented(session->renderer, *outputNameOf(options.output, frame), diagnostics)) return report(diagnostics);
  }
  session->context->debugLog().drain(diagnostics);
  recorder->stop(diagnostics);
  recorder.reset();
  if (options.stats) {
    auto stats = statsOf(*session, {{"setup_ms", (prepared - start) * 1e3},
                                    {"first_frame_ms", firstFrame * 1e3},
                                    {"total_ms", (now() - start) * 1e3},
                                    {"frames_run", total},
                                    {"passes_run_last_frame", last.passesRun},
                                    {"passes_skipped_last_frame", last.passesSkipped},
                                    {"barriers_last_frame", last.barriers}});
    stats["gl_objects_left"] = closeDevice(std::move(session));
    print(stats);
  }
  return report(diagnostics, !options.quiet);
}

}  // namespace weft::app
