// What a frame writes into uniforms: values of age() of all passes or of some, and the slices of a pass; what a live parameter
// reaches, and what it does not: the bytes of tests/runtime/graphs/live.json, each number worked out by hand; and what GL has then.
#include <algorithm>
#include <cstring>
#include <vector>

#include "engine/runtime/uniforms/frame_uniforms.h"
#include "tests/runtime/plan_on_device.h"
#include "tests/runtime/stage.h"

namespace uniforms_frame_uniforms_test {

using namespace weft;
using namespace weft::runtime::test;
using graph::Value;

namespace {

struct Filled {
  PlanOnDevice on;
  runtime::FrameUniforms uniforms;

  explicit Filled(const std::string& graph) : on(graph), uniforms(*on.plan, on.device.imports, 256) {
    text::Diagnostics diagnostics;
    uniforms.layOut(on.passes, diagnostics);
    REQUIRE_MESSAGE(diagnostics.empty(), diagnostics.text());
  }
  template <class T>
  T at(std::uint32_t block, const gl::Block* layout, const char* member) const {
    REQUIRE(layout);
    T value{};
    std::memcpy(&value, uniforms.bytes().data() + block + layout->find(member)->offset, sizeof value);
    return value;
  }
  float amountOf(const char* pass) {
    const runtime::PreparedPass& each = on[pass];
    return at<float>(each.parametersOffset, each.parametersBlock, "amount");
  }
};

}  // namespace

TEST_CASE("a frame writes what depends on time; a parameter is written when it is set") {
  const CleanScope clean;
  Filled live("tests/runtime/graphs/live.json");
  live.uniforms.refresh(live.on.passes, agedBy(3), false);
  CHECK(live.amountOf("timed") == 12);  // 3 seconds * speed
  CHECK(live.amountOf("kept") == 50);   // slow * 10
  REQUIRE(live.uniforms.set("slow", Value::number(7)));
  CHECK(live.amountOf("kept") == 70);
  CHECK(live.uniforms.parameters()[1] == Value::number(7));
  live.uniforms.refresh(live.on.passes, agedBy(5), true);  // the pass is `always`
  CHECK(live.amountOf("timed") == 20);
}

TEST_CASE("slices: the pass type learns its part, and the shader where that begins") {
  const CleanScope clean;
  Filled sliced("tests/runtime/graphs/slices.json");
  runtime::PreparedPass& map = sliced.on["map"];  // 13 x 11 texels
  const std::uint32_t rows = map.context.groupSize[1], groups = (11 + rows - 1) / rows;
  REQUIRE(groups > 1);
  sliced.uniforms.setSlices(map, {1, 1, groups});  // one row of groups per slice
  CHECK(map.context.slice == 1);
  CHECK(map.context.sliceCount == 1);
  CHECK(map.context.slices == groups);
  struct Axes {
    std::uint32_t x, y, z;
  };
  const auto first = sliced.at<Axes>(map.sliceOffset, map.sliceBlock, "first_group");
  CHECK(first.x == 0);
  CHECK(first.y == 1);
  CHECK(first.z == 0);
}

TEST_CASE("a live parameter writes what reads it, and nothing else") {
  const CleanScope clean;
  Filled live("tests/runtime/graphs/live.json");
  CHECK(live.amountOf("kept") == 50);
  CHECK(live.amountOf("start") == 4);
  CHECK(live.amountOf("scale[1]") == 2);
  REQUIRE(live.uniforms.set("gain", Value::number(4)));
  CHECK(live.amountOf("start") == 2);
  CHECK(live.amountOf("kept") == 50);
  REQUIRE(live.uniforms.set("slow", Value::number(0.5)));
  CHECK(live.amountOf("kept") == 5);
  CHECK(live.amountOf("start") == 2);
}

TEST_CASE("a value that needs another plan, does not fit or has no result changes nothing") {
  const CleanScope clean;
  Filled live("tests/runtime/graphs/live.json");
  const std::vector<std::byte> before(live.uniforms.bytes().begin(), live.uniforms.bytes().end());
  CHECK_FALSE(live.uniforms.set("count", Value::number(2)));     // structural
  CHECK_FALSE(live.uniforms.set("nothing", Value::number(2)));   // unknown
  CHECK_FALSE(live.uniforms.set("gain", Value::number(101)));    // out of its range
  CHECK_FALSE(live.uniforms.set("gain", Value::boolean(true)));  // of another type
  CHECK_FALSE(live.uniforms.set("gain", Value::number(0)));      // 8 / 0
  CHECK(std::ranges::equal(live.uniforms.bytes(), before));
  for (std::size_t i = 0; i < live.uniforms.parameters().size(); ++i)
    CHECK(live.uniforms.parameters()[i] == live.on.plan->graph->parameters[i].value);
}

TEST_CASE("what depends on time is written when it is refreshed, with the newest parameters") {
  const CleanScope clean;
  Filled live("tests/runtime/graphs/live.json");
  live.uniforms.refresh(live.on.passes, agedBy(3), true);
  CHECK(live.amountOf("timed") == 12);  // age * speed
  REQUIRE(live.uniforms.set("speed", Value::number(10)));
  CHECK(live.amountOf("timed") == 12);
  live.uniforms.refresh(live.on.passes, agedBy(3), true);
  CHECK(live.amountOf("timed") == 30);
  live.uniforms.refresh(live.on.passes, agedBy(1e9), true);
  CHECK(live.amountOf("timed") == 1000);
}

TEST_CASE("blocks are at aligned offsets, and what changes reaches the buffer with the next upload, once") {
  const CleanScope clean;
  Filled live("tests/runtime/graphs/live.json");
  std::vector<std::uint32_t> offsets;
  for (const runtime::PreparedPass& pass : live.on.passes)
    if (pass.parametersBlock) offsets.push_back(pass.parametersOffset);
  CHECK(std::ranges::adjacent_find(offsets, std::ranges::greater_equal{}) == offsets.end());
  CHECK(std::ranges::all_of(offsets, [](std::uint32_t offset) { return offset % 256 == 0; }));
  const runtime::PreparedPass& kept = live.on["kept"];
  const std::uint32_t at = kept.parametersOffset + kept.parametersBlock->find("amount")->offset;
  const auto sent = [&] {
    const float foreign = -1;  // stays as long as nothing is sent
    gl::uploadBuffer(live.uniforms.buffer(), at, std::as_bytes(std::span(&foreign, 1)));
    live.uniforms.upload();
    float value = 0;
    glGetNamedBufferSubData(live.uniforms.buffer(), at, sizeof value, &value);
    return value;
  };
  CHECK(sent() == 50);
  CHECK(sent() == -1);
  const std::uint64_t hash = live.uniforms.hash(kept.parametersOffset, kept.parametersBlock, 1);
  REQUIRE(live.uniforms.set("slow", Value::number(7)));
  CHECK(sent() == 70);
  CHECK(sent() == -1);
  CHECK(live.uniforms.hash(kept.parametersOffset, kept.parametersBlock, 1) != hash);
  CHECK(live.uniforms.hash(0, nullptr, 5) == 5);
}

}  // namespace uniforms_frame_uniforms_test
