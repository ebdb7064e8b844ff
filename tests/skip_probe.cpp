// Cases for tests/skips.py, which looks at the exit codes of this executable under different filters.
#include <doctest/doctest.h>

#include <cstdlib>

#include "tests/skip.h"

TEST_CASE("runs" * doctest::test_suite("runs")) {
  CHECK(true);
}

TEST_CASE("skips" * doctest::test_suite("skips")) {
  return weft::test::skipCase("no moon tonight");
}

TEST_CASE("skips too" * doctest::test_suite("skips")) {
  return weft::test::skipCase("no sun either");
}

TEST_CASE("fails and skips" * doctest::test_suite("fails")) {
  CHECK(false);
  return weft::test::skipCase("after a failure");
}

TEST_CASE("fails, then all of it skips" * doctest::test_suite("fails_first")) {
  CHECK(false);
  weft::test::skipAll("no context");
}

TEST_CASE("all of it skips" * doctest::test_suite("all")) {
  weft::test::skipAll("no context");
}

TEST_CASE("skips quietly" * doctest::test_suite("quiet") *
          doctest::skip(std::getenv("WEFT_PROBE_QUIET") != nullptr)) {
  CHECK(true);
}
