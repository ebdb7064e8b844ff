// Collects the meshes of a model into its vertex and index arrays, and makes what a file left out: flat normals, tangents,
// the winding of mirrored nodes, four normalised weights. Vertices that are used with both handednesses of uv are split.
// Every mesh that goes in is whole: indices in range, numbers finite. Does not: read files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/assets/model.h"
#include "engine/base/diagnostic.h"

namespace weft::assets {

// One mesh before it is finished; arrays are parallel to positions, or empty where the file has none.
struct RawMesh {
  std::string name;
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::vec4> tangents;
  std::vector<glm::vec2> uvs;     // (0,0) top left
  std::vector<glm::vec4> colors;  // linear, 0 to 1
  std::vector<std::array<std::uint32_t, 8>> joints;
  std::vector<std::array<float, 8>> weights;
  std::vector<std::uint32_t> indices;  // triangles; below the number of positions
  bool join = false;                   // equal vertices become one: of formats without indices
};

class MeshBuilder {
 public:
  explicit MeshBuilder(Model& model) : model_(model) {}

  // Whether a model may have that many more vertices, and corners; else W201, once.
  bool hasRoom(std::uint64_t vertices, std::uint64_t corners, const base::Place& place,
               base::Diagnostics& diagnostics);
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
