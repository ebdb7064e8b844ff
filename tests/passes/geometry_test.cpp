#include "engine/passes/draw/geometry.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/glm.hpp>

using weft::passes::makeBox, weft::passes::makeIcosphere;

TEST_CASE("an icosphere has 20 * 4^n outward triangles, 10 * 4^n + 2 vertices, all on the unit sphere") {
  for (int n = 0; n <= 4; ++n) {
    const auto mesh = makeIcosphere(n);
    const std::size_t power = std::size_t{1} << (2 * n);
    CHECK(mesh.indices.size() == 60 * power);
    CHECK(mesh.positions.size() == 3 * (10 * power + 2));
    const auto vertex = [&](std::uint32_t i) {
      return glm::vec3(mesh.positions[3 * i], mesh.positions[3 * i + 1], mesh.positions[3 * i + 2]);
    };
    double volume = 0;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
      const glm::vec3 a = vertex(mesh.indices[t]), b = vertex(mesh.indices[t + 1]),
                      c = vertex(mesh.indices[t + 2]);
      CHECK(glm::dot(glm::cross(b - a, c - a), a + b + c) > 0);
      volume += static_cast<double>(glm::dot(a, glm::cross(b, c))) / 6;
    }
    for (std::uint32_t i = 0; i < mesh.positions.size() / 3; ++i)
      CHECK(glm::length(vertex(i)) == doctest::Approx(1).epsilon(1e-5));
    if (n == 4) CHECK(volume == doctest::Approx(4.18879).epsilon(0.01));
  }
}

TEST_CASE("a box has twelve outward triangles, each with the normal of its face, and fills -1 to 1") {
  const auto mesh = makeBox();
  REQUIRE(mesh.indices.size() == 36);
  const auto at = [](const std::vector<float>& from, std::uint32_t i) {
    return glm::vec3(from[3 * i], from[3 * i + 1], from[3 * i + 2]);
  };
  double volume = 0;
  for (std::size_t t = 0; t < 36; t += 3) {
    const glm::vec3 a = at(mesh.positions, mesh.indices[t]), b = at(mesh.positions, mesh.indices[t + 1]),
                    c = at(mesh.positions, mesh.indices[t + 2]), out = glm::cross(b - a, c - a);
    volume += static_cast<double>(glm::dot(a, glm::cross(b, c))) / 6;
    for (std::size_t v = t; v < t + 3; ++v)
      CHECK(glm::dot(glm::normalize(out), at(mesh.normals, mesh.indices[v])) == doctest::Approx(1));
  }
  CHECK(volume == doctest::Approx(8));
}
