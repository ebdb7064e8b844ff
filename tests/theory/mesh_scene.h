// Scenes of squares, balls of triangles and ray-traced spheres, and the radiance that a graph makes of one.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/runtime/stage.h"
#include "tests/theory/environments.h"

namespace weft::theory {

class MeshScene {
 public:
  // Seen from `eye` towards the origin.
  MeshScene(glm::dvec3 eye, double fovDegrees) {
    scene.cameras.add(
        {.name = "front",
         .pose = {.position = eye, .target = {0, 0, 0}, .fovDegrees = fovDegrees, .nearPlane = 0.1}});
  }

  // In the plane z = 0, with normals +Z; `half` of a side. Corners from the lower left, counter-clockwise.
  scene::MeshId addSquare(float half) {
    begin("square");
    for (const glm::vec2 corner : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
      addVertex(glm::vec3(corner * half, 0), {0, 0, 1});
    for (const std::uint32_t index : {0u, 1u, 2u, 0u, 2u, 3u}) data_->indices.push_back(index);
    return end();
  }

  // Around the origin; `half` of its sides. Flat faces, outwards.
  scene::MeshId addBox(glm::vec3 half) {
    begin("box");
    for (int axis = 0; axis < 3; ++axis)
      for (const float way : {-1.0f, 1.0f}) {
        const std::uint32_t first = static_cast<std::uint32_t>(data_->vertices.size()) - mesh_.firstVertex;
        glm::vec3 normal(0), u(0), v(0);
        normal[axis] = way;
        u[(axis + 1) % 3] = way;
        v[(axis + 2) % 3] = 1;
        for (const glm::vec2 corner : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
          addVertex((normal + u * corner.x + v * corner.y) * half, normal);
        for (const std::uint32_t index : {0u, 1u, 2u, 0u, 2u, 3u}) data_->indices.push_back(first + index);
      }
    return end();
  }

  // Of the unit sphere.
  scene::MeshId addBall() {
    begin("ball");
    constexpr float kPi = std::numbers::pi_v<float>;
    constexpr std::uint32_t kRings = 96, kColumns = 192;
    for (std::uint32_t ring = 0; ring <= kRings; ++ring)
      for (std::uint32_t column = 0; column <= kColumns; ++column) {
        const float up = kPi * static_cast<float>(ring) / kRings,
                    round = 2 * kPi * static_cast<float>(column) / kColumns;
        const glm::vec3 at(std::sin(up) * std::sin(round), std::cos(up), std::sin(up) * std::cos(round));
        addVertex(at, at);
        if (ring == kRings || column == kColumns) continue;
        const std::uint32_t a = ring * (kColumns + 1) + column, b = a + kColumns + 1;
        for (const std::uint32_t index : {a, b, a + 1, a + 1, b, b + 1}) data_->indices.push_back(index);
      }
    return end();
  }

  void put(scene::MeshId mesh, const scene::Material& material, glm::vec3 at,
           std::uint8_t lists = scene::maskOf(scene::DrawList::opaque)) {
    scene.meshInstances.add(
        {.node = scene.nodes.add({.name = "node", .parent = {}, .local = {.translation = at}}),
         .mesh = mesh,
         .material = scene.materials.add(material),
         .lists = lists});
  }
  void putSphere(glm::vec3 center, float radius, const scene::Material& material,
                 std::uint8_t lists = scene::maskOf(scene::DrawList::spheres)) {
    scene.spheres.add(
        {.center = center, .radius = radius, .material = scene.materials.add(material), .lists = lists});
  }

  // Of all vertices, one after another.
  void setColors(std::vector<glm::vec4> colors) { data_->colors = std::move(colors); }

  scene::Scene scene;

 private:
  void begin(const char* name) {
    if (!data_) scene.meshData = data_ = std::make_shared<scene::MeshData>();
    mesh_ = {.name = name,
             .firstVertex = static_cast<std::uint32_t>(data_->vertices.size()),
             .firstIndex = static_cast<std::uint32_t>(data_->indices.size())};
  }
  void addVertex(glm::vec3 position, glm::vec3 normal) {
    data_->vertices.push_back({.position = position, .normal = normal});
    mesh_.bounds.add(position);
  }
  scene::MeshId end() {
    mesh_.vertexCount = static_cast<std::uint32_t>(data_->vertices.size()) - mesh_.firstVertex;
    mesh_.indexCount = static_cast<std::uint32_t>(data_->indices.size()) - mesh_.firstIndex;
    return scene.meshes.add(mesh_);
  }

  std::shared_ptr<scene::MeshData> data_;
  scene::Mesh mesh_;
};

// What a graph is asked for: `width` x `height` pixels of `scene` under an environment of one radiance.
struct Shot {
  std::string graph;
  std::uint32_t width = 96, height = 64;
  double environment = 1;
  std::vector<graph::Setting> sets{};
  std::vector<graph::Disable> disables{};
};

struct Taken {
  std::vector<float> radiance, depth;
};

// One renderer of one graph, which keeps its programs from shot to shot.
class Camera {
 public:
  explicit Camera(const Shot& shot) : stage_(shot.graph, shot.width, shot.height) {}

  // Of the same graph and size.
  Taken take(const scene::Scene& scene, const Shot& shot) {
    stage_.world.setScene(scene);
    if (environment_ != shot.environment)
      stage_.world.setEnvironment(std::make_shared<const assets::EnvironmentMap>(assets::toEnvironmentMap(
          *constantEnvironment(shot.environment, shot.environment, shot.environment))));
    environment_ = shot.environment;
    stage_.settings.sets = shot.sets;
    stage_.settings.disables = shot.disables;
    REQUIRE_MESSAGE(stage_.apply(), stage_.diagnostics.text());
    stage_.run();
    return {stage_.read("hdr"), stage_.read("depth")};
  }

 private:
  runtime::test::Stage stage_;
  double environment_ = -1;  // none yet
};

inline Taken take(const scene::Scene& scene, const Shot& shot) {
  return Camera(shot).take(scene, shot);
}

}  // namespace weft::theory
