// The times of the last frames, and a trace file of them while one is wanted (--trace, or a key of the viewer). Measures
// each pass as long as it writes a trace. Does not: draw, or say when a frame is.
#pragma once

#include <memory>
#include <string>

#include "engine/runtime/inspection/frame_profiler.h"
#include "engine/runtime/inspection/trace_file.h"

namespace weft::app {

class TraceRecorder {
 public:
  // `timers` must outlive this.
  explicit TraceRecorder(gl::PassTimers& timers);

  // Around a frame of this plan.
  void begin(const graph::Plan& plan, std::uint64_t frame) { profiler_.begin(plan, frame); }
  void end(const runtime::FrameReport& report) { profiler_.end(report); }

  // False after W180. A trace that is being written is stopped first.
  bool start(const std::string& path, base::Diagnostics& diagnostics);
  bool stop(base::Diagnostics& diagnostics);
  bool recording() const { return trace_ != nullptr; }
  std::string path() const { return trace_ ? trace_->path() : std::string(); }
  std::uint64_t frames() const { return trace_ ? trace_->frames() : 0; }

  const std::deque<runtime::FrameProfile>& history() const { return profiler_.history(); }

 private:
  gl::PassTimers& timers_;
  runtime::FrameProfiler profiler_;
  std::unique_ptr<runtime::TraceFile> trace_;
  bool measuredBefore_ = false;
};

}  // namespace weft::app
