// Values into uniform and storage blocks at the offsets that introspection reports: parameters, the View block, the
// instance table. Layouts are the shader's; nothing here repeats a struct.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/diagnostic.h"
#include "engine/gl/programs/program.h"
#include "engine/graph/language/value.h"
#include "engine/scene/camera.h"
#include "engine/scene/scene.h"

namespace weft::runtime {

// Whether a member can hold the value: scalars and vectors, converted from double; a number fills a scalar, a list of n a
// vector of n. Otherwise says what is expected.
bool memberTakes(const gl::BlockMember& member, const graph::Value& value, std::string& expected);
// memberTakes must hold. `block` starts at the block's first byte.
void writeValue(std::byte* block, const gl::BlockMember& member, const graph::Value& value);

// Names the View block may declare (docs/shaders.md).
std::vector<std::string> viewMemberNames();
bool isViewMember(std::string_view name);
// `viewport` replaces the camera's; passes that are not `always` see no time.
void writeView(std::byte* block, const gl::Block& layout, const scene::ViewData& view, glm::vec2 viewport,
               bool timeless);

// Byte offsets of the fields of scene/instances.glsl within one element of a storage block, -1 for a dropped field.
struct InstanceLayout {
  std::uint32_t stride = 0;
  std::int32_t center = -1, radius = -1, previousCenter = -1, roughness = -1, albedo = -1, metallic = -1;
  friend bool operator==(const InstanceLayout&, const InstanceLayout&) = default;
};
// False, with the problem, when the block is no array of a struct with these fields.
bool instanceLayoutOf(const gl::Block& block, InstanceLayout& layout, std::string& problem);
void writeInstances(const InstanceLayout& layout, std::span<const scene::Instance> instances,
                    std::vector<std::byte>& out);

}  // namespace weft::runtime
