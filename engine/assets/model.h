// A model as CPU data, whatever kind of file it came from: glTF 2.0 (.gltf, .glb), Wavefront OBJ, FBX. One vertex layout,
// triangles that are counter-clockwise seen from outside, uv with (0,0) at the top left of the image, tangents always there,
// nodes with parents before children, one mesh per material. Does not: know what a scene does with it, GL, or time.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/assets/images/image.h"

namespace weft::assets {

using Float2 = std::array<float, 2>;
using Float3 = std::array<float, 3>;
using Float4 = std::array<float, 4>;
using Matrix4 = std::array<float, 16>;  // column-major

constexpr std::uint32_t kNoRow = 0xffffffffu;

// A texture has one use: equal texels that are used as colour and as numbers are two textures.
struct ModelTexture {
  std::string name;                     // the file's, or what the model calls it
  std::shared_ptr<const Image8> image;  // 4 channels, row 0 on top
  bool srgb = false;                    // colour (base, emissive): to be decoded
  std::uint64_t content = 0;            // hash of size, texels and srgb; equal contents are one row
};

struct ModelMaterial {
  std::string name;
  Float3 baseColor{1, 1, 1};  // linear; factors of the maps
  float metallic = 0, roughness = 1;
  Float3 emissive{0, 0, 0};  // linear, scene-referred
  float alpha = 1;
  bool blend = false;
  float alphaCutoff = 0;  // over 0: mask
  float normalScale = 1, occlusionStrength = 1;
  bool blinnPhong = false;  // what the file has; metallic and roughness are a conversion then
  Float3 specular{0, 0, 0};
  float shininess = 0;
  bool doubleSided = false;
  // Rows of Model::textures, or kNoRow. Roughness is g, metallic b, occlusion r.
  std::uint32_t baseColorMap = kNoRow, normalMap = kNoRow, metallicRoughnessMap = kNoRow,
                occlusionMap = kNoRow, emissiveMap = kNoRow;
};

struct ModelVertex {
  Float3 position{}, normal{0, 0, 1};
  Float4 tangent{1, 0, 0, 1};  // w: the sign of the bitangent, cross(normal, tangent) * w
  Float2 uv{};
};

// Rows of the skin's joints, heaviest first; the weights add up to 1, or are all 0 where the mesh has no skin.
struct ModelSkinVertex {
  std::array<std::uint16_t, 4> joints{};
  Float4 weights{};
};

// A range of Model::vertices and ::indices; indices count from firstVertex.
struct ModelMesh {
  std::string name;
  std::uint32_t firstVertex = 0, vertexCount = 0, firstIndex = 0, indexCount = 0;
  bool skinned = false;
};

struct ModelNode {
  std::string name;
  std::uint32_t parent = kNoRow;  // an earlier row
  Float3 translation{0, 0, 0};
  Float4 rotation{0, 0, 0, 1};  // quaternion x y z w, unit
  Float3 scale{1, 1, 1};
};

struct ModelInstance {
  std::uint32_t node = 0, mesh = 0, material = 0;
  std::uint32_t skin = kNoRow;
};

enum class ModelLightKind : std::uint8_t { sun, point, spot };

// At the origin of a node; a sun and a spot shine along its -Z. How the node is scaled is of no account.
struct ModelLight {
  std::string name;
  std::uint32_t node = 0;
  ModelLightKind kind = ModelLightKind::point;
  Float3 color{1, 1, 1};       // linear; a factor per channel
  float intensity = 1;         // of a sun lux on what faces it, of the others candela
  float range = 0;             // beyond it there is no light; 0: endless
  float inner = 0, outer = 0;  // half angles of a spot's cones, radians
};

struct ModelSkin {
  std::vector<std::uint32_t> joints;  // nodes
  std::vector<Matrix4> inverseBind;   // parallel to joints
};

enum class TrackPath : std::uint8_t { translation, rotation, scale };
enum class TrackInterpolation : std::uint8_t { linear, step, cubic };

// One property of one node over time. Cubic (glTF's CUBICSPLINE) has three values a key: in-tangent, value, out-tangent.
struct ModelTrack {
  std::uint32_t node = 0;
  TrackPath path = TrackPath::translation;
  TrackInterpolation interpolation = TrackInterpolation::linear;
  std::vector<float> times;    // seconds, ascending
  std::vector<Float4> values;  // translation and scale leave w alone
};

struct ModelAnimation {
  std::string name;
  float duration = 0;  // seconds: the last key of any track
  std::vector<ModelTrack> tracks;
};

struct Model {
  std::string name;
  std::vector<ModelTexture> textures;
  std::vector<ModelMaterial> materials;  // at least one when there is an instance
  std::vector<ModelVertex> vertices;
  std::vector<ModelSkinVertex> skinVertices;  // parallel to vertices, or empty: no mesh is skinned
  // Parallel to vertices, or empty: all are white. Linear, 0 to 1; a factor of base colour and alpha.
  std::vector<Float4> colors;
  std::vector<std::uint32_t> indices;
  std::vector<ModelMesh> meshes;
  std::vector<ModelNode> nodes;
  std::vector<ModelInstance> instances;
  std::vector<ModelSkin> skins;
  std::vector<ModelLight> lights;  // at most one sun
  std::vector<std::shared_ptr<const ModelAnimation>> animations;
  std::vector<std::string> files;  // everything that was read or should have been, the model's own first
};

}  // namespace weft::assets
