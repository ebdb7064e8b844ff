#include "app/trials/shot.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/output/pictures.h"
#include "engine/runtime/inspection/frame_profiler.h"
#include "engine/text/printable.h"

namespace weft::app {

std::vector<double> measureSteps(runtime::Renderer& renderer, const runtime::World& world,
                                 const Options& options, std::uint32_t frame, std::uint32_t repeats,
                                 text::Diagnostics& diagnostics) {
  gl::PassTimers& timers = renderer.device().timers;
  std::vector<std::vector<double>> taken(renderer.execution()->plan().steps.size());
  timers.setEnabled(true);
  for (std::uint32_t i = 0; i < repeats; ++i) {
    drawFrame(renderer, world, options, frame + i, diagnostics);
    timers.finish();
    const auto times = timers.results();
    for (std::size_t step = 0; step < std::min(taken.size(), times.size()); ++step)
      if (times[step].ran) taken[step].push_back(times[step].gpu);
  }
  timers.setEnabled(false);
  std::vector<double> medians;
  for (std::vector<double>& all : taken) medians.push_back(runtime::FrameProfiler::medianOf(std::move(all)));
  return medians;
}

std::optional<Shot> takeShot(gl::Context& context, const Options& options, const runtime::World& world,
                             const ShotWish& wish, text::Diagnostics& diagnostics) {
  runtime::Renderer::Options wanted = rendererOptionsOf(options);
  wanted.compile = wish.compile;
  runtime::Renderer renderer(context, options.graph, std::move(wanted));
  if (!renderer.load(settingsOf(options, context.device().software), world, diagnostics)) return std::nullopt;
  if (!checkPresents(options, renderer, diagnostics)) return std::nullopt;
  runtime::Execution& execution = *renderer.execution();
  Shot shot;
  shot.plan = std::make_shared<const graph::Plan>(execution.plan());
  shot.records.driver = context.device().driverKey;
  for (std::size_t pass = 0; pass < shot.plan->stepOf.size(); ++pass)
    if (shot.plan->stepOf[pass] == graph::kNone)
      shot.records.culled.push_back(shot.plan->graph->passNames[pass]);
  runtime::StepRecorder recorder;
  const bool remembers = execution.remembers(world);
  // Where nothing is remembered, the frames between those to look at need not run.
  const std::uint64_t total = remembers ? std::uint64_t{wish.frames.back()} + 1 : wish.frames.size();
  PictureWriter writer;
  for (std::uint64_t i = 0; i < total; ++i) {
    const std::uint32_t number = remembers ? static_cast<std::uint32_t>(i) : wish.frames[i];
    const bool shown = std::ranges::find(wish.frames, number) != wish.frames.end();
    runtime::StepWatch watch;
    if (wish.poison)
      watch.before = [&](std::uint32_t step) { runtime::fillWithPoison(execution, step, *wish.poison); };
    const bool recorded = wish.records && (shown || i == 0);
    if (recorded && !wish.poison)
      watch.before = [&](std::uint32_t step) { recorder.prepare(execution, step); };
    if (recorded) watch.after = [&](std::uint32_t step) { recorder.look(execution, step); };
    execution.watch(std::move(watch));
    drawFrame(renderer, world, options, number, diagnostics);
    if (diagnostics.hasErrors()) return std::nullopt;
    if (auto steps = recorder.take(); !steps.empty())
      shot.records.frames.push_back({number, std::move(steps)});
    if (!shown) continue;
    const auto picture = renderer.readPresentedFloat();
    if (!picture) continue;
    if (wish.records && !wish.poison) writer.look(*picture, renderer, options.graph);
    shot.pictures[number] = runtime::toBytes(*picture);
  }
  writer.tell(diagnostics);
  execution.watch({});
  return shot;
}

std::optional<PictureDifference> comparePictures(const assets::Image8& picture,
                                                 const assets::Image8& reference,
                                                 const std::vector<std::uint8_t>& weights) {
  PictureDifference found{.map = assets::computeFlip(reference, picture),
                          .bytes = assets::compareImages(picture, reference)};
  if (found.map.errors.empty()) return std::nullopt;
  found.flip = assets::summarizeFlip(found.map, weights);
  found.share =
      static_cast<double>(found.bytes.differingPixels) / static_cast<double>(found.map.errors.size());
  return found;
}

std::string PictureDifference::text() const {
  return fmt::format(
      "FLIP {:.4f}, at most {:.3f} (at {},{}); {} {} ({:.3g} %), by up to {:.0f} of 255 (at {},{})",
      flip.mean, flip.peak, flip.x, flip.y, text::counted(bytes.differingPixels, "pixel"),
      bytes.differingPixels == 1 ? "differs" : "differ", 100 * share, bytes.maxDifference, bytes.worstX,
      bytes.worstY);
}

std::string sizeText(const assets::Image8& image) {
  return fmt::format("{}x{}", image.width, image.height);
}

}  // namespace weft::app
