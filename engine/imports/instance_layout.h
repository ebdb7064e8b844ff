// Where a shader wants the fields of an instance: by introspection of the block that reads them, so that no struct is
// written twice.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/gl/programs/program.h"
#include "engine/scene/scene.h"

namespace weft::imports {

// The storage block that reads the rows of a draw pass's list without a slot.
constexpr const char* kInstancesBlock = "instances";

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

}  // namespace weft::imports
