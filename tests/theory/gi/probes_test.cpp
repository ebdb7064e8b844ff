// Light probes on the CPU against integrals written from the definitions: projection and irradiance of a known function, the
// cap of a sphere by counting rays that meet it.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <random>
#include <tuple>
#include <vector>

#include "tests/theory/gi/probe_reading.h"
#include "tests/theory/gi/probe_reference.h"
#include "tests/theory/gi/spheres.h"

using namespace weft::theory;

namespace {

// Of band 2 at most, so that nine numbers hold it.
double known(glm::dvec3 d) {
  return 1 + 0.5 * d.x - 2 * d.y + 0.3 * d.z + 1.5 * d.x * d.y - 0.7 * d.y * d.z + 2 * d.z * d.z +
         0.4 * d.x * d.z - 1.1 * d.x * d.x;
}

Probe projected(const std::function<double(glm::dvec3)>& f) {
  Probe probe{};
  for (std::size_t i = 0; i < kShCount; ++i)
    probe.sh[i] = glm::vec4(static_cast<float>(integrate(
        glm::dvec3(0, 0, 1), -1, 40, [&](glm::dvec3 d) { return f(d) * double(shBasis(glm::vec3(d))[i]); })));
  return probe;
}

double signedSum(const Probe& probe, glm::dvec3 d) {
  double sum = 0;
  for (std::size_t i = 0; i < kShCount; ++i) sum += double(probe.sh[i].x) * double(shBasis(glm::vec3(d))[i]);
  return sum;
}

constexpr int lobeBandOf(std::size_t i) {
  return i == 0 ? 0 : i < 4 ? 1 : 2;
}

std::vector<Instance> cloud(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-10, 10), share(0, 1);
  std::vector<Instance> spheres;
  for (int i = 0; i < count; ++i)
    spheres.push_back(ball({place(random), place(random), place(random)}, 0.1f + share(random),
                           {share(random), share(random), share(random)}, share(random)));
  return spheres;
}

}  // namespace

TEST_CASE("gi: the nine functions are orthonormal, and a function of band 2 is its projection to 1e-5") {
  for (std::size_t i = 0; i < kShCount; ++i)
    for (std::size_t k = 0; k <= i; ++k) {
      const double product = integrate(glm::dvec3(0, 0, 1), -1, 40, [&](glm::dvec3 d) {
        const auto y = shBasis(glm::vec3(d));
        return double(y[i]) * double(y[k]);
      });
      CAPTURE(i);
      CAPTURE(k);
      CHECK(std::abs(product - (i == k ? 1.0 : 0.0)) < 1e-5);
    }
  const Probe probe = projected(known);
  for (const glm::dvec3& d : directions(200, 1)) CHECK(std::abs(signedSum(probe, d) - known(d)) < 1e-5);
}

TEST_CASE("gi: irradiance of a known function by the cosine lobe is the integral over the hemisphere") {
  Probe probe = projected([](glm::dvec3 d) { return known(d) + 3; });  // so that nothing is below zero
  for (std::size_t i = 0; i < kShCount; ++i) probe.sh[i] *= kCosineLobe[lobeBandOf(i)];
  double worst = 0;
  for (const glm::dvec3& n : directions(40, 2)) {
    const double truth = integrate(n, 0, 40, [&](glm::dvec3 d) { return (known(d) + 3) * glm::dot(d, n); });
    REQUIRE(truth > 0);
    worst = std::max(worst, std::abs(double(irradianceOf(probe, glm::vec3(n)).x) - truth) / truth);
  }
  MESSAGE("worst error: ", worst);
  CHECK(worst < 1e-5);
}

TEST_CASE("gi: the cap of a sphere is what rays that meet it say, within 1 %, from 1.05 radii outwards") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0, 1);
  double worst = 0;
  for (const double distance : {1.05, 1.1, 1.3, 1.7, 2.5, 4.0, 8.0, 30.0})
    for (const glm::dvec3& axis : directions(6, static_cast<unsigned>(distance * 100))) {
      // Directions in a cone that is a fifth wider than the sphere, one in each cell of its solid angle.
      const double radius = 0.7, edge = std::cos(std::min(1.2 * std::asin(1 / distance), kPiD));
      const glm::dvec3 side =
          glm::normalize(std::abs(axis.x) < 0.7 ? glm::cross(axis, {1, 0, 0}) : glm::cross(axis, {0, 1, 0}));
      const glm::dvec3 up = glm::cross(axis, side);
      constexpr int kCells = 300;
      std::array<double, kShCount> sums{};
      for (int i = 0; i < kCells; ++i)
        for (int j = 0; j < kCells; ++j) {
          const double c = edge + (1 - edge) * (i + share(random)) / kCells, s = std::sqrt(1 - c * c);
          const double phi = 2 * kPiD * (j + share(random)) / kCells;
          const glm::dvec3 d = axis * c + side * (s * std::cos(phi)) + up * (s * std::sin(phi));
          if (!meets({}, d, axis * (distance * radius), radius)) continue;
          const auto y = shBasis(glm::vec3(d));
          for (std::size_t n = 0; n < kShCount; ++n)
            sums[n] += double(y[n]) * 2 * kPiD * (1 - edge) / (kCells * kCells);
        }
      const glm::vec3 offset(axis * (distance * radius * 1.000001));
      const glm::vec3 bands = bandsOfSphere(kBare, offset, static_cast<float>(radius)) / kCosineLobe;
      const auto y = shBasis(glm::normalize(offset));
      for (int band = 0; band < 3; ++band) {
        double error = 0, size = 0;
        for (std::size_t n = 0; n < kShCount; ++n) {
          if (lobeBandOf(n) != band) continue;
          error += std::pow(sums[n] - double(bands[band] * y[n]), 2);
          size += std::pow(sums[n], 2);
        }
        worst = std::max(worst, std::sqrt(error / size));
        CAPTURE(distance);
        CAPTURE(band);
        CHECK(std::sqrt(error) < 0.01 * std::sqrt(size));
      }
    }
  MESSAGE("worst error: ", worst);
}

TEST_CASE(
    "gi: a probe in a sphere or nearer than 1.05 radii gets nothing of it, nor one at the far distance") {
  const ProbeRules rules;
  const auto lit = [&](float distance) { return bandsOfSphere(rules, glm::vec3(0, 0, 2 * distance), 2.0f); };
  for (const float distance : {0.0f, 0.5f, 1.0f, 1.0499f, 10.0f, 11.0f, 1e20f, NAN}) {
    CAPTURE(distance);
    CHECK(lit(distance) == glm::vec3(0));
  }
  CHECK(lit(1.0501f).x > 1.0f);
  CHECK(lit(9.0f).x > 0.0f);
  CHECK(bandsOfSphere(rules, {0, 0, 2}, 0.0f) == glm::vec3(0));
  // The window is smooth: no step at its end, and near the sphere it takes next to nothing.
  CHECK(lit(9.99f).x < 1e-5f * lit(2.0f).x);
  CHECK(lit(2.0f).x == doctest::Approx(bandsOfSphere(kBare, {0, 0, 4}, 2.0f).x).epsilon(0.004));
  const ProbeRules hard{.far = 3, .window = ProbeWindow::hard};
  CHECK(bandsOfSphere(hard, {0, 0, 5.99f}, 2.0f) == bandsOfSphere(kBare, {0, 0, 5.99f}, 2.0f));
  CHECK(bandsOfSphere(hard, {0, 0, 6}, 2.0f) == glm::vec3(0));
}

TEST_CASE("gi: a point is as strong as the cap far away, and lights from one direction") {
  const ProbeRules point{.near = 1, .far = 1e5f, .shape = ProbeShape::point};
  const glm::vec3 far = bandsOfSphere(point, {0, 0, 50}, 1.0f), cap = bandsOfSphere(kBare, {0, 0, 50}, 1.0f);
  for (int band = 0; band < 3; ++band) CHECK(far[band] == doctest::Approx(cap[band]).epsilon(4e-4));
  const glm::vec3 near = bandsOfSphere(point, {0, 0, 2}, 1.0f) / kCosineLobe;
  CHECK(near.x == near.y);
  CHECK(near.y == near.z);
  CHECK(near.y == doctest::Approx(kPiD / 4));
}

TEST_CASE("gi: a grid has what each sphere gives each probe, added up; none is left out, metals give none") {
  const std::vector<Instance> spheres = cloud(200, 4);
  for (const ProbeRules& rules :
       {ProbeRules{}, ProbeRules{.far = 3, .window = ProbeWindow::hard}, ProbeRules{.far = 500}}) {
    const ProbeGrid grid = placeProbes(spheres, {7, 5, 4});
    const std::vector<Probe> probes = computeProbes(grid, rules, spheres);
    std::size_t lit = 0;
    for (std::uint32_t k = 0; k < 4; ++k)
      for (std::uint32_t j = 0; j < 5; ++j)
        for (std::uint32_t i = 0; i < 7; ++i) {
          Probe expected{};
          for (const Instance& sphere : spheres) {
            const glm::vec3 offset = sphere.center - grid.position({i, j, k});
            const glm::vec3 bands = bandsOfSphere(rules, offset, sphere.radius);
            const auto y = shBasis(glm::normalize(offset));
            for (std::size_t n = 0; n < kShCount && bands.x > 0; ++n)
              expected.sh[n] +=
                  glm::vec4(bands[lobeBandOf(n)] * y[n] * sphere.albedo * (1 - sphere.metallic), 0);
          }
          const Probe& probe = probes[grid.indexOf({i, j, k})];
          lit += probe.sh[0].x > 0;
          for (std::size_t n = 0; n < kShCount; ++n)
            for (int c = 0; c < 3; ++c)
              CHECK(probe.sh[n][c] == doctest::Approx(expected.sh[n][c]).epsilon(1e-4));
        }
    CHECK(lit > 10);
  }
  std::vector<Instance> metals = spheres;
  for (Instance& sphere : metals) sphere.metallic = 1;
  for (const Probe& probe : computeProbes(placeProbes(metals, {5, 5, 5}), {}, metals))
    for (const glm::vec4& each : probe.sh) CHECK(each == glm::vec4(0));
}

TEST_CASE(
    "gi: probes stand from corner to corner of the spheres' box, alone in the middle; without spheres there "
    "is no light") {
  const std::vector<Instance> spheres = {ball({1, 2, 3}, 1), ball({-4, 0, 3}, 0.5f)};
  const ProbeGrid grid = placeProbes(spheres, {3, 2, 1});
  CHECK(grid.low == glm::vec3(-4.5f, -0.5f, 2));
  CHECK(grid.high == glm::vec3(2, 3, 4));
  CHECK(grid.position({0, 0, 0}) == glm::vec3(-4.5f, -0.5f, 3));
  CHECK(grid.position({1, 1, 0}) == glm::vec3(-1.25f, 3, 3));
  CHECK(grid.position({2, 0, 0}).x == 2);
  CHECK(grid.size() == 6);
  const ProbeGrid none = placeProbes({}, {2, 2, 2});
  for (const Probe& probe : computeProbes(none, {}, {}))
    CHECK(irradianceOf(probe, {0, 1, 0}) == glm::vec3(0));
}

TEST_CASE("gi: between probes their mix is linear, and outside the box it falls off without a step") {
  const ProbeGrid grid{.low = {-1, 0, 2}, .high = {3, 5, 2.5f}, .count = {4, 3, 2}};
  const auto plane = [](glm::vec3 p) { return 1.0f + 2.0f * p.x - 3.0f * p.y + 0.5f * p.z; };
  std::vector<Probe> probes(grid.size());
  for (std::uint32_t k = 0; k < 2; ++k)
    for (std::uint32_t j = 0; j < 3; ++j)
      for (std::uint32_t i = 0; i < 4; ++i)
        for (std::size_t n = 0; n < kShCount; ++n)
          probes[grid.indexOf({i, j, k})].sh[n] =
              glm::vec4(plane(grid.position({i, j, k})) * static_cast<float>(n + 1));
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-3, 7);
  for (int i = 0; i < 200; ++i) {
    const glm::vec3 point(place(random), place(random), place(random));
    const Probe probe = probeAt(grid, probes, point);
    const glm::vec3 edge = glm::clamp(point, grid.low, grid.high);
    const float left = leftOutside(grid, point), expected = left * plane(edge);
    CHECK(probe.sh[0].x == doctest::Approx(expected).epsilon(1e-4).scale(10));
    CHECK(probe.sh[8].x == doctest::Approx(9 * expected).epsilon(1e-4).scale(90));
    CHECK(leftOutside(grid, edge) == doctest::Approx(1));
    if (point == edge) continue;
    CHECK(left < 1);
    CHECK(leftOutside(grid, edge + 1.1f * (point - edge)) < left);
    const float far = leftOutside(grid, edge + 200.0f * (point - edge)),
                farther = leftOutside(grid, edge + 400.0f * (point - edge));
    CHECK(far == doctest::Approx(4 * farther).epsilon(0.05));
  }
}
