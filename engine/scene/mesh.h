// Meshes: what their vertices are, and the rows of Scene::meshes, which are ranges of one vertex and one index array.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "engine/scene/box.h"
#include "engine/scene/table.h"

namespace weft::scene {

struct Vertex {
  glm::vec3 position{0}, normal{0, 0, 1};
  glm::vec4 tangent{1, 0, 0, 1};  // w is the sign of the bitangent: cross(normal, tangent) * w
  glm::vec2 uv{0};                // (0,0) is the top left of the image
};
static_assert(sizeof(Vertex) == 48);

struct SkinVertex {
  std::array<std::uint16_t, 4> joints{};  // rows of the instance's skin
  std::array<float, 4> weights{};         // add up to 1, or are all 0: not skinned
};
static_assert(sizeof(SkinVertex) == 24);

// Triangles, counter-clockwise seen from outside. Does not change once it stands in a scene.
struct MeshData {
  std::vector<Vertex> vertices;
  std::vector<SkinVertex> skin;  // parallel to vertices, or empty: no mesh is skinned
  // Parallel to vertices, or empty: all are white. Linear; a factor of the material's albedo and alpha.
  std::vector<glm::vec4> colors;
  std::vector<std::uint32_t> indices;
};

struct Mesh {
  std::string name;
  std::uint32_t firstVertex = 0, vertexCount = 0;
  std::uint32_t firstIndex = 0, indexCount = 0;  // indices count from firstVertex
  Box bounds;                                    // of the vertices as they are in the file
  bool skinned = false;
  // Per row of the skin, the box of the vertices that this joint moves. A skinned vertex is a mean of what its joints make of
  // it, so it lies in the box of these boxes, each moved by its joint. Empty unless skinned.
  std::vector<Box> jointBounds{};
};
using MeshId = Table<Mesh>::Id;

}  // namespace weft::scene
