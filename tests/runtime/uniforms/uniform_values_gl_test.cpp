// What a live parameter reaches, and what it does not: the bytes of tests/runtime/graphs/live.json, each number worked out by
// hand.
#include <algorithm>
#include <cstring>

#include "engine/runtime/uniforms/uniform_values.h"
#include "tests/runtime/plan_on_device.h"
#include "tests/runtime/stage.h"

using namespace weft;
using namespace weft::runtime::test;
using graph::Value;

namespace {

struct LiveValues {
  PlanOnDevice prepared{"tests/runtime/graphs/live.json"};
  runtime::UniformArena arena{256};
  runtime::UniformValues values{*prepared.plan->graph};

  LiveValues() {
    base::Diagnostics diagnostics;
    arena.layOut(prepared.passes, diagnostics);
    values.fill(prepared.passes, arena);
    REQUIRE_MESSAGE(diagnostics.empty(), diagnostics.text());
  }
  float amountOf(const char* pass) {
    const runtime::PreparedPass& each = prepared[pass];
    float amount = 0;
    std::memcpy(&amount,
                arena.bytes().data() + each.parametersOffset + each.parametersBlock->find("amount")->offset,
                sizeof amount);
    return amount;
  }
  void refresh(double age) { values.refresh(prepared["timed"], agedBy(age), arena); }
  bool set(const char* name, const Value& value) { return values.set(name, value, arena); }
};

}  // namespace

TEST_CASE("a live parameter writes what reads it, and nothing else") {
  const CleanScope clean;
  LiveValues live;
  CHECK(live.amountOf("kept") == 50);
  CHECK(live.amountOf("start") == 4);
  CHECK(live.amountOf("scale[1]") == 2);
  REQUIRE(live.set("gain", Value::number(4)));
  CHECK(live.amountOf("start") == 2);
  CHECK(live.amountOf("kept") == 50);
  REQUIRE(live.set("slow", Value::number(0.5)));
  CHECK(live.amountOf("kept") == 5);
  CHECK(live.amountOf("start") == 2);
}

TEST_CASE("a value that needs another plan, does not fit or has no result changes nothing") {
  const CleanScope clean;
  LiveValues live;
  const std::vector<std::byte> before(live.arena.bytes().begin(), live.arena.bytes().end());
  CHECK_FALSE(live.set("count", Value::number(2)));     // structural
  CHECK_FALSE(live.set("nothing", Value::number(2)));   // unknown
  CHECK_FALSE(live.set("gain", Value::number(101)));    // out of its range
  CHECK_FALSE(live.set("gain", Value::boolean(true)));  // of another type
  CHECK_FALSE(live.set("gain", Value::number(0)));      // 8 / 0
  CHECK(std::ranges::equal(live.arena.bytes(), before));
  for (std::size_t i = 0; i < live.values.parameters().size(); ++i)
    CHECK(live.values.parameters()[i] == live.prepared.plan->graph->parameters[i].value);
}

TEST_CASE("what depends on time is written when it is refreshed, with the newest parameters") {
  const CleanScope clean;
  LiveValues live;
  live.refresh(3);
  CHECK(live.amountOf("timed") == 12);  // age * speed
  REQUIRE(live.set("speed", Value::number(10)));
  CHECK(live.amountOf("timed") == 12);
  live.refresh(3);
  CHECK(live.amountOf("timed") == 30);
  live.refresh(1e9);
  CHECK(live.amountOf("timed") == 1000);
}
