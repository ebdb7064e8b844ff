// The text of the progress bar of `weft render`. Does not: print, or know a clock.
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
};

// "[####....] 12/501 frames, 500 of them lead up to the first picture, 2 h 13 min left".
std::string progressText(const Progress& progress);

}  // namespace weft::app
