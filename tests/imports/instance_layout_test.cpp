#include "engine/imports/instance_layout.h"

#include <doctest/doctest.h>

#include <cstring>

using namespace weft;

namespace {

float at(const std::vector<std::byte>& bytes, std::size_t offset) {
  float value = 0;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

}  // namespace

TEST_CASE("instance tables follow the layout that introspection reports") {
  const auto field = [](const char* name, GLenum type, std::uint32_t offset) {
    return gl::BlockMember{.name = std::string("instance[0].") + name,
                           .type = type,
                           .offset = offset,
                           .topLevelArraySize = 0,
                           .topLevelArrayStride = 32};
  };
  gl::Block block{.name = "instances",
                  .storage = true,
                  .members = {field("center", GL_FLOAT_VEC3, 0), field("metallic", GL_FLOAT, 12),
                              field("albedo", GL_FLOAT_VEC3, 16)}};
  imports::InstanceLayout layout;
  std::string problem;
  REQUIRE(imports::instanceLayoutOf(block, layout, problem));
  const scene::Instance rows[2] = {{},
                                   {.center = {4, 5, 6}, .albedo = {0.1f, 0.2f, 0.3f}, .metallic = 0.75f}};
  std::vector<std::byte> bytes;
  imports::writeInstances(layout, rows, bytes);
  REQUIRE(bytes.size() == 64);
  CHECK(at(bytes, 32 + 8) == 6.0f);
  CHECK(at(bytes, 32 + 12) == 0.75f);
  CHECK(at(bytes, 32 + 24) == 0.3f);

  block.members.push_back(field("colour", GL_FLOAT_VEC3, 28));
  CHECK_FALSE(imports::instanceLayoutOf(block, layout, problem));
  CHECK(problem == "instances have no field 'colour'");
}
