// The text of the progress of `weft render`: a bar on a terminal, a line now and then elsewhere. Does not: print, or know a clock.
#pragma once

#include <cstdint>
#include <string>

namespace weft::app {

// "4.2 s", "52 s", "12 min", "2 h 13 min", "3 days 4 h": as exact as an estimate is worth.
std::string durationText(double seconds);

// The frames of one run: of `total`, `lead` run only because a later frame looks back at them, and `done` are finished after
// `seconds`.
struct Progress {
  std::uint64_t done = 0, total = 1, lead = 0;
  double seconds = 0;
  const char* unit = "frames";  // what is counted
};

// "[####....] 12/501 frames, 500 of them lead up to the first picture, 2 h 13 min left".
std::string progressText(const Progress& progress);

// What to print after each frame.
class ProgressLines {
 public:
  // `terminal`: the bar, drawn over itself. Else a line each kPause seconds, and one at the end.
  explicit ProgressLines(bool terminal) : terminal_(terminal) {}
  std::string after(const Progress& progress);

  static constexpr double kPause = 10;

 private:
  bool terminal_;
  double last_ = 0;
};

}  // namespace weft::app
