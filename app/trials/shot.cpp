#include "app/trials/shot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/session/frame_limit.h"
#include "app/session/session.h"
#include "engine/base/counted.h"
#include "engine/base/limits.h"
#include "engine/graph/compile/compile.h"

namespace weft::app {

namespace {

bool checkPresents(const Options& options, runtime::Renderer& renderer, base::Diagnostics& diagnostics) {
  if (renderer.execution()->presented().id != 0) return true;
  diagnostics
      .error(base::Code::presentsNothing, {std::make_shared<const std::string>(options.graph), 1, 1},
             "the graph presents nothing to compare")
      .hint = "add \"present\": \"<texture>\", and enable a pass that writes it";
  return false;
}

// Whether the pictures of all frames may be held at once: kMostTextureBytes.
bool checkPictures(const Options& options, std::uint64_t count, runtime::Renderer& renderer,
                   base::Diagnostics& diagnostics) {
  const gl::TextureDesc& desc = renderer.execution()->presented().desc;
  const std::uint64_t limit = base::raised(graph::kMostTextureBytes);
  const std::uint64_t bytes = count * desc.width * desc.height * 4;
  if (count == 1 || bytes <= limit) return true;
  diagnostics
      .error(base::Code::limitExceeded, {std::make_shared<const std::string>(options.graph), 0, 0},
             fmt::format("the pictures of {} frames take {} bytes, and at most {} may", count, bytes, limit))
      .hint = "compare fewer frames in a case, or smaller ones";
  return false;
}

// A picture of 8 bits shows no NaN: it is 0 there.
void warnOfBrokenValues(const Options& options, runtime::Renderer& renderer, base::Diagnostics& diagnostics) {
  const auto values = renderer.presentsBytes() ? std::nullopt : renderer.readPresentedFloat();
  if (!values) return;
  std::size_t pixels = 0;
  for (std::size_t at = 0; at < values->texels.size(); at += values->channels) {
    const auto begin = values->texels.begin() + static_cast<std::ptrdiff_t>(at);
    pixels += std::any_of(begin, begin + values->channels, [](float v) { return !std::isfinite(v); });
  }
  if (pixels == 0) return;
  base::Diagnostic& d = diagnostics.warning(
      base::Code::pictureNotFinite, {std::make_shared<const std::string>(options.graph), 0, 0},
      fmt::format("{} of the picture {} NaN or infinite", base::counted(pixels, "pixel"),
                  pixels == 1 ? "is" : "are"));
  d.expected = "finite numbers";
  d.hint = "the texture inspector of `weft view` marks them";
}

void measure(runtime::Renderer& renderer, const runtime::World& world, const Options& options,
             std::uint32_t frame, std::uint32_t repeats, Shot& shot, base::Diagnostics& diagnostics) {
  gl::PassTimers& timers = renderer.device().timers;
  const graph::FlatGraph& graph = *shot.plan->graph;
  timers.setEnabled(true);
  for (std::uint32_t i = 0; i < repeats; ++i) {
    renderer.frame(world, runtime::headlessFrame(world, frame + i, options.fps, options.pointer),
                   diagnostics);
    timers.finish();
    double whole = 0;
    std::map<std::string, double> passes;
    for (std::size_t step = 0; step < timers.results().size() && step < shot.plan->steps.size(); ++step) {
      const double ms = timers.results()[step].ran ? timers.results()[step].gpu : 0;
      whole += ms;
      passes[graph.specs[shot.plan->steps[step].pass].declared] += ms;
    }
    if (i > 0 && whole >= shot.milliseconds) continue;
    shot.milliseconds = whole;
    shot.passMilliseconds = std::move(passes);
  }
  timers.setEnabled(false);
}

}  // namespace

std::optional<Shot> takeShot(gl::Context& context, const Options& options, const runtime::World& world,
                             const ShotWish& wish, base::Diagnostics& diagnostics) {
  runtime::Renderer::Options wanted = rendererOptionsOf(options);
  wanted.compile = wish.compile;
  runtime::Renderer renderer(context, options.graph, std::move(wanted));
  if (!renderer.load(settingsOf(options, context.device().software), world, diagnostics)) return std::nullopt;
  if (!checkPresents(options, renderer, diagnostics)) return std::nullopt;
  runtime::Execution& execution = *renderer.execution();
  Shot shot;
  shot.plan = std::make_shared<const graph::Plan>(execution.plan());
  shot.files = filesReadBy(options, renderer, world);
  runtime::StepRecorder recorder;
  if (!wish.keep.first.empty()) recorder.keep(wish.keep.first, wish.keep.second);
  const bool remembers = execution.remembers(world);
  const std::uint32_t first = remembers ? 0 : wish.frames.front(), last = wish.frames.back();
  const std::uint64_t count = remembers ? std::uint64_t{last} + 1 : wish.frames.size();
  if (!checkFrameCount(count, base::placeOfOption(fmt::format("--frame {}", last)),
                       remembers ? kRemembers : "", diagnostics) ||
      !checkPictures(options, wish.frames.size(), renderer, diagnostics))
    return std::nullopt;
  // Where nothing is remembered, the frames between those to look at need not run.
  const auto frameAfter = [&](std::uint64_t frame) -> std::uint64_t {
    if (remembers) return frame + 1;
    const auto next = std::ranges::upper_bound(wish.frames, static_cast<std::uint32_t>(frame));
    return next == wish.frames.end() ? std::uint64_t{last} + 1 : *next;
  };
  std::optional<runtime::Poison> poison;
  if (wish.poison) poison.emplace(execution, *wish.poison);
  for (std::uint64_t frame = first; frame <= last; frame = frameAfter(frame)) {
    const auto number = static_cast<std::uint32_t>(frame);
    const bool shown = std::ranges::find(wish.frames, number) != wish.frames.end();
    const bool keeps = !wish.keep.first.empty() && number == wish.keepFrame;
    runtime::StepWatch watch;
    if (poison) watch.before = [&](std::uint32_t step) { poison->fill(step); };
    const bool recorded = (wish.records && (shown || frame == first)) || keeps;
    if (recorded && !poison) watch.before = [&](std::uint32_t step) { recorder.prepare(execution, step); };
    if (recorded) watch.after = [&](std::uint32_t step) { recorder.look(execution, step); };
    execution.watch(std::move(watch));
    renderer.frame(world, runtime::headlessFrame(world, number, options.fps, options.pointer), diagnostics);
    context.debugLog().drain(diagnostics);
    if (diagnostics.hasErrors()) return std::nullopt;
    if (auto steps = recorder.take(); !steps.empty()) shot.records.push_back({number, std::move(steps)});
    if (keeps) shot.kept = recorder.kept();
    if (!shown) continue;
    if (wish.records && !wish.poison) warnOfBrokenValues(options, renderer, diagnostics);
    if (auto picture = renderer.readPresented8()) shot.pictures[number] = std::move(*picture);
  }
  execution.watch({});
  if (wish.repeats > 0)
    measure(renderer, world, options, wish.frames.back() + 1, wish.repeats, shot, diagnostics);
  return shot;
}

}  // namespace weft::app
