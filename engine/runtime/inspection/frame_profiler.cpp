#include "engine/runtime/inspection/frame_profiler.h"

namespace weft::runtime {

void FrameProfiler::begin(const graph::Plan& plan, std::uint64_t frame) {
  if (named_ != plan.graph) {
    std::vector<std::string> names;
    for (const graph::Step& step : plan.steps) names.push_back(plan.graph->passNames[step.pass]);
    names_ = std::make_shared<const std::vector<std::string>>(std::move(names));
    named_ = plan.graph;
  }
  Pending& pending = pending_.emplace_back();
  pending.number = timers_.enabled() ? timers_.nextFrame() : 0;
  pending.profile.frame = frame;
  pending.profile.names = names_;
  pending.profile.bytesAllocated = plan.bytesAllocated;
  pending.profile.start = gl::steadyMs();
}

// GPU times of a frame may come some frames later, and those of several frames at once: then only the last has some.
void FrameProfiler::end(const FrameReport& report) {
  if (pending_.empty()) return;
  pending_.back().profile.end = gl::steadyMs();
  pending_.back().profile.report = report;
  while (!pending_.empty() && pending_.front().number <= timers_.resultFrame()) {
    FrameProfile& profile = pending_.front().profile;
    if (pending_.front().number != 0 && pending_.front().number == timers_.resultFrame())
      profile.passes.assign(timers_.results().begin(), timers_.results().end());
    history_.push_back(std::move(profile));
    pending_.pop_front();
    if (history_.size() > capacity_) history_.pop_front();
  }
}

}  // namespace weft::runtime
