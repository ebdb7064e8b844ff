// Which calls a watch gets.
#include "engine/runtime/frame/step_watch.h"

#include <doctest/doctest.h>

#include <string>

using weft::runtime::StepWatch;

namespace {

std::string looksOf(const StepWatch& watch, std::string& said) {
  said.clear();
  for (std::size_t step = 0; step < 3; ++step) {
    const bool before = watch.lookBefore(step), after = watch.lookAfter(step);
    said += std::string(before ? "+" : "-") + (after ? "+" : "-") + " ";
  }
  return said;
}

}  // namespace

TEST_CASE("a watch is called around each step, or around the one that it names") {
  std::string said;
  StepWatch watch;
  CHECK_FALSE(watch.isSet());
  CHECK(looksOf(watch, said) == "-- -- -- ");
  watch.after = [&](std::uint32_t step) { said += "after " + std::to_string(step) + " "; };
  CHECK(watch.isSet());
  CHECK(looksOf(watch, said) == "after 0 -+ after 1 -+ after 2 -+ ");
  watch.before = [&](std::uint32_t step) { said += "before " + std::to_string(step) + " "; };
  watch.only = 1;
  CHECK(looksOf(watch, said) == "-- before 1 after 1 ++ -- ");
}
