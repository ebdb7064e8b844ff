// One bounce of light between spheres, as probes on the CPU have it, against brute force.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include "tests/theory/gi/probe_reading.h"
#include "tests/theory/gi/spheres.h"

using namespace weft::theory;

// One bounce by the definition: the light that a surface at `point` gets of the spheres, under an environment of radiance 1. The
// nearest sphere along a ray hides the others.
namespace {

glm::dvec3 bruteForce(glm::dvec3 point, glm::dvec3 normal, const std::vector<Instance>& spheres, int steps) {
  return integrate(normal, 0, steps, [&](glm::dvec3 d) {
    double nearest = 1e30;
    glm::dvec3 color(0);
    for (const Instance& sphere : spheres) {
      const glm::dvec3 center(sphere.center);
      if (!meets(point, d, center, double(sphere.radius))) continue;
      const double distance = glm::length(center - point);
      if (distance >= nearest) continue;
      nearest = distance;
      color = glm::dvec3(sphere.albedo * (1 - sphere.metallic));
    }
    return color * glm::dot(d, normal);
  });
}

}  // namespace

TEST_CASE("gi: one bounce between two spheres against brute force, at a probe and between probes") {
  const std::vector<Instance> spheres = {ball({-2.5f, 0, 0}, 1, {0.9f, 0.1f, 0.05f}),
                                         ball({2.5f, 0, 0}, 1, {0.1f, 0.8f, 0.2f})};
  // What nine numbers can hold, at a probe: no grid takes part.
  double held = 0, greatest = 0, sum = 0, between = 0;
  int count = 0;
  const ProbeRules rules{.far = 100};
  const ProbeGrid grid{.low = {-3.5f, -2, -2}, .high = {3.5f, 2, 2}, .count = {21, 13, 13}};
  const std::vector<Probe> probes = computeProbes(grid, rules, spheres);
  for (const glm::vec3& point :
       {glm::vec3(0, 0, 0), glm::vec3(0.31f, 0.9f, -0.5f), glm::vec3(-0.73f, -0.6f, 1.2f),
        glm::vec3(0.11f, 1.7f, 0.4f), glm::vec3(2.4f, 1.6f, 0.1f), glm::vec3(-1.1f, 0.2f, 0.9f)}) {
    const ProbeGrid one{.low = point, .high = point, .count = {1, 1, 1}};
    const Probe exact = computeProbes(one, rules, spheres)[0];
    const Probe mixed = probeAt(grid, probes, point);
    for (const glm::dvec3& normal : directions(30, 6)) {
      const glm::dvec3 truth = bruteForce(point, normal, spheres, 100);
      for (int c = 0; c < 3; ++c) {
        greatest = std::max(greatest, truth[c]);
        held = std::max(held, std::abs(double(irradianceOf(exact, normal)[c]) - truth[c]));
        const double off = std::abs(double(irradianceOf(mixed, normal)[c]) - truth[c]);
        between = std::max(between, off);
        sum += off;
        ++count;
      }
    }
  }
  MESSAGE("of the greatest irradiance ", greatest, ": worst at a probe ", held / greatest,
          ", between probes ", between / greatest, ", mean between probes ", sum / count / greatest);
  CHECK(greatest > 0.5);
  CHECK(held < 0.03 * greatest);
  CHECK(between < 0.03 * greatest);
  CHECK(sum / count < 0.01 * greatest);
}

TEST_CASE("gi: in a wall of spheres, which hide nothing here, a sphere gets about half more than it should") {
  std::vector<Instance> spheres;
  for (int i = 0; i < 100; ++i)
    spheres.push_back(ball({(i % 10 - 4.5f) * 2.5f, (i / 10 - 4.5f) * 2.5f, 0}, 1));
  const ProbeGrid grid = placeProbes(spheres, {21, 21, 3});
  const std::vector<Probe> probes = computeProbes(grid, {}, spheres);
  std::vector<Instance> others = spheres;
  others.erase(others.begin() + 44);
  double truth = 0, given = 0;
  for (const glm::dvec3& normal : directions(60, 9)) {
    const glm::dvec3 point = glm::dvec3(spheres[44].center) + normal;
    truth += bruteForce(point, normal, others, 16).x;
    given += irradianceOf(probeAt(grid, probes, glm::vec3(point)), glm::vec3(normal)).x;
  }
  MESSAGE("of the truth: ", given / truth);
  CHECK(given > 1.3 * truth);
  CHECK(given < 1.8 * truth);
}

// Where light stays what it is at the box, it is 9 to 12 times too much at the farthest.
TEST_CASE("gi: outside the box of the spheres their light falls off about as rays say") {
  std::vector<Instance> wall;
  for (int i = 0; i < 100; ++i) wall.push_back(ball({(i % 10 - 4.5f) * 2.5f, (i / 10 - 4.5f) * 2.5f, 0}, 1));
  const std::vector<Instance> floor = {ball({-0.36f, 0.2f, 0}, 0.2f), ball({0.36f, 0.2f, 0}, 0.2f),
                                       ball({0.12f, 0.1f, 0.3f}, 0.1f), ball({-0.2f, 0.07f, 0.36f}, 0.07f)};
  for (const auto& [name, spheres, counts] :
       {std::tuple("wall", wall, glm::uvec3(21, 21, 3)),
        std::tuple("on a floor", floor, glm::uvec3(19, 7, 10)),
        std::tuple("two", std::vector{ball({-2.5f, 0, 0}, 1), ball({2.5f, 0, 0}, 1)},
                   glm::uvec3(21, 13, 13))}) {
    const ProbeGrid grid = placeProbes(spheres, counts);
    const std::vector<Probe> probes = computeProbes(grid, {}, spheres);
    const glm::dvec3 half = glm::dvec3(grid.high - grid.low) * 0.5,
                     middle = glm::dvec3(grid.high + grid.low) * 0.5;
    for (const auto& [away, most] :
         {std::pair(0.1, 0.29), std::pair(0.3, 0.66), std::pair(1.0, 1.45), std::pair(2.0, 1.8)}) {
      double off = 0, all = 0;
      for (const glm::dvec3& to : directions(24, 5)) {
        // From the box outwards, by a share of its half diagonal.
        const glm::dvec3 side = glm::abs(to) / half;
        const glm::dvec3 at =
            middle + to * (1 / std::max({side.x, side.y, side.z}) + away * glm::length(half));
        for (const glm::dvec3& tilt : directions(4, 6)) {
          const glm::dvec3 normal = glm::normalize(0.7 * tilt - to);
          const double truth = bruteForce(at, normal, spheres, 60).x;
          off += std::abs(double(irradianceOf(probeAt(grid, probes, glm::vec3(at)), glm::vec3(normal)).x) -
                          truth);
          all += truth;
        }
      }
      MESSAGE(std::string(name), ", ", away, " of the half diagonal away: off by ", off / all,
              " of the light");
      CHECK(off < most * all);
    }
  }
}

TEST_CASE(
    "gi: the environment where the light comes from: right for light from one side and for a linear one, "
    "near for others") {
  // A probe far from one sphere: its light comes from one direction.
  const std::vector<Instance> one = {ball({0, 0, 0}, 1)};
  const auto probeOf = [](const std::vector<Instance>& spheres, glm::vec3 point) {
    return computeProbes({.low = point, .high = point, .count = {1, 1, 1}}, kBare, spheres)[0];
  };
  for (const glm::dvec3& from : directions(20, 11)) {
    const Bounce bounce = bounceOf(probeOf(one, glm::vec3(from * 60.0)), glm::vec3(-from));
    CHECK(glm::dot(glm::dvec3(bounce.facing), from) > 0.9999);
    CHECK(bounce.sure > 0.9f);  // band 3 would make it 1
  }
  Probe even{};
  even.sh[0] =
      glm::vec4(1);  // from everywhere: over the hemisphere the mean of the direction is 2/3 of the normal
  CHECK(bounceOf(even, {0, 1, 0}).facing.y == doctest::Approx(-1));
  CHECK(bounceOf(even, {0, 1, 0}).sure == doctest::Approx(0.5 + 0.5 * 2 / 3));
  CHECK(bounceOf(Probe{}, {0, 1, 0}).irradiance == glm::vec3(0));
  // Spheres on all sides under an irradiance that is bright above; the spheres throw it back where they are hit.
  std::vector<Instance> six;
  for (int side = 0; side < 6; ++side) {
    six.push_back(ball({0, 0, 0}, 1));
    six.back().center[side / 2] = side % 2 == 0 ? 2.2f : -2.2f;
  }
  const auto map = [](glm::dvec3 n) {
    return 0.6 + 0.4 * n.y + 2 * std::max(0.0, glm::dot(n, glm::normalize(glm::dvec3(1, 1, 1))));
  };
  const double plain = (map({0, 1, 0}) + map({0, -1, 0})) / 2;
  for (const auto& [spheres, distance, most] :
       {std::tuple(one, 1.3, 0.06), std::tuple(one, 2.5, 0.03), std::tuple(six, 0.6, 0.10)}) {
    double greatest = 0, off = 0, offByMean = 0;
    int count = 0;
    for (const glm::dvec3& from : directions(20, 12))
      for (const glm::dvec3& n : directions(8, 13)) {
        const glm::dvec3 point = from * distance;
        const double truth = integrate(n, 0, 40, [&](glm::dvec3 d) {
          double nearest = 1e30, light = 0;
          for (const Instance& sphere : spheres) {
            const glm::dvec3 out = point - glm::dvec3(sphere.center);
            const double along = -glm::dot(out, d), root = along * along - glm::dot(out, out) + 1;
            if (along < 0 || root < 0 || along >= nearest) continue;
            nearest = along;
            light = map(out + d * (along - std::sqrt(root)));
          }
          return light * glm::dot(d, n);
        });
        const Bounce bounce = bounceOf(probeOf(spheres, glm::vec3(point)), glm::vec3(n));
        const double share = double(bounce.irradiance.x), sure = double(bounce.sure);
        const double given = share * (sure * map(bounce.facing) + (1 - sure) * map(-bounce.facing));
        greatest = std::max(greatest, truth);
        off += std::abs(given - truth);
        offByMean += std::abs(share * plain - truth);
        ++count;
      }
    MESSAGE(spheres.size(), " at ", distance, ": off by ", off / count / greatest, " of the greatest; by ",
            offByMean / count / greatest, " with a mean");
    CHECK(off < 0.6 * offByMean);
    CHECK(off / count < most * greatest);
  }
}
