// A million instances through the studio: the same picture whoever sorts.
#include <doctest/doctest.h>

#include "tests/theory/lab.h"

namespace crowd_test {

using namespace weft::theory;

TEST_CASE("a million spheres: rendered, and one picture for all sorts") {
  Setup setup{.graph = "tests/theory/draw_modes.json", .width = 64, .height = 36};
  setup.camera = {.position = {70, 45, 160}, .target = {0, 0, 0}, .fovDegrees = 60, .nearPlane = 0.1};
  setup.balls.reserve(1000000);
  for (int z = 0; z < 100; ++z)
    for (int y = 0; y < 100; ++y)
      for (int x = 0; x < 100; ++x)
        setup.balls.push_back(
            {.center = {(x - 49.5f) * 1.5f, (y - 49.5f) * 1.5f, (z - 49.5f) * 1.5f},
             .radius = 0.4f,
             .albedo = {0.2f + 0.006f * static_cast<float>(x), 0.5f, 0.2f + 0.006f * static_cast<float>(y)}});
  std::vector<float> first;
  for (const char* sort : {"gpu_bitonic", "cpu_radix"}) {
    setup.sets = {{"sort", sort}};
    Lab lab(setup);
    lab.frame();
    const Picture panels = lab.read("panels");
    int covered = 0;
    for (std::uint32_t y = 0; y < setup.height; ++y)
      for (std::uint32_t x = 0; x < setup.width; ++x) covered += panels.at(3 * setup.width + x, y)[0] > 0;
    CAPTURE(sort);
    CHECK(covered > 300);
    if (first.empty()) first = panels.texels;
    CHECK(first == panels.texels);
    CHECK(lab.reports() == "");
  }
}

}  // namespace crowd_test
