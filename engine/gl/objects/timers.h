// Time per pass of a frame, in milliseconds. On hardware by timestamp queries that are collected some frames
// later and never stall; on software rasterizers, whose timer queries lie, by the wall clock between
// glFinish. Off until enabled: then begin() and end() do nothing. No heap allocation in a frame once its
// number of passes was seen.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/gl/context/context.h"
#include "engine/gl/objects/objects.h"

namespace weft::gl {

struct PassTime {
  bool ran = false;
  double gpu = 0;  // ms
  double cpu = 0;  // ms between begin() and end() on this thread, without the finish
};

// The steady clock in ms.
double steadyMs();

class PassTimers {
 public:
  explicit PassTimers(const DeviceInfo& device);

  void setEnabled(bool enabled);
  bool enabled() const { return enabled_; }
  bool usesQueries() const { return queries_; }

  // passes: how many indices begin() may name. Every begin(i) is followed by end(i); they do not nest.
  void beginFrame(std::uint32_t passes);
  void begin(std::uint32_t pass);
  void end(std::uint32_t pass);
  void endFrame();

  // The newest frame whose times are complete (with queries some frames old); empty before the first.
  std::span<const PassTime> results() const { return results_; }
  // Waits for all frames in flight; results() is then the last one.
  void finish() { collectPending(true); }

 private:
  static constexpr std::size_t kFramesInFlight = 4;
  struct Frame {
    std::vector<Query> starts, ends;
    std::vector<PassTime> times;
    bool pending = false;
    std::optional<std::uint32_t> last{};  // the pass that ended last
  };
  void collect(Frame& frame);       // waits when it must
  void collectPending(bool waits);  // oldest first, so that results() only moves forward
  bool queries_ = false, enabled_ = false;
  Frame frames_[kFramesInFlight];
  std::size_t current_ = 0;
  double cpuStart_ = 0;
  std::vector<PassTime> results_;
};

}  // namespace weft::gl
