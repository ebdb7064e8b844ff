#include "engine/imports/row_table.h"

#include <doctest/doctest.h>

#include <array>
#include <cstring>

#include "engine/gl/programs/program.h"

using namespace weft;

namespace {

struct Ball {
  glm::vec3 center{0};
  float radius = 1;
  glm::mat4 turned{1};
  glm::vec3 albedo{0};
  float metallic = 0;
};
const imports::Columns<Ball> kBall = {
    imports::column<Ball, &Ball::center>("center", ""), imports::column<Ball, &Ball::radius>("radius", ""),
    imports::column<Ball, &Ball::turned>("turned", ""), imports::column<Ball, &Ball::albedo>("albedo", ""),
    imports::column<Ball, [](const Ball& ball) { return ball.metallic / 2; }>("metallic", "")};
const std::vector<graph::TableColumn> kColumns = tell(kBall);

gl::BlockMember fieldOf(const char* name, GLenum type, std::uint32_t offset) {
  return {.name = std::string("instance[0].") + name,
          .type = type,
          .offset = offset,
          .topLevelArraySize = 0,
          .topLevelArrayStride = 32};
}

gl::Block blockOf(std::vector<gl::BlockMember> members) {
  return {.name = "instances", .storage = true, .members = std::move(members)};
}

float at(const std::vector<std::byte>& bytes, std::size_t offset) {
  float value = 0;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

}  // namespace

TEST_CASE("rows follow the layout that introspection reports, whatever the shader leaves out") {
  imports::RowLayout layout;
  std::string problem;
  REQUIRE(
      imports::rowLayoutOf(blockOf({fieldOf("center", GL_FLOAT_VEC3, 0), fieldOf("metallic", GL_FLOAT, 12),
                                    fieldOf("albedo", GL_FLOAT_VEC3, 16)}),
                           kColumns, layout, problem));
  CHECK(layout.stride == 32);
  CHECK(layout.offsets == std::vector<std::int32_t>{0, -1, -1, 16, 12});
  std::vector<std::byte> bytes;
  const std::array rows = {
      Ball{}, Ball{.center = {4, 5, 6}, .radius = 7, .albedo = {0.1f, 0.2f, 0.3f}, .metallic = 1.5f}};
  imports::writeRows(layout, kBall, std::span<const Ball>(rows), bytes);
  REQUIRE(bytes.size() == 64);
  CHECK(at(bytes, 32 + 8) == 6.0f);
  CHECK(at(bytes, 32 + 12) == 0.75f);
  CHECK(at(bytes, 32 + 24) == 0.3f);
  CHECK(at(bytes, 32 + 28) == 0.0f);
  CHECK(at(bytes, 0) == 0.0f);
}

TEST_CASE("the type of a column is that of its values") {
  std::vector<std::string> types;
  for (const graph::TableColumn& column : kColumns) types.push_back(column.type);
  CHECK(types == std::vector<std::string>{"vec3", "float", "mat4", "vec3", "float"});
}

TEST_CASE("a uniform block has the first row of a table, and no more") {
  gl::Block block{
      .name = "one", .bytes = 48, .members = {{.name = "rows[0].radius", .type = GL_FLOAT, .offset = 16}}};
  imports::RowLayout layout;
  std::string problem;
  REQUIRE(imports::rowLayoutOf(block, kColumns, layout, problem));
  CHECK(layout.stride == 48);
  CHECK(layout.offsets == std::vector<std::int32_t>{-1, 16, -1, -1, -1});
  block.members.push_back({.name = "rows[1].radius", .type = GL_FLOAT, .offset = 64});
  CHECK_FALSE(imports::rowLayoutOf(block, kColumns, layout, problem));
  CHECK(problem == "a uniform block holds one row of a table: declare [1]");
}

TEST_CASE("a table without rows has room for one, of zeros") {
  std::vector<std::byte> bytes(3, std::byte{1});
  imports::writeRows({.stride = 48, .offsets = {0, -1, -1, -1, -1}}, kBall, {}, bytes);
  CHECK(bytes == std::vector<std::byte>(48, std::byte{0}));
}

TEST_CASE("a field that the table lacks, another type, or no array of structs is a problem that names it") {
  const auto problemOf = [](const gl::Block& block) {
    imports::RowLayout layout;
    std::string problem;
    CHECK_FALSE(imports::rowLayoutOf(block, kColumns, layout, problem));
    return problem;
  };
  CHECK(problemOf(blockOf({fieldOf("albdeo", GL_FLOAT_VEC3, 0)})) ==
        "its rows have no field 'albdeo'; did you mean 'albedo'?");
  CHECK(problemOf(blockOf({fieldOf("center", GL_FLOAT_VEC4, 0)})) == "'center' is vec4, not vec3");
  gl::BlockMember turned = fieldOf("turned", GL_FLOAT_MAT4, 0);
  turned.rowMajor = true;
  CHECK(problemOf(blockOf({turned})) == "'turned' is row_major");
  gl::BlockMember plain{.name = "center", .type = GL_FLOAT_VEC3, .offset = 0};
  CHECK(problemOf(blockOf({plain})) == "'center' is no field of an array of structs");
  CHECK(problemOf(blockOf({})) == "the block is no array of structs");
}
