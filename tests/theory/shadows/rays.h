// What the tests of shadows share: rays around an axis, and what a frame makes of a scene with and without shadows.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "tests/theory/mesh_scene.h"
#include "tests/theory/shadows/triangles.h"

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
