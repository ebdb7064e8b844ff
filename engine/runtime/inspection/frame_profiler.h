// What the last frames cost: wall clock around each, and CPU and GPU time per pass where the timers are on. Names of passes
// stay right when plans change in between.
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "engine/gl/objects/timers.h"
#include "engine/graph/plan.h"

namespace weft::runtime {

struct FrameProfile {
  double ms = 0;                                          // around the calls of the frame
  std::shared_ptr<const std::vector<std::string>> names;  // of the plan's steps
  // Parallel to names; empty when the timers were off. With queries they are those of a frame shortly before.
  std::vector<gl::PassTime> passes;
};

class FrameProfiler {
 public:
  static constexpr std::size_t kFrames = 240, kAveraged = 30;
  // `timers` must outlive this.
  explicit FrameProfiler(const gl::PassTimers& timers) : timers_(timers) {}

  // Around a frame, which runs `plan`.
  void begin() { start_ = gl::steadyMs(); }
  void end(const graph::Plan& plan) {
    if (named_ != plan.graph) {
      std::vector<std::string> names;
      for (const graph::Step& step : plan.steps) names.push_back(plan.graph->passNames[step.pass]);
      names_ = std::make_shared<const std::vector<std::string>>(std::move(names));
      named_ = plan.graph;
    }
    FrameProfile& profile = history_.emplace_back(FrameProfile{gl::steadyMs() - start_, names_, {}});
    if (timers_.enabled() && timers_.results().size() == names_->size())
      profile.passes.assign(timers_.results().begin(), timers_.results().end());
    if (history_.size() > kFrames) history_.pop_front();
  }
  // Of the last kAveraged frames; 0 before the first.
  double median() const {
    std::vector<double> times;
    for (std::size_t f = history_.size() - std::min(history_.size(), kAveraged); f < history_.size(); ++f)
      times.push_back(history_[f].ms);
    return medianOf(times);
  }
  static double medianOf(std::vector<double> times) {
    if (times.empty()) return 0;
    const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
    std::ranges::nth_element(times, middle);
    return *middle;
  }
  // The newest last.
  const std::deque<FrameProfile>& history() const { return history_; }

 private:
  const gl::PassTimers& timers_;
  double start_ = 0;
  std::deque<FrameProfile> history_;
  // The graph whose steps names_ are; held so that no other takes its place.
  std::shared_ptr<const graph::FlatGraph> named_;
  std::shared_ptr<const std::vector<std::string>> names_;
};

}  // namespace weft::runtime
