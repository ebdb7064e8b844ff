// How far a long run is, on standard error: a bar on a terminal, elsewhere a line every ten seconds,
// so that a quick run says nothing.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace weft::app {

// "4.2 s", "52 s", "12 min", "2.2 h": as exact as an estimate is worth.
std::string durationText(double seconds);

// Of `total`, `lead` frames run only because a later frame looks back at them, and `done` are finished after `seconds`.
struct Progress {
  std::uint64_t done = 0, total = 1, lead = 0;
  double seconds = 0;
  const char* unit = "frames";  // what is counted
};

// "12/501 frames, 500 of them lead up to the first picture, 2.2 h left".
std::string progressText(const Progress& progress);

class ProgressLines {
 public:
  explicit ProgressLines(Progress progress) : progress_(progress) {}
  // To be called when one more is done.
  void countOne();

 private:
  Progress progress_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double printed_ = 0;  // seconds
};

}  // namespace weft::app
