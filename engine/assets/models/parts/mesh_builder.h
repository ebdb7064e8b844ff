// Collects the meshes of a model into its vertex and index arrays, and makes what a file left out: flat normals, tangents,
// the winding of mirrored nodes, four normalized weights. Vertices that are used with both handednesses of uv are split.
// Every mesh that goes in is whole: indices in range, numbers finite.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/assets/model.h"
#include "engine/text/diagnostic.h"

namespace weft::assets {

constexpr float kFarthest = 1e9f;  // that a position may be, as of everything in a scene

// A quaternion x y z w. False for one without length.
bool normalizeRotation(glm::vec4& q);
inline glm::quat toRotation(const glm::vec4& q) {
  return {q.w, q.x, q.y, q.z};
}

// One mesh before it is finished. Tangents that are no unit vectors are to be made.
struct RawMesh : MeshData {
  std::string name;
  std::vector<std::vector<MorphTarget>> morphs;  // each parallel to vertices
  bool normals = false;                          // what the file has
  bool tangentsAtSecondUv = false;               // they follow it
  bool join = false;                             // equal vertices become one: of formats without indices
};

// Of a Blinn–Phong material, from its albedo, its map, specular and shininess: what passes see of it that shade otherwise.
void toMetallicRoughness(Material& material);

// A vertex that more than four joints move: by the heaviest four, adding up to 1.
SkinVertex heaviest(const std::array<std::uint32_t, 8>& joints, const std::array<float, 8>& weights);

class MeshBuilder {
 public:
  explicit MeshBuilder(Model& model) : model_(model) {}

  // Whether a model may have that many more vertices, and corners; else W201, once.
  bool hasRoom(std::uint64_t vertices, std::uint64_t corners, const text::Place& place,
               text::Diagnostics& diagnostics);
  // The row of Model::meshes.
  std::uint32_t add(RawMesh mesh);

 private:
  Model& model_;
  std::uint64_t vertices_ = 0, corners_ = 0;
  bool full_ = false;
};

// Turns the triangles of instances round whose node mirrors, in a copy of the mesh that shares its vertices.
void windMirrored(Model& model);

}  // namespace weft::assets
