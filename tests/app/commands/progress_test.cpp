#include "app/output/progress.h"

#include <doctest/doctest.h>

using namespace weft::app;

TEST_CASE("durations are as exact as an estimate is worth") {
  CHECK(durationText(-1) == "0 s");
  CHECK(durationText(0) == "0 s");
  CHECK(durationText(4.24) == "4.2 s");
  CHECK(durationText(52.4) == "52 s");
  CHECK(durationText(100) == "1 min 40 s");
  CHECK(durationText(120) == "2 min");
  CHECK(durationText(1790) == "29 min");
  CHECK(durationText(3600) == "1 h");
  CHECK(durationText(8023) == "2 h 13 min");
  CHECK(durationText(273'600) == "3 days 4 h");
}

TEST_CASE("progress says what the frames before the first picture are for") {
  CHECK(progressText({.done = 0, .total = 4}) == "[........................................] 0/4 frames");
  CHECK(progressText({.done = 1, .total = 4, .seconds = 2}) ==
        "[##########..............................] 1/4 frames, 6.0 s left");
  CHECK(progressText({.done = 251, .total = 501, .lead = 500, .seconds = 2510}) ==
        "[####################....................] 251/501 frames, 500 of them lead up to the first "
        "picture, 41 min left");
  CHECK(progressText({.done = 4, .total = 4, .seconds = 8}) ==
        "[########################################] 4/4 frames in 8.0 s");
}

TEST_CASE(
    "a terminal has the bar after each frame; a file or a pipe has a line now and then, without control "
    "codes") {
  ProgressLines bar(true), lines(false);
  std::string written;
  std::size_t count = 0;
  for (std::uint64_t done = 1; done <= 100; ++done) {
    const Progress progress{.done = done, .total = 100, .seconds = 0.5 * static_cast<double>(done)};
    const std::string drawn = bar.after(progress);
    CHECK(drawn.starts_with("\r["));
    CHECK(drawn.ends_with('\n') == (done == 100));
    const std::string line = lines.after(progress);
    count += !line.empty();
    written += line;
  }
  CHECK(count == 5);  // at 10, 20, 30 and 40 seconds, and at the end
  CHECK(written ==
        "20/100 frames, 40 s left\n40/100 frames, 30 s left\n60/100 frames, 20 s left\n80/100 frames, 10 s "
        "left\n"
        "100/100 frames in 50 s\n");
}
