#include <doctest/doctest.h>

#include "app/output/standard_streams.h"

using namespace weft::app;

TEST_CASE("durations are as exact as an estimate is worth") {
  CHECK(durationText(-1) == "0.0 s");
  CHECK(durationText(4.24) == "4.2 s");
  CHECK(durationText(52.4) == "52 s");
  CHECK(durationText(120) == "2 min");
  CHECK(durationText(1790) == "30 min");
  CHECK(durationText(8023) == "2.2 h");
}

TEST_CASE("progress says what the frames before the first picture are for") {
  CHECK(progressText({.done = 0, .total = 4}) == "0/4 frames, 0.0 s left");
  CHECK(progressText({.done = 1, .total = 4, .seconds = 2}) == "1/4 frames, 6.0 s left");
  CHECK(progressText({.done = 251, .total = 501, .lead = 500, .seconds = 2510}) ==
        "251/501 frames, 500 of them lead up to the first picture, 42 min left");
  CHECK(progressText({.done = 3, .total = 13, .seconds = 9, .first = 5}) == "3/13 frames, 20 s left");
  CHECK(progressText({.done = 4, .total = 4, .seconds = 8}) == "4/4 frames in 8.0 s");
}
