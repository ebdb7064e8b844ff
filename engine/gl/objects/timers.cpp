#include "engine/gl/objects/timers.h"

#include <cassert>
#include <chrono>

namespace weft::gl {

double steadyMs() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

PassTimers::PassTimers(const DeviceInfo& device)
    : queries_(device.hasTimerQueries && !device.software) {}  // workarounds.md: timer-queries-lie

void PassTimers::setEnabled(bool enabled) {
  if (enabled_ && !enabled) finish();
  enabled_ = enabled;
}

void PassTimers::beginFrame(std::uint32_t passes) {
  if (!enabled_) return;
  current_ = (current_ + 1) % kFramesInFlight;
  Frame& frame = frames_[current_];
  if (frame.pending) collect(frame);
  frame.times.assign(passes, PassTime{});
  frame.last.reset();
  if (!queries_) return;
  while (frame.starts.size() < passes) {
    frame.starts.push_back(Query::create(GL_TIMESTAMP, "pass start"));
    frame.ends.push_back(Query::create(GL_TIMESTAMP, "pass end"));
  }
}

void PassTimers::begin(std::uint32_t pass) {
  if (!enabled_) return;
  Frame& frame = frames_[current_];
  assert(pass < frame.times.size());
  if (queries_)
    glQueryCounter(frame.starts[pass].id(), GL_TIMESTAMP);
  else
    glFinish();
  cpuStart_ = steadyMs();
}

void PassTimers::end(std::uint32_t pass) {
  if (!enabled_) return;
  Frame& frame = frames_[current_];
  PassTime& time = frame.times[pass];
  time.ran = true;
  time.cpu += steadyMs() - cpuStart_;
  frame.last = pass;
  if (queries_) {
    glQueryCounter(frame.ends[pass].id(), GL_TIMESTAMP);
  } else {
    glFinish();
    time.gpu += steadyMs() - cpuStart_;
  }
}

void PassTimers::endFrame() {
  if (!enabled_) return;
  frames_[current_].pending = true;
  collectPending(false);
}

void PassTimers::collect(Frame& frame) {
  if (queries_)
    for (std::size_t i = 0; i < frame.times.size(); ++i)
      if (frame.times[i].ran)
        frame.times[i].gpu = static_cast<double>(frame.ends[i].result() - frame.starts[i].result()) * 1e-6;
  results_.assign(frame.times.begin(), frame.times.end());
  frame.pending = false;
}

void PassTimers::collectPending(bool waits) {
  for (std::size_t i = 1; i <= kFramesInFlight; ++i) {
    Frame& frame = frames_[(current_ + i) % kFramesInFlight];
    if (!frame.pending) continue;
    if (!waits && queries_ && frame.last && !frame.ends[*frame.last].available()) break;
    collect(frame);
  }
}

}  // namespace weft::gl
