// What two processes of one executable tell each other of models, as bytes: pass() writes a value with a Writer, and reads it with a
// Reader. Structured bindings, so that a member that is added does not compile until it is passed. Internal to the folder.
#pragma once

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "engine/assets/model.h"
#include "engine/text/diagnostic.h"

namespace weft::assets {

class Writer {
 public:
  static constexpr bool kReads = false;
  void bytes(void* from, std::size_t size) { made.append(static_cast<const char*>(from), size); }

  std::string made;
};

class Reader {
 public:
  static constexpr bool kReads = true;
  explicit Reader(std::string_view bytes) : rest_(bytes) {}
  void bytes(void* to, std::size_t size) {
    good = good && size <= rest_.size();
    if (!good || size == 0) return;
    std::memcpy(to, rest_.data(), size);
    rest_.remove_prefix(size);
  }
  std::size_t left() const { return rest_.size(); }

  bool good = true;  // not cut off

 private:
  std::string_view rest_;
};

template <class T>
concept Plain = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>;

template <class A, class T>
void pass(A& a, std::vector<T>& values);
template <class A, class T>
void pass(A& a, std::shared_ptr<const T>& shared);

template <class A, Plain T>
void pass(A& a, T& value) {
  a.bytes(&value, sizeof value);
}

// The size of a text or a list that follows.
template <class A, class T>
void passSize(A& a, T& values, std::size_t each) {
  std::uint64_t size = values.size();
  a.bytes(&size, sizeof size);
  if constexpr (A::kReads) {
    a.good = a.good && size <= a.left() / each;
    values.resize(a.good ? size : 0);
  }
}

template <class A>
void pass(A& a, std::string& text) {
  passSize(a, text, 1);
  a.bytes(text.data(), text.size());
}

template <class A>
void pass(A& a, Image8& image) {
  auto& [width, height, channels, texels] = image;
  pass(a, width), pass(a, height), pass(a, channels), pass(a, texels);
}

template <class A>
void pass(A& a, Texture& texture) {
  auto& [name, image, srgb, content] = texture;
  pass(a, name), pass(a, image), pass(a, srgb), pass(a, content);
}

template <class A>
void pass(A& a, Material& material) {
  auto& [name, albedo, metallic, roughness, emissive, alpha, alphaCutoff, blend, normalScale,
         occlusionStrength, blinnPhong, specular, shininess, doubleSided, unlit, albedoMap, normalMap,
         metallicRoughnessMap, occlusionMap, emissiveMap, samplers] = material;
  const auto each = [&](auto&... member) { (pass(a, member), ...); };
  each(name, albedo, metallic, roughness, emissive, alpha, alphaCutoff, blend, normalScale, occlusionStrength,
       blinnPhong, specular, shininess, doubleSided, unlit, albedoMap, normalMap, metallicRoughnessMap,
       occlusionMap, emissiveMap, samplers);
}

template <class A>
void pass(A& a, Mesh& mesh) {
  auto& [name, firstVertex, vertexCount, firstIndex, indexCount, bounds, skinned, jointBounds] = mesh;
  const auto each = [&](auto&... member) { (pass(a, member), ...); };
  each(name, firstVertex, vertexCount, firstIndex, indexCount, bounds, skinned, jointBounds);
}

template <class A>
void pass(A& a, ModelNode& node) {
  auto& [name, parent, local] = node;
  pass(a, name), pass(a, parent), pass(a, local);
}

template <class A>
void pass(A& a, ModelSkin& skin) {
  auto& [joints, inverseBind] = skin;
  pass(a, joints), pass(a, inverseBind);
}

template <class A>
void pass(A& a, ModelLight& light) {
  auto& [name, node, kind, color, intensity, range, inner, outer] = light;
  const auto each = [&](auto&... member) { (pass(a, member), ...); };
  each(name, node, kind, color, intensity, range, inner, outer);
}

template <class A>
void pass(A& a, ModelCamera& camera) {
  auto& [name, node, fovDegrees, height, nearPlane] = camera;
  pass(a, name), pass(a, node), pass(a, fovDegrees), pass(a, height), pass(a, nearPlane);
}

template <class A>
void pass(A& a, ModelTrack& track) {
  auto& [node, path, interpolation, times, values] = track;
  pass(a, node), pass(a, path), pass(a, interpolation), pass(a, times), pass(a, values);
}

template <class A>
void pass(A& a, ModelAnimation& animation) {
  auto& [name, duration, tracks] = animation;
  pass(a, name), pass(a, duration), pass(a, tracks);
}

template <class A>
void pass(A& a, Model& m) {
  const auto each = [&](auto&... member) { (pass(a, member), ...); };
  each(m.vertices, m.skin, m.colors, m.indices, m.name, m.textures, m.materials, m.meshes, m.nodes,
       m.instances, m.skins, m.lights, m.cameras, m.animations, m.files);
}
static_assert(sizeof(Model) ==
                  4 * sizeof(std::vector<int>) + sizeof(std::string) + 10 * sizeof(std::vector<int>),
              "pass what was added");

template <class A>
void pass(A& a, text::Diagnostic& diagnostic) {
  auto& [severity, code, message, place, pointer, name, resource, expected, found, hint] = diagnostic;
  std::string file = place.file ? *place.file : "";
  const auto each = [&](auto&... member) { (pass(a, member), ...); };
  each(severity, code, message, file, place.line, place.column, pointer, name, resource, expected, found,
       hint);
  if (A::kReads && !file.empty()) place.file = file;
}

template <class A, class T>
void pass(A& a, std::vector<T>& values) {
  passSize(a, values, Plain<T> ? sizeof(T) : 1);
  if constexpr (Plain<T>)
    a.bytes(values.data(), values.size() * sizeof(T));
  else
    for (T& value : values) pass(a, value);
}

template <class A, class T>
void pass(A& a, std::shared_ptr<const T>& shared) {
  bool there = shared != nullptr;
  pass(a, there);
  if (!there) return;
  const auto value = A::kReads ? std::make_shared<T>() : std::const_pointer_cast<T>(shared);
  pass(a, *value);
  shared = value;
}

}  // namespace weft::assets
