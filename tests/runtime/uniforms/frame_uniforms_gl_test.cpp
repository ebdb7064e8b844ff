// What a frame writes into uniforms: values of age() of all passes or of some, and the slices of a pass.
#include <algorithm>
#include <cstring>
#include <vector>

#include "engine/runtime/uniforms/frame_uniforms.h"
#include "tests/runtime/plan_on_device.h"
#include "tests/runtime/stage.h"

using namespace weft;
using namespace weft::runtime::test;
using graph::Value;

namespace {

struct Filled {
  PlanOnDevice on;
  runtime::FrameUniforms uniforms;

  explicit Filled(const std::string& graph) : on(graph), uniforms(*on.plan, on.device.imports, 256) {
    base::Diagnostics diagnostics;
    uniforms.layOut(on.passes, diagnostics);
    REQUIRE_MESSAGE(diagnostics.empty(), diagnostics.text());
  }
  template <class T>
  T at(std::uint32_t block, const gl::Block* layout, const char* member) const {
    REQUIRE(layout);
    T value{};
    std::memcpy(&value, uniforms.arena().bytes().data() + block + layout->find(member)->offset, sizeof value);
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
  live.on["timed"].usable = false;
  live.uniforms.refresh(live.on.passes, agedBy(6), false);
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
