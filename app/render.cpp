// weft render: frames of a graph to image files, reproducible to the byte.
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/device_session.h"
#include "app/output_files.h"
#include "app/session.h"
#include "app/trace_recorder.h"

namespace weft::app {

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void showProgress(std::uint32_t done, std::uint32_t total, double seconds) {
  const int width = 40;
  const int filled = static_cast<int>(std::uint64_t{done} * width / total);
  const double rest = done ? seconds / done * (total - done) : 0;
  fmt::print(stderr, "\r[{}{}] {}/{} frames, {:.1f} s left ", std::string(static_cast<std::size_t>(filled), '#'),
             std::string(static_cast<std::size_t>(width - filled), '.'), done, total, rest);
  if (done == total) std::fputc('\n', stderr);
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
  if (!session) return report(diagnostics) ? 3 : 3;
  if (!session->renderer.load(settingsOf(options, session->context->device().software), *world, diagnostics))
    return report(diagnostics);
  if (session->renderer.execution()->presented().id == 0) {
    diagnostics.error(base::Code::W188, {std::make_shared<const std::string>(options.graph), 1, 1},
                      "the graph presents nothing to write").hint = "add \"present\": \"<texture>\"";
    return report(diagnostics);
  }
  const double prepared = now();
  double firstFrame = 0;
  const bool progress = options.lastFrame > 0 && !options.quiet;  // frames before the first one written run too
  session->renderer.device().timers.setEnabled(options.profile);
  auto recorder = std::make_unique<TraceRecorder>(session->renderer.device().timers);
  if (!options.trace.empty() && !recorder->start(options.trace, diagnostics)) return report(diagnostics);
  runtime::FrameReport last;
  // Every frame from 0 runs, so that frame N with history does not depend on where the range starts.
  for (std::uint32_t frame = 0; frame <= options.lastFrame; ++frame) {
    const double before = now();
    recorder->begin(session->renderer.execution()->plan(), frame);
    last = session->renderer.frame(*world, runtime::headlessFrame(*world, frame, options.fps), diagnostics);
    recorder->end(last);
    session->renderer.dropUploaded(*world);
    session->context->debugLog().drain(diagnostics);
    if (frame == 0) {
      glFinish();
      firstFrame = now() - before;
    }
    if (progress) showProgress(frame + 1, options.lastFrame + 1, now() - prepared);
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
                                    {"passes_run_last_frame", last.passesRun},
                                    {"passes_skipped_last_frame", last.passesSkipped},
                                    {"barriers_last_frame", last.barriers}});
    stats["gl_objects_left"] = closeDevice(std::move(session));
    print(stats);
  }
  return report(diagnostics);
}

}  // namespace weft::app
