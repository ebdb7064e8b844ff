// What the tests of shadows share: rays to every triangle of a scene, and what a frame makes of it with and without shadows.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "tests/theory/mesh_scene.h"

namespace weft::theory {

constexpr std::uint32_t kWide = 128, kHigh = 96;
constexpr double kTurn = 6.28318530717959;

enum Kind { kGround, kMesh, kSphere };
// A graph, and what it shows of the scene.
struct Frame {
  std::string graph;
  std::vector<Kind> shown;
  std::vector<graph::Setting> sets{};
};

struct Hit {
  double distance = 1e30;
  glm::dvec3 normal{0};
};

// The nearest triangle, by Cramer's rule for its two edges and the ray.
inline Hit meetTriangles(const scene::Scene& scene, glm::dvec3 from, glm::dvec3 way) {
  Hit hit;
  for (const scene::MeshInstance& instance : scene.meshInstances.rows()) {
    const scene::Mesh& mesh = *scene.meshes.find(instance.mesh);
    const glm::dvec3 moved(scene.nodes.find(instance.node)->local.translation);
    const auto corner = [&](std::uint32_t i) {
      return moved +
             glm::dvec3(
                 scene.meshData->vertices[mesh.firstVertex + scene.meshData->indices[mesh.firstIndex + i]]
                     .position);
    };
    for (std::uint32_t i = 0; i < mesh.indexCount; i += 3) {
      const glm::dvec3 a = corner(i), one = corner(i + 1) - a, two = corner(i + 2) - a;
      const glm::dmat3 sides(one, two, -way);
      if (std::abs(glm::determinant(sides)) < 1e-12) continue;
      const glm::dvec3 met = glm::inverse(sides) * (from - a);
      if (met.x < 0 || met.y < 0 || met.x + met.y > 1 || met.z <= 0 || met.z >= hit.distance) continue;
      hit = {met.z, glm::normalize(glm::cross(one, two))};
    }
  }
  return hit;
}

inline glm::dvec3 inCone(glm::dvec3 axis, double angle, std::mt19937& random) {
  std::uniform_real_distribution<double> share(0, 1);
  const double cosine = 1 - share(random) * (1 - std::cos(angle)), turn = kTurn * share(random);
  const glm::dvec3 side = glm::normalize(glm::cross(axis, {0.3, 0.1, 1})), up = glm::cross(axis, side);
  return axis * cosine + (side * std::cos(turn) + up * std::sin(turn)) * std::sqrt(1 - cosine * cosine);
}

inline std::vector<float> radianceOf(const Frame& frame, const scene::Scene& scene, bool shadows,
                                     const std::shared_ptr<const assets::ImageF>& environment) {
  runtime::test::Stage stage(frame.graph, kWide, kHigh);
  stage.world.setScene(scene);
  stage.world.setEnvironment(
      std::make_shared<const assets::EnvironmentMap>(assets::toEnvironmentMap(*environment)));
  stage.settings.sets = frame.sets;
  stage.settings.sets.push_back({"mesh_shadows", shadows ? "true" : "false"});
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run();
  return stage.read("hdr");
}

}  // namespace weft::theory
