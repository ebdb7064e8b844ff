// Light probes as tasks: the same as without, on any number of threads.
#include "engine/scene/probes/probe_work.h"

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

TEST_CASE("probes are the same, byte for byte, on 1, 2 and 4 threads, and outside of tasks") {
  for (const glm::uvec3 count : {glm::uvec3(21, 21, 3), glm::uvec3(4, 1, 37), glm::uvec3(5, 1, 1)}) {
    ProbeWork::Job job{.rules = {}, .count = count, .spheres = scatteredSpheres(200)};
    const ProbeGrid grid = placeProbes(job.spheres, count);
    std::vector<Probe> wanted(grid.size());
    REQUIRE(computeProbes(grid, job.rules, job.spheres, wanted));
    CHECK(irradianceOf(wanted[0], {0, 1, 0}).x + irradianceOf(wanted.back(), {0, -1, 0}).x > 0);
    ProbeWork work;
    for (const int threads : {1, 2, 4, 2}) {
      job.threads = threads;
      ProbeWork::Result result;
      REQUIRE(work.run(job, result));
      CHECK(areSame(result.probes, wanted));
      CHECK((result.grid.low == grid.low && result.grid.high == grid.high && result.grid.count == count));
    }
  }
}

TEST_CASE("probes that are cancelled say so, and can be computed afterwards") {
  ProbeWork work;
  ProbeWork::Job job{.rules = {}, .count = {8, 8, 8}, .spheres = scatteredSpheres(50), .threads = 2};
  ProbeWork::Result result;
  std::atomic<bool> cancelled = true;
  CHECK_FALSE(work.run(job, result, &cancelled));
  cancelled = false;
  CHECK(work.run(job, result, &cancelled));
  std::vector<Probe> wanted(result.grid.size());
  REQUIRE(computeProbes(result.grid, job.rules, job.spheres, wanted));
  CHECK(areSame(result.probes, wanted));
}
