#include "app/session/progress.h"

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
