// What the last frames cost: wall clock around each, and CPU and GPU time per pass where the timers are on. Names of passes
// stay right when plans change in between.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "engine/gl/objects/timers.h"
#include "engine/runtime/frame/execution.h"

namespace weft::runtime {

struct FrameProfile {
  std::uint64_t frame = 0;    // the caller's number
  double start = 0, end = 0;  // ms of the steady clock, around the calls of the frame
  std::shared_ptr<const std::vector<std::string>> names;  // of the plan's steps
  std::vector<gl::PassTime> passes;                       // parallel to names; empty when the timers were off
  FrameReport report;
  std::uint64_t bytesAllocated = 0;  // of the plan
};

class FrameProfiler {
 public:
  // `timers` must outlive this.
  explicit FrameProfiler(const gl::PassTimers& timers, std::size_t capacity = 240)
      : timers_(timers), capacity_(capacity) {}

  // Around Execution::frame() of this plan.
  void begin(const graph::Plan& plan, std::uint64_t frame);
  void end(const FrameReport& report);
  // Frames whose times are complete, the newest last.
  const std::deque<FrameProfile>& history() const { return history_; }

 private:
  struct Pending {
    FrameProfile profile;
    std::uint64_t number = 0;  // of the timers; 0: they were off
  };

  const gl::PassTimers& timers_;
  std::size_t capacity_;
  std::deque<Pending> pending_;
  std::deque<FrameProfile> history_;
  // The graph whose steps names_ are; held so that no other takes its place.
  std::shared_ptr<const graph::FlatGraph> named_;
  std::shared_ptr<const std::vector<std::string>> names_;
};

}  // namespace weft::runtime
