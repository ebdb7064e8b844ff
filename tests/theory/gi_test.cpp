// Light probes on the CPU against integrals written from the definitions: projection and irradiance of a known function, the
// cap of a sphere by counting rays that meet it, one bounce between two spheres by brute force.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <random>
#include <tuple>
#include <vector>

#include "engine/scene/probes/probes.h"

using namespace weft::scene;

namespace {

constexpr double kPiD = 3.14159265358979323846;

// The integral of f over the directions within `cosine` of `axis` (-1: all of them), three Gauss points
// in each step of the cosine.
template <class F>
auto integrate(glm::dvec3 axis, double cosine, int steps, const F& f) {
  const glm::dvec3 side =
      glm::normalize(std::abs(axis.x) < 0.7 ? glm::cross(axis, {1, 0, 0}) : glm::cross(axis, {0, 1, 0}));
  const glm::dvec3 up = glm::cross(axis, side);
  decltype(f(axis)) sum{};
  for (int i = 0; i < steps; ++i)
    for (int gauss = -1; gauss <= 1; ++gauss)
      for (int j = 0; j < 2 * steps; ++j) {
        const double c = cosine + (1 - cosine) * (i + 0.5 + gauss * std::sqrt(0.15)) / steps;
        const double s = std::sqrt(1 - c * c), phi = kPiD * (j + 0.5) / steps;
        sum += f(axis * c + side * (s * std::cos(phi)) + up * (s * std::sin(phi))) *
               (gauss == 0 ? 8.0 / 18 : 5.0 / 18);
      }
  return sum * ((1 - cosine) * kPiD / (double(steps) * steps));
}

std::vector<glm::dvec3> directions(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<glm::dvec3> all;
  for (int i = 0; i < count; ++i)
    all.push_back(glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))));
  return all;
}

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

constexpr int bandOf(std::size_t i) {
  return i == 0 ? 0 : i < 4 ? 1 : 2;
}

const ProbeRules kBare{.near = 1.05f, .far = 1e5f};  // no window where anybody looks

bool meets(glm::dvec3 from, glm::dvec3 direction, glm::dvec3 center, double radius) {
  const double along = glm::dot(center - from, direction);
  return along > 0 && glm::length(from + direction * along - center) < radius;
}

Instance ball(glm::vec3 center, float radius, glm::vec3 albedo = glm::vec3(1), float metallic = 0) {
  return {.center = center, .radius = radius, .albedo = albedo, .metallic = metallic};
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

std::vector<Probe> computed(const ProbeGrid& grid, const ProbeRules& rules,
                            const std::vector<Instance>& spheres) {
  std::vector<Probe> probes(grid.size());
  REQUIRE(computeProbes(grid, rules, spheres, probes));
  return probes;
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
  for (std::size_t i = 0; i < kShCount; ++i) probe.sh[i] *= kCosineLobe[bandOf(i)];
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
          if (bandOf(n) != band) continue;
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
    const std::vector<Probe> probes = computed(grid, rules, spheres);
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
              expected.sh[n] += glm::vec4(bands[bandOf(n)] * y[n] * sphere.albedo * (1 - sphere.metallic), 0);
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
  for (const Probe& probe : computed(placeProbes(metals, {5, 5, 5}), {}, metals))
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
  for (const Probe& probe : computed(none, {}, {})) CHECK(irradianceOf(probe, {0, 1, 0}) == glm::vec3(0));
}

TEST_CASE("gi: between probes their mix is linear, and outside the box it stays") {
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
    const float expected = plane(glm::clamp(point, grid.low, grid.high));
    CHECK(probe.sh[0].x == doctest::Approx(expected).epsilon(1e-4).scale(10));
    CHECK(probe.sh[8].x == doctest::Approx(9 * expected).epsilon(1e-4).scale(90));
  }
}

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
  const std::vector<Probe> probes = computed(grid, rules, spheres);
  for (const glm::vec3& point :
       {glm::vec3(0, 0, 0), glm::vec3(0.31f, 0.9f, -0.5f), glm::vec3(-0.73f, -0.6f, 1.2f),
        glm::vec3(0.11f, 1.7f, 0.4f), glm::vec3(2.4f, 1.6f, 0.1f), glm::vec3(-1.1f, 0.2f, 0.9f)}) {
    const ProbeGrid one{.low = point, .high = point, .count = {1, 1, 1}};
    const Probe exact = computed(one, rules, spheres)[0];
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
  const std::vector<Probe> probes = computed(grid, {}, spheres);
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

TEST_CASE(
    "gi: the environment where the light comes from: right for light from one side and for a linear one, "
    "near for others") {
  // A probe far from one sphere: its light comes from one direction.
  const std::vector<Instance> one = {ball({0, 0, 0}, 1)};
  const auto probeOf = [](const std::vector<Instance>& spheres, glm::vec3 point) {
    return computed({.low = point, .high = point, .count = {1, 1, 1}}, kBare, spheres)[0];
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

TEST_CASE("gi: computing stops where it is told to") {
  const std::vector<Instance> spheres = cloud(10, 7);
  const ProbeGrid grid = placeProbes(spheres, {4, 4, 4});
  std::vector<Probe> probes(grid.size());
  std::atomic<bool> cancelled = true;
  CHECK_FALSE(computeProbes(grid, {}, spheres, probes, &cancelled));
  cancelled = false;
  CHECK(computeProbes(grid, {}, spheres, probes, &cancelled));
}
