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

Value listOf(std::initializer_list<double> items) {
  Value value{Value::Type::list, 0, {}, {}};
  for (const double item : items) value.v[value.count++] = item;
  return value;
}

}  // namespace

TEST_CASE("values are converted at the destination") {
  std::vector<std::byte> block(64, std::byte{0});
  const auto write = [&](const gl::BlockMember& member, const Value& value) {
    const auto field = runtime::fieldFor(member, {.value = value});
    REQUIRE(field);
    return runtime::writeValue(block.data(), *field, value);
  };
  CHECK(write({.name = "f", .type = GL_FLOAT, .offset = 0}, Value::number(1.5)));
  CHECK_FALSE(write({.name = "f", .type = GL_FLOAT, .offset = 0}, Value::number(1.5)));
  write({.name = "i", .type = GL_INT, .offset = 4}, Value::number(-3));
  write({.name = "b", .type = GL_BOOL, .offset = 8}, Value::boolean(true));
  write({.name = "v", .type = GL_FLOAT_VEC3, .offset = 16}, listOf({1, 2, 3}));
  CHECK(at<float>(block, 0) == 1.5f);
  CHECK(at<std::int32_t>(block, 4) == -3);
  CHECK(at<std::uint32_t>(block, 8) == 1u);
  CHECK(at<float>(block, 24) == 3.0f);
}

TEST_CASE("a number beyond a whole type becomes its nearest value") {
  std::vector<std::byte> block(16, std::byte{0});
  const auto write = [&](GLenum base, double x) {
    runtime::writeValue(block.data(), {.base = base}, Value::number(x));
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

TEST_CASE("a member takes values of its own shape, and says which") {
  const auto takes = [](const gl::BlockMember& member, const Value& value,
                        std::uint32_t element = graph::kNone, std::uint32_t elements = 0) {
    return runtime::fieldFor(member, {.element = element, .elements = elements, .value = value}).has_value();
  };
  const gl::BlockMember number{.name = "f", .type = GL_FLOAT}, vector{.name = "v", .type = GL_FLOAT_VEC2};
  CHECK(takes(number, Value::number(1)));
  CHECK_FALSE(takes(number, listOf({1, 2, 3})));
  CHECK(runtime::expectedFor(number) == "a number, for float");
  CHECK_FALSE(takes(vector, Value::number(1)));
  CHECK(runtime::expectedFor(vector) == "a list of 2 numbers, for vec2");
  CHECK_FALSE(takes(number, Value::text("high")));

  const gl::BlockMember weights{.name = "w", .type = GL_FLOAT, .arraySize = 9, .arrayStride = 16};
  CHECK(takes(weights, Value::number(1), 8, 9));
  CHECK_FALSE(takes(weights, Value::number(1), 0, 8));
  CHECK_FALSE(takes(weights, Value::number(1)));
  CHECK_FALSE(takes(weights, listOf({1, 2}), 0, 9));
  CHECK(runtime::expectedFor(weights) == "a list of 9 numbers, for float[9]");
  const gl::BlockMember three{.name = "w", .type = GL_FLOAT, .arraySize = 3, .arrayStride = 16};
  CHECK(takes(three, listOf({1, 2, 3})));
  CHECK_FALSE(takes(three, listOf({1, 2})));
  const gl::BlockMember turn{.name = "m", .type = GL_FLOAT_MAT2x3, .matrixStride = 16};
  CHECK(takes(turn, listOf({1, 2, 3}), 1, 2));
  CHECK_FALSE(takes(turn, listOf({1, 2}), 1, 3));
  CHECK_FALSE(takes(turn, listOf({1, 2, 3, 4})));
  CHECK(runtime::expectedFor(turn) == "a list of 2 lists of 3 numbers, its columns, for mat2x3");
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
