// The variant of deferred.json that stores positions, on meshes that turn and walk: what RGBA16F holds is what depth gives within its
// greatest.
#include <algorithm>
#include <cmath>

#include "tests/runtime/stage.h"

namespace deferred_positions_test {

using namespace weft;
using namespace weft::runtime::test;

namespace {

constexpr std::uint32_t kWidth = 160, kHeight = 120;

// The distance between neighboring halves about x: eleven bits of significand, 2^-24 below 2^-14. What lies between two of them becomes
// either, as the driver likes; this one takes the one nearer to 0.
double stepAt(double x) {
  int exponent = 0;
  std::frexp(x, &exponent);
  return std::ldexp(1.0, std::max(exponent, -13) - 11);
}

struct Found {
  int surfaces = 0;
  double worst = 0;     // difference, as a share of what halves and depth allow
  double greatest = 0;  // in world units
};

Found compare(const std::string& scene, std::uint32_t frame) {
  Stage stage("tests/theory/deferred/positions.json", kWidth, kHeight, scene);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(frame);
  const std::vector<float> panels = stage.read("panels");
  const auto at = [&](std::uint32_t panel, std::uint32_t x, std::uint32_t y) {
    return &panels[(std::size_t{y} * 4 * kWidth + panel * kWidth + x) * 4];
  };
  const glm::dvec3 eye(headlessFrame(stage.world, frame, 60).pose.position);
  Found found;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      if (at(2, x, y)[0] <= 0) continue;
      const float *place = at(0, x, y), *stored = at(1, x, y);
      CHECK(stored[3] == 1);
      ++found.surfaces;
      const double distance = glm::length(glm::dvec3(place[0], place[1], place[2]) - eye);
      for (int axis = 0; axis < 3; ++axis) {
        const double apart = std::abs(double(place[axis]) - double(stored[axis]));
        found.greatest = std::max(found.greatest, apart);
        found.worst = std::max(found.worst, apart / (stepAt(double(place[axis])) + 1e-5 * distance));
      }
    }
  return found;
}

}  // namespace

TEST_CASE(
    "G-buffer of meshes: stored positions are those of depth within a step of RGBA16F and 1e-5 of the "
    "distance") {
  const CleanScope clean;
  // A skinned fox that walks, and rocks that turn under a camera that turns.
  for (const std::string scene : {"scenes/fox.json", "tests/runtime/scenes/everything.json"}) {
    CAPTURE(scene);
    const Found found = compare(scene, 5);
    MESSAGE(scene << ": " << found.surfaces << " surfaces, worst " << found.greatest << " world units, "
                  << found.worst << " of what is allowed");
    CHECK(found.surfaces > 1500);
    CHECK(found.worst < 1);
    CHECK(found.worst > 0.5);  // it is halves that are compared
  }
}

}  // namespace deferred_positions_test
