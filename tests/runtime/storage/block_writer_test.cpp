#include "engine/runtime/storage/block_writer.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

using namespace weft;
using graph::Value;

namespace {

template <class T>
T at(const std::vector<std::byte>& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

}  // namespace

TEST_CASE("values are converted at the destination") {
  std::vector<std::byte> block(64, std::byte{0});
  runtime::writeValue(block.data(), {.name = "f", .type = GL_FLOAT, .offset = 0}, Value::number(1.5));
  runtime::writeValue(block.data(), {.name = "i", .type = GL_INT, .offset = 4}, Value::number(-3));
  runtime::writeValue(block.data(), {.name = "b", .type = GL_BOOL, .offset = 8}, Value::boolean(true));
  runtime::writeValue(block.data(), {.name = "v", .type = GL_FLOAT_VEC3, .offset = 16},
                      {Value::Type::list, 3, {1, 2, 3, 0}, {}});
  CHECK(at<float>(block, 0) == 1.5f);
  CHECK(at<std::int32_t>(block, 4) == -3);
  CHECK(at<std::uint32_t>(block, 8) == 1u);
  CHECK(at<float>(block, 24) == 3.0f);
}

TEST_CASE("a number beyond a whole type becomes its nearest value") {
  std::vector<std::byte> block(16, std::byte{0});
  const auto write = [&](GLenum type, double x) {
    runtime::writeValue(block.data(), {.name = "i", .type = type, .offset = 0}, Value::number(x));
  };
  write(GL_INT, 1e30);
  CHECK(at<std::int32_t>(block, 0) == 2147483647);
  write(GL_INT, -1e30);
  CHECK(at<std::int32_t>(block, 0) == -2147483647 - 1);
  write(GL_INT, std::nan(""));
  CHECK(at<std::int32_t>(block, 0) == 0);
  write(GL_UNSIGNED_INT, 1e30);
  CHECK(at<std::uint32_t>(block, 0) == 4294967295u);
  write(GL_UNSIGNED_INT, -1);
  CHECK(at<std::uint32_t>(block, 0) == 0u);
}

TEST_CASE("a member says what it expects of a value that does not fit") {
  std::string expected;
  CHECK(runtime::memberTakes({.name = "f", .type = GL_FLOAT}, Value::number(1), expected));
  CHECK_FALSE(runtime::memberTakes({.name = "f", .type = GL_FLOAT}, {Value::Type::list, 3, {1, 2, 3, 0}, {}},
                                   expected));
  CHECK(expected == "a number, for float");
  CHECK_FALSE(runtime::memberTakes({.name = "v", .type = GL_FLOAT_VEC2}, Value::number(1), expected));
  CHECK(expected == "a list of 2 numbers, for vec2");
  CHECK_FALSE(runtime::memberTakes({.name = "f", .type = GL_FLOAT}, Value::text("high"), expected));
}

TEST_CASE("the View block is written by name; passes that are not always see no time") {
  gl::Block block{.name = "View",
                  .members = {{.name = "viewport", .type = GL_FLOAT_VEC2, .offset = 0},
                              {.name = "time", .type = GL_FLOAT, .offset = 8},
                              {.name = "view", .type = GL_FLOAT_MAT4, .offset = 16, .matrixStride = 16}}};
  scene::ViewData view;
  view.time = 7;
  view.view[3] = {1, 2, 3, 1};
  std::vector<std::byte> bytes(80, std::byte{0});
  runtime::writeView(bytes.data(), block, view, {320, 200}, false);
  CHECK(at<float>(bytes, 4) == 200.0f);
  CHECK(at<float>(bytes, 8) == 7.0f);
  CHECK(at<float>(bytes, 16 + 3 * 16 + 8) == 3.0f);
  runtime::writeView(bytes.data(), block, view, {320, 200}, true);
  CHECK(at<float>(bytes, 8) == 0.0f);
}
