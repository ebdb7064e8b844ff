// Light probes: the same on any number of threads.
#include "engine/scene/probes/probes.h"

#include <doctest/doctest.h>

#include <cstring>
#include <random>

using namespace weft::scene;

namespace {

std::vector<Instance> scatteredSpheres(std::size_t count) {
  std::mt19937 random(17);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<Instance> spheres(count);
  for (Instance& sphere : spheres) {
    sphere.center = glm::vec3(unit(random), unit(random), unit(random)) * 20.0f;
    sphere.radius = 0.2f + unit(random);
    sphere.albedo = {unit(random), unit(random), unit(random)};
  }
  return spheres;
}

bool areSame(const std::vector<Probe>& a, const std::vector<Probe>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Probe)) == 0;
}

}  // namespace

TEST_CASE("probes are the same, byte for byte, on 1, 2 and 4 threads") {
  for (const glm::uvec3 count : {glm::uvec3(21, 21, 3), glm::uvec3(4, 1, 37), glm::uvec3(5, 1, 1)}) {
    const std::vector<Instance> spheres = scatteredSpheres(200);
    const ProbeGrid grid = placeProbes(spheres, count);
    std::vector<Probe> wanted(grid.size()), found(grid.size());
    REQUIRE(computeProbes(grid, {}, spheres, wanted));
    CHECK(wanted[0].sh[0].x + wanted.back().sh[0].x > 0);
    for (const int threads : {2, 4, 2}) {
      REQUIRE(computeProbes(grid, {}, spheres, found, nullptr, threads));
      CHECK(areSame(found, wanted));
    }
  }
}

TEST_CASE("probes that are canceled say so, and can be computed afterwards") {
  const std::vector<Instance> spheres = scatteredSpheres(50);
  const ProbeGrid grid = placeProbes(spheres, {8, 8, 8});
  std::vector<Probe> wanted(grid.size()), found(grid.size());
  std::atomic<bool> canceled = true;
  CHECK_FALSE(computeProbes(grid, {}, spheres, found, &canceled, 2));
  canceled = false;
  CHECK(computeProbes(grid, {}, spheres, found, &canceled, 2));
  REQUIRE(computeProbes(grid, {}, spheres, wanted));
  CHECK(areSame(found, wanted));
}
