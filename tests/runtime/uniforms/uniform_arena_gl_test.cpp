// The bytes that shaders read: offsets as the device wants them, and an upload only when a byte has changed. GL itself is
// the judge: the buffer is read back.
#include <doctest/doctest.h>

#include <array>
#include <span>
#include <vector>

#include "engine/runtime/uniforms/uniform_arena.h"
#include "tests/gl/gl_test.h"

namespace weft::runtime {

namespace {

using gl::test::CleanScope;

constexpr std::uint32_t kAlignment = 256;

gl::Block blockOf(std::uint32_t bytes, std::vector<gl::BlockMember> members) {
  gl::Block block;
  block.bytes = bytes;
  block.members = std::move(members);
  return block;
}

gl::BlockMember memberOf(const char* name, GLenum type, std::uint32_t offset) {
  gl::BlockMember member;
  member.name = name;
  member.type = type;
  member.offset = offset;
  return member;
}

template <class T>
T readBack(const UniformArena& arena, std::uint32_t at) {
  T value{};
  glGetNamedBufferSubData(arena.buffer(), at, sizeof value, &value);
  return value;
}

struct Arena {
  gl::Block first = blockOf(20, {memberOf("wide", GL_FLOAT_VEC4, 0), memberOf("scalar", GL_FLOAT, 16)});
  gl::Block second = blockOf(300, {memberOf("deep", GL_DOUBLE_VEC4, 256)});
  std::array<PreparedPass, 3> passes;
  PreparedPass &a = passes[0], &b = passes[2];
  UniformArena arena{kAlignment};
  base::Diagnostics diagnostics;

  Arena() {
    a.parametersBlock = &first;
    b.parametersBlock = &second;
    b.sliceBlock = &first;
    arena.layOut(passes, diagnostics);
  }
};

}  // namespace

TEST_CASE("blocks lie one after the other at aligned offsets, and a pass without a block takes no room") {
  const CleanScope clean;
  const Arena all;
  CHECK(all.a.parametersOffset == 0);
  CHECK(all.b.parametersOffset == 256);  // 20 bytes, rounded up
  CHECK(all.b.sliceOffset == 256 + 512);
  CHECK(all.arena.bytes().size() == 256 + 512 + 256);
  CHECK(all.diagnostics.empty());
}

TEST_CASE("what is written reaches the buffer with the next upload, the other bytes stay") {
  const CleanScope clean;
  Arena all;
  all.arena.write(0, all.first.members[0], {graph::Value::Type::list, 4, {1, 2, 3, 4}, {}});
  all.arena.write(all.b.sliceOffset, all.first.members[1], graph::Value::number(7));
  all.arena.upload();
  CHECK(readBack<std::array<float, 4>>(all.arena, 0) == std::array<float, 4>{1, 2, 3, 4});
  CHECK(readBack<float>(all.arena, 16) == 0);
  CHECK(readBack<float>(all.arena, all.b.sliceOffset + 16) == 7);
}

TEST_CASE("an upload happens when a byte has changed, and only then") {
  const CleanScope clean;
  Arena all;
  all.arena.write(0, all.first.members[1], graph::Value::number(7));
  all.arena.upload();
  // Somebody else's bytes in the buffer stay as long as nothing is sent.
  const float foreign = -1;
  const auto isSent = [&] {
    gl::uploadBuffer(all.arena.buffer(), 16, std::as_bytes(std::span(&foreign, 1)));
    all.arena.upload();
    return readBack<float>(all.arena, 16) != foreign;
  };
  CHECK_FALSE(isSent());
  all.arena.write(0, all.first.members[1], graph::Value::number(7));  // the same
  CHECK_FALSE(isSent());
  all.arena.write(0, all.first.members[1], graph::Value::number(8));
  CHECK(isSent());
  CHECK_FALSE(isSent());
}

TEST_CASE("of a vector of doubles the last component counts as the first does") {
  const CleanScope clean;
  Arena all;
  const auto write = [&](double last) {
    all.arena.write(all.b.parametersOffset, all.second.members[0],
                    {graph::Value::Type::list, 4, {1, 2, 3, last}, {}});
    all.arena.upload();
    return readBack<std::array<double, 4>>(all.arena, all.b.parametersOffset + 256)[3];
  };
  CHECK(write(4) == 4);
  CHECK(write(5) == 5);
}

TEST_CASE("a hash follows the bytes of its own block alone") {
  const CleanScope clean;
  Arena all;
  const std::uint64_t first = all.arena.hash(0, &all.first, 1), second = all.arena.hash(256, &all.second, 1);
  all.arena.write(0, all.first.members[0], {graph::Value::Type::list, 4, {0, 0, 0, 1}, {}});
  CHECK(all.arena.hash(0, &all.first, 1) != first);
  CHECK(all.arena.hash(256, &all.second, 1) == second);
  CHECK(all.arena.hash(0, nullptr, 5) == 5);
}

}  // namespace weft::runtime
