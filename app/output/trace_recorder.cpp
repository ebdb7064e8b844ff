#include "app/output/trace_recorder.h"

namespace weft::app {

TraceRecorder::TraceRecorder(gl::PassTimers& timers) : timers_(timers), profiler_(timers) {
  profiler_.setSink([this](const runtime::FrameProfile& profile) {
    if (trace_) trace_->add(profile);
  });
}

bool TraceRecorder::start(const std::string& path, base::Diagnostics& diagnostics) {
  stop(diagnostics);
  trace_ = runtime::TraceFile::create(path, diagnostics);
  if (!trace_) return false;
  measuredBefore_ = timers_.enabled();
  timers_.setEnabled(true);
  return true;
}

bool TraceRecorder::stop(base::Diagnostics& diagnostics) {
  if (!trace_) return true;
  profiler_.finish();
  timers_.setEnabled(measuredBefore_);
  const bool written = trace_->close(diagnostics);
  trace_.reset();
  return written;
}

}  // namespace weft::app
