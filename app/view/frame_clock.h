// The time that frames see: the wall clock, less what frames take that did more than their picture; or a fixed step per frame while a
// recording is on. A person can hold it, go on by a frame, and begin anew.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

namespace weft::app {

class FrameClock {
 public:
  static constexpr double kWorkStep = 0.05, kHeldStep = 1.0 / 60;  // seconds

  struct Tick {
    double time = 0, delta = 0;  // seconds since the start, since the frame before
  };

  // The next frame, at `wall` seconds of any clock.
  Tick tick(double wall) {
    double passed = started_ ? std::max(0.0, wall - wall_) : 0.0;
    if (std::exchange(worked_, false)) passed = std::min(passed, kWorkStep);
    started_ = true;
    wall_ = wall;
    if (fps_ > 0) {
      // Not summed up: frame n of a recording that begins at 0 has the time that `weft render` gives it.
      last_ = {base_ + frames_ / fps_, 1 / fps_};
      ++frames_;
    } else {
      if (paused_) passed = std::exchange(step_, false) ? kHeldStep : 0;
      last_ = std::exchange(anew_, false) ? Tick{} : Tick{last_.time + passed, passed};
    }
    return last_;
  }
  // The time up to `wall` does not count.
  void skip(double wall) {
    wall_ = wall;
    started_ = true;
  }
  // The last frame did more than its picture: it counts for kWorkStep at most, so that a fade that begins there is seen.
  void worked() { worked_ = true; }
  // Fixed steps from the next frame on (before any frame: from 0); with 0 the wall clock again.
  void fix(double fps) {
    fps_ = fps;
    base_ = started_ ? last_.time + 1 / fps : 0;
    frames_ = 0;
  }
  // Time stands still, but for steps. A recording goes on.
  void pause(bool on) { paused_ = on; }
  bool paused() const { return paused_; }
  void step() { paused_ = step_ = true; }
  // The next frame is at 0.
  void begin() { anew_ = true; }
  Tick last() const { return last_; }

 private:
  Tick last_;
  double wall_ = 0, base_ = 0, fps_ = 0;
  std::uint32_t frames_ = 0;
  bool started_ = false, worked_ = false, paused_ = false, step_ = false, anew_ = false;
};

// Whether the picture has come to rest, for idle mode: several looks in a row, spread over longer than any fade's slowest visible step,
// saw the same. Nobody has to list what may move.
class PictureRest {
 public:
  static constexpr double kBetweenLooks = 0.1;  // seconds
  static constexpr int kLooks = 5;

  // Something happened that may move the picture, even if it cannot be seen yet.
  void disturb() { same_ = 0; }
  bool resting() const { return same_ >= kLooks; }
  bool wantsLook(double now) const { return !resting() && (same_ == 0 || now - lookedAt_ >= kBetweenLooks); }
  void look(double now, std::uint64_t hash) {
    same_ = same_ > 0 && hash == hash_ ? same_ + 1 : 1;
    hash_ = hash;
    lookedAt_ = now;
  }

 private:
  std::uint64_t hash_ = 0;
  double lookedAt_ = 0;  // seconds
  int same_ = 0;         // looks in a row
};

}  // namespace weft::app
