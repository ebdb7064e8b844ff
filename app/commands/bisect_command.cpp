// weft bisect: the first pass whose output differs between two graphs, or two settings of one.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "app/commands/commands.h"
#include "app/output/standard_streams.h"
#include "app/trials/device_run.h"
#include "app/trials/shot_pair.h"
#include "engine/base/counted.h"

namespace weft::app {

namespace {

Options otherOf(const Options& options) {
  Options other = options;
  if (!options.otherGraph.empty()) other.graph = options.otherGraph;
  const TrialOptions& trial = options.trial;
  other.sets.insert(other.sets.end(), trial.otherSets.begin(), trial.otherSets.end());
  other.trial.isOther = true;  // with its --other-disable
  other.presets.insert(other.presets.end(), trial.otherPresets.begin(), trial.otherPresets.end());
  return other;
}

// "96 of 100 texels differ (96 %), by at most 0.5, on average by 0.2"
std::string compareTexels(const runtime::WrittenTexels& a, const runtime::WrittenTexels& b) {
  if (a.values.size() != b.values.size() || a.stride != b.stride || a.width != b.width)
    return fmt::format("{}, {}: another size or format", base::counted(a.values.size() / a.stride, "texel"),
                       base::counted(b.values.size() / b.stride, "texel"));
  std::size_t differ = 0, broken = 0;
  double most = 0, sum = 0;
  for (std::size_t i = 0; i < a.values.size(); i += a.stride) {
    bool other = false, odd = false;
    for (std::size_t c = i; c < i + a.stride; ++c) {
      const float x = a.values[c], y = b.values[c];
      if (x == y || (std::isnan(x) && std::isnan(y))) continue;
      other = true;
      const double difference = std::abs(static_cast<double>(x) - static_cast<double>(y));
      odd = odd || !std::isfinite(difference);
      if (!std::isfinite(difference)) continue;
      most = std::max(most, difference);
      sum += difference;
    }
    differ += other;
    broken += odd;
  }
  const std::size_t texels = a.values.size() / a.stride;
  return fmt::format(
      "{} of {} {} ({:.3g} %), by at most {:.4g}, on average by {:.4g}{}", differ,
      base::counted(texels, "texel"), differ == 1 ? "differs" : "differ",
      100.0 * static_cast<double>(differ) / static_cast<double>(std::max<std::size_t>(1, texels)), most,
      sum / static_cast<double>(std::max<std::size_t>(1, a.values.size())),
      broken ? fmt::format("; {} of them are infinite or no number in one of the two", broken) : "");
}

std::string countSame(const Shot& shot, const Divergence& found) {
  std::size_t before = 0, all = 0;
  bool passed = false;
  for (const FrameRecord& frame : shot.records)
    if (frame.frame == found.frame)
      for (const runtime::StepRecord& step : frame.steps) {
        passed = passed || (step.pass == found.pass && step.resource == found.resource);
        before += !passed;
        ++all;
      }
  return fmt::format("{} of {} {} before it and {} the same", before, base::counted(all, "result"),
                     before == 1 ? "comes" : "come", before == 1 ? "is" : "are");
}

class Bisection {
 public:
  Bisection(gl::Context& context, std::span<const Options, 2> sides, const runtime::World& world)
      : context_(context), world_(world), sides_(sides), frame_(sides[0].lastFrame) {}

  int run(base::Diagnostics& diagnostics) {
    const auto pair = shootPair(context_, sides_[0], sides_[1], world_, frame_, diagnostics);
    if (!pair) return 2;
    if (!pair->first) {
      print(fmt::format("no pass differs in {}\n", base::counted(pair->after.records.size(), "frame")));
      return 0;
    }
    print(fmt::format("first that differs: {}\n    {}\n", pair->first->text(),
                      countSame(pair->after, *pair->first)));
    if (pair->first->kind == Divergence::Kind::differs) tellTexels(*pair->first, diagnostics);
    print(pair->pictureText() + "\n");
    return 1;
  }

 private:
  std::optional<Shot> shoot(std::size_t side, const Divergence& found, base::Diagnostics& diagnostics) {
    return takeShot(context_, sides_[side], world_,
                    {.frames = {frame_}, .keep = {found.pass, found.resource}, .keepFrame = found.frame},
                    diagnostics);
  }

  void tellTexels(const Divergence& found, base::Diagnostics& diagnostics) {
    const auto a = shoot(0, found, diagnostics);
    const auto b = shoot(1, found, diagnostics);
    if (a && b && a->kept && b->kept) print("    " + compareTexels(*a->kept, *b->kept) + "\n");
  }

  gl::Context& context_;
  const runtime::World& world_;
  const std::span<const Options, 2> sides_;
  std::uint32_t frame_;
};

}  // namespace

int runBisect(const Options& options) {
  const Options sides[] = {options, otherOf(options)};
  return runOnDevice(sides, 2,
                     [&](gl::Context& context, const runtime::World& world, base::Diagnostics& diagnostics) {
                       return Bisection(context, sides, world).run(diagnostics);
                     });
}

}  // namespace weft::app
