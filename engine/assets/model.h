// A model as CPU data, whatever kind of file it came from: glTF 2.0 (.gltf, .glb), Wavefront OBJ, FBX. One vertex layout,
// triangles that are counter-clockwise seen from outside, uv with (0,0) at the top left of the image, tangents always there,
// nodes with parents before children, one mesh per material.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/assets/images/image.h"

namespace weft::assets {

// Aligned with the axes.
struct Box {
  glm::vec3 low{std::numeric_limits<float>::infinity()}, high{-std::numeric_limits<float>::infinity()};

  bool empty() const { return !(low.x <= high.x && low.y <= high.y && low.z <= high.z); }
  glm::vec3 center() const { return (low + high) * 0.5f; }
  void add(glm::vec3 point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  void add(const Box& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
  friend bool operator==(const Box&, const Box&) = default;
};

// The box of what is in `box`, moved by an affine `transform`; the empty box stays empty. Arvo, "Transforming Axis-Aligned
// Bounding Boxes", Graphics Gems, 1990.
inline Box transformBox(const glm::mat4& transform, const Box& box) {
  if (box.empty()) return {};
  Box out{glm::vec3(transform[3]), glm::vec3(transform[3])};
  for (int column = 0; column < 3; ++column) {
    const glm::vec3 a = glm::vec3(transform[column]) * box.low[column];
    const glm::vec3 b = glm::vec3(transform[column]) * box.high[column];
    out.low += glm::min(a, b);
    out.high += glm::max(a, b);
  }
  return out;
}

constexpr std::uint32_t kNoRow = 0xffffffffu;

// A texture has one use: equal texels that are used as color and as numbers are two textures.
struct Texture {
  std::string name;                     // the file's, or what the model calls it
  std::shared_ptr<const Image8> image;  // 4 channels, row 0 on top
  bool srgb = false;                    // color (albedo, emissive): to be decoded
  std::uint64_t content = 0;            // hash of size, texels and srgb; equal contents are one row
  bool clear = false;                   // a color whose alpha is below 1 somewhere
};

// How a texture is looked up, in bits: wrap of u, of v, whether texels are seen as they are where they are magnified, and where.
enum MapSampler : std::uint8_t {
  repeat = 0,
  clampU = 1,
  mirrorU = 2,
  clampV = 4,
  mirrorV = 8,
  nearest = 16,
  atSecondUv = 32
};

// What glTF's extensions say of a material: its dielectric reflection, a coat, a sheen, brushed grooves, a film. By default nothing.
struct MaterialLayers {
  glm::vec3 specularColor{1};
  float specular = 1, ior = 1.5f;  // of the dielectric; the factor counts at grazing angles, too
  float coat = 0, coatRoughness = 0, coatNormalScale = 1;
  glm::vec3 sheen{0};
  float sheenRoughness = 0;
  float anisotropy = 0, anisotropyTurn = 0;                      // radians from the tangent
  bool layered = false;                                          // it is something
  float film = 0, filmIor = 1.3f, filmMin = 100, filmMax = 400;  // nm
  float transmission = 0;   // share of the diffuse light that goes through instead
  float thickness = 0;      // of what is below the surface, in units of the mesh; 0: a thin wall
  glm::vec3 absorption{0};  // of it, per unit of the world: e^-absorption is left
  std::uint32_t specularMap = kNoRow, specularColorMap = kNoRow, coatMap = kNoRow, coatRoughnessMap = kNoRow,
                coatNormalMap = kNoRow, sheenMap = kNoRow, sheenRoughnessMap = kNoRow, anisotropyMap = kNoRow,
                filmMap = kNoRow, filmThicknessMap = kNoRow, transmissionMap = kNoRow, thicknessMap = kNoRow;
  friend bool operator==(const MaterialLayers&, const MaterialLayers&) = default;
};

constexpr std::size_t kMaterialMaps = 17;

struct Material {
  std::string name;
  glm::vec3 albedo{0.5f};  // linear; F0 of a metal. Like all numbers here a factor of its map, if any
  float metallic = 0;
  float roughness = 0.5f;  // perceptual
  glm::vec3 emissive{0};   // linear, scene-referred
  float alpha = 1;         // below 1 only where the material blends: such an instance is transparent
  float alphaCutoff = 0;   // over 0: texels whose alpha is below it are holes
  bool blend = false;      // alpha of factor and map is coverage
  float normalScale = 1, occlusionStrength = 1;
  // Where the file has these (OBJ, FBX). Metallic and roughness are then a conversion: docs/scenes.md.
  bool blinnPhong = false;
  glm::vec3 specular{0};
  float shininess = 0;
  bool doubleSided = false;
  bool unlit = false;  // shows `emissive` and its map alone; all else is black
  // Rows of the textures of the model, or of the scene, or kNoRow. Channels as in glTF: roughness g, metallic b, occlusion r.
  std::uint32_t albedoMap = kNoRow, normalMap = kNoRow, metallicRoughnessMap = kNoRow, occlusionMap = kNoRow,
                emissiveMap = kNoRow;
  MaterialLayers layers{};

  std::array<std::uint8_t, kMaterialMaps> samplers{};  // MapSampler, in the order of maps()

  std::array<std::uint32_t*, kMaterialMaps> maps() {
    MaterialLayers& on = layers;
    return {&albedoMap,           &normalMap,        &metallicRoughnessMap, &occlusionMap,
            &emissiveMap,         &on.specularMap,   &on.specularColorMap,  &on.coatMap,
            &on.coatRoughnessMap, &on.coatNormalMap, &on.sheenMap,          &on.sheenRoughnessMap,
            &on.anisotropyMap,    &on.filmMap,       &on.filmThicknessMap,  &on.transmissionMap,
            &on.thicknessMap};
  }
};

struct Vertex {
  glm::vec3 position{0}, normal{0, 0, 1};
  glm::vec4 tangent{1, 0, 0, 1};  // w is the sign of the bitangent: cross(normal, tangent) * w
  glm::vec2 uv{0};                // (0,0) is the top left of the image
};
static_assert(sizeof(Vertex) == 48);

struct SkinVertex {
  std::array<std::uint16_t, 4> joints{};  // rows of the skin's joints, heaviest first
  std::array<float, 4> weights{};         // add up to 1, or are all 0: not skinned
};
static_assert(sizeof(SkinVertex) == 24);

// What a weight of 1 of a morph target adds to a vertex.
struct MorphTarget {
  glm::vec3 position{0}, normal{0}, tangent{0};
};

// Triangles, counter-clockwise seen from outside.
struct MeshData {
  std::vector<Vertex> vertices;
  std::vector<SkinVertex> skin;  // parallel to vertices, or empty: no mesh is skinned
  // Parallel to vertices, or empty: all are white. Linear; a factor of the material's albedo and alpha.
  std::vector<glm::vec4> colors;
  std::vector<glm::vec2> secondUvs;  // parallel to vertices, or empty: no material asks for them
  std::vector<MorphTarget> targets;  // of meshes whose weights move, see Mesh::firstTarget
  std::vector<std::uint32_t> indices;
};

// Adds what `more` has. What was empty and is taken is moved, so that large meshes are held once.
inline void moveInto(MeshData& all, MeshData&& more) {
  const std::size_t before = all.vertices.size(), count = before + more.vertices.size();
  const auto add = [](auto& to, auto from) {
    if (to.empty()) std::swap(to, from);
    to.insert(to.end(), from.begin(), from.end());
  };
  const auto addIfAny = [&](auto& to, auto& from, const auto& otherwise) {
    if (to.empty() && from.empty()) return;
    to.resize(before, otherwise);
    add(to, std::move(from));
    to.resize(count, otherwise);
  };
  add(all.vertices, std::move(more.vertices));
  addIfAny(all.skin, more.skin, SkinVertex{});
  addIfAny(all.colors, more.colors, glm::vec4(1));
  addIfAny(all.secondUvs, more.secondUvs, glm::vec2(0));
  add(all.targets, std::move(more.targets));
  add(all.indices, std::move(more.indices));
}

// A range of MeshData.
struct Mesh {
  std::string name;
  std::uint32_t firstVertex = 0, vertexCount = 0;
  std::uint32_t firstIndex = 0, indexCount = 0;  // indices count from firstVertex
  Box bounds{};                                  // of the vertices as they are in the file
  bool skinned = false;
  bool clear = false;  // the alpha of a vertex color is below 1
  // Per row of the skin, the box of the vertices that this joint moves. A skinned vertex is a mean of what its joints make of
  // it, so it lies in the box of these boxes, each moved by its joint. Empty unless skinned.
  std::vector<Box> jointBounds{};
  // Targets of vertex v begin at firstTarget + v * targetBounds.size(). The box of what each adds to the positions.
  std::uint32_t firstTarget = 0;
  std::vector<Box> targetBounds{};
};

struct Transform {
  glm::vec3 translation{0};
  glm::quat rotation{1, 0, 0, 0};  // unit
  glm::vec3 scale{1};
  friend bool operator==(const Transform&, const Transform&) = default;
};

struct ModelNode {
  std::string name;
  std::uint32_t parent = kNoRow;  // an earlier row
  Transform local{};
  glm::mat3 inner{1};            // before it: what a matrix of the file does, which may shear
  bool animated = false;         // by any animation
  std::vector<float> weights{};  // of its mesh's targets, where an animation moves them
};

struct ModelInstance {
  std::uint32_t node = 0, mesh = 0, material = 0;
  std::uint32_t skin = kNoRow;
};

enum class ModelLightKind : std::uint8_t { sun, point, spot };

// At the origin of a node; a sun and a spot shine along its -Z. The scale of the node is ignored.
struct ModelLight {
  std::string name;
  std::uint32_t node = 0;
  ModelLightKind kind = ModelLightKind::point;
  glm::vec3 color{1};          // linear; a factor per channel
  float intensity = 1;         // of a sun lux on what faces it, of the others candela
  float range = 0;             // beyond it there is no light; 0: endless
  float inner = 0, outer = 0;  // half angles of a spot's cones, radians
};

// At the origin of a node, looking along its -Z, with its +Y up.
struct ModelCamera {
  std::string name;
  std::uint32_t node = 0;
  double fovDegrees = 0;  // vertical; 0: orthographic
  double height = 0;      // units, of an orthographic one
  double nearPlane = 0.1;
};

struct ModelSkin {
  std::vector<std::uint32_t> joints;   // nodes
  std::vector<glm::mat4> inverseBind;  // parallel to joints: from the mesh to the joint
};

enum class TrackPath : std::uint8_t { translation, rotation, scale, weights };
enum class TrackInterpolation : std::uint8_t { linear, step, cubic };

// One property of one node over time. Cubic (glTF's CUBICSPLINE) has three values a key: in-tangent, value, out-tangent.
struct ModelTrack {
  std::uint32_t node = 0;
  TrackPath path = TrackPath::translation;
  std::uint32_t target = 0;  // of weights: a track for each
  TrackInterpolation interpolation = TrackInterpolation::linear;
  std::vector<float> times;       // seconds, ascending
  std::vector<glm::vec4> values;  // a rotation is a quaternion x y z w; a weight x; the others leave w alone
};

struct ModelAnimation {
  std::string name;
  float duration = 0;  // seconds: the last key of any track
  std::vector<ModelTrack> tracks;
};

struct Model : MeshData {
  std::string name;
  std::vector<Texture> textures;
  std::vector<Material> materials;  // at least one when there is an instance
  std::vector<Mesh> meshes;
  std::vector<ModelNode> nodes;
  std::vector<ModelInstance> instances;
  std::vector<ModelSkin> skins;
  std::vector<ModelLight> lights;  // at most one sun
  std::vector<ModelCamera> cameras;
  std::vector<std::shared_ptr<const ModelAnimation>> animations;
  std::vector<std::string> files;  // everything that was read or should have been, the model's own first
};

}  // namespace weft::assets
