#include "engine/base/nearest.h"

#include <doctest/doctest.h>

using namespace weft::base;

TEST_CASE("edit distance counts swaps once") {
  CHECK(editDistance("depth", "dpeth") == 1);
  CHECK(editDistance("", "abc") == 3);
  CHECK(editDistance("Scene", "scene") == 0);
}

TEST_CASE("nearest name, or the list when nothing is near") {
  const std::vector<std::string> names = {"scene", "glow", "ldr"};
  CHECK(nearestName("scne", names) == "scene");
  CHECK(nearestName("velocity", names).empty());
  CHECK(nearestHint("glwo", names) == "did you mean 'glow'?");
  CHECK(nearestHint("velocity", names) == "known: scene, glow, ldr");
}

TEST_CASE("names that are as near are all offered") {
  const std::vector<std::string> formats = {"rgba8", "rgba16", "rgba16f", "r8"};
  CHECK(weft::base::nearestHint("rgba16q", formats) == "did you mean 'rgba16' or 'rgba16f'?");
}
