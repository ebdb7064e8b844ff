#include "engine/runtime/inspection/frame_profiler.h"

namespace weft::runtime {

FrameProfiler::FrameProfiler(gl::PassTimers& timers, std::size_t capacity)
    : timers_(timers), capacity_(capacity) {
  timers_.setListener([this](std::uint64_t number, std::span<const gl::PassTime> times) {
    for (Pending& each : pending_)
      if (each.number == number) {
        each.profile.passes.assign(times.begin(), times.end());
        each.done = true;
      }
    complete();
  });
}

FrameProfiler::~FrameProfiler() {
  timers_.setListener({});
}

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

void FrameProfiler::end(const FrameReport& report) {
  if (pending_.empty()) return;
  // The listener may have completed the frame already, when no GPU clock is waited for; complete() leaves it until it has
  // an end.
  Pending& pending = pending_.back();
  pending.profile.end = gl::steadyMs();
  pending.profile.report = report;
  if (pending.number == 0) pending.done = true;
  complete();
}

void FrameProfiler::complete() {
  while (!pending_.empty() && pending_.front().done && pending_.front().profile.end > 0) {
    history_.push_back(std::move(pending_.front().profile));
    pending_.pop_front();
    if (history_.size() > capacity_) history_.pop_front();
  }
}

}  // namespace weft::runtime
