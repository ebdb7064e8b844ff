#include "engine/imports/instance_layout.h"

#include <fmt/format.h>

#include <cstring>

namespace weft::imports {

bool instanceLayoutOf(const gl::Block& block, InstanceLayout& layout, std::string& problem) {
  for (const gl::BlockMember& member : block.members) {
    const std::size_t dot = member.name.rfind('.');
    const std::string_view field =
        dot == std::string::npos ? member.name : std::string_view(member.name).substr(dot + 1);
    const auto offset = static_cast<std::int32_t>(member.offset);
    const auto take = [&](std::int32_t& slot, GLenum type) {
      if (member.type != type)
        problem =
            fmt::format("'{}' is {}, not {}", field, gl::glslTypeName(member.type), gl::glslTypeName(type));
      slot = offset;
    };
    if (dot == std::string::npos || member.topLevelArrayStride == 0) {
      problem = fmt::format("'{}' is no field of an array of structs", member.name);
      return false;
    }
    layout.stride = member.topLevelArrayStride;
    if (field == "center")
      take(layout.center, GL_FLOAT_VEC3);
    else if (field == "radius")
      take(layout.radius, GL_FLOAT);
    else if (field == "previous_center")
      take(layout.previousCenter, GL_FLOAT_VEC3);
    else if (field == "roughness")
      take(layout.roughness, GL_FLOAT);
    else if (field == "albedo")
      take(layout.albedo, GL_FLOAT_VEC3);
    else if (field == "metallic")
      take(layout.metallic, GL_FLOAT);
    else
      problem = fmt::format("instances have no field '{}'", field);
  }
  if (layout.stride == 0 && problem.empty()) problem = "the block is no array of structs";
  return problem.empty();
}

void writeInstances(const InstanceLayout& layout, std::span<const scene::Instance> instances,
                    std::vector<std::byte>& out) {
  out.assign(instances.size() * layout.stride, std::byte{0});
  std::byte* row = out.data();
  for (const scene::Instance& instance : instances) {
    const auto put = [&](std::int32_t offset, const auto& value) {
      if (offset >= 0) std::memcpy(row + offset, &value, sizeof value);
    };
    put(layout.center, instance.center);
    put(layout.radius, instance.radius);
    put(layout.previousCenter, instance.previous_center);
    put(layout.roughness, instance.roughness);
    put(layout.albedo, instance.albedo);
    put(layout.metallic, instance.metallic);
    row += layout.stride;
  }
}

}  // namespace weft::imports
