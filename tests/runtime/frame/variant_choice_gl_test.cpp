// Which variant of a pass an age asks for, and how often one is made.
#include "engine/runtime/frame/variant_choice.h"
#include "tests/runtime/plan_on_device.h"
#include "tests/runtime/stage.h"
#include "tests/temporary_folder.h"

using namespace weft;
using namespace weft::runtime::test;

namespace {

constexpr double kYoung = 0.5, kOld = 1e9;  // seconds

struct Choosing {
  PlanOnDevice prepared;
  runtime::VariantChoice choice;
  base::Diagnostics diagnostics;

  explicit Choosing(const std::string& graph)
      : prepared(graph), choice(*prepared.plan, prepared.device, *prepared.pool, prepared.passes) {}
  // Whether a variant was prepared for the first time.
  bool choose(double age, bool alwaysOnly = false) {
    diagnostics.clear();
    return choice.choose(agedBy(age), alwaysOnly, diagnostics);
  }
};

}  // namespace

TEST_CASE("a timed pass runs while its resource is young, and each variant is prepared once") {
  const CleanScope clean;
  Choosing timed("tests/runtime/graphs/timed.json");
  const auto idle = [&] {
    CHECK(timed.prepared["take"].idle == timed.prepared["add"].idle);
    CHECK_FALSE(timed.prepared["start"].idle);
    return timed.prepared["add"].idle;
  };
  CHECK_FALSE(timed.choose(kOld));  // as it was prepared
  CHECK(idle());
  CHECK(timed.choice.all().size() == 4);
  CHECK(timed.choose(kYoung));
  CHECK_FALSE(idle());
  CHECK(timed.prepared["add"].textures.size() == 1);
  CHECK(timed.choice.all().size() == 6);
  for (const double age : {kYoung, kOld, kYoung, kOld}) {
    CHECK_FALSE(timed.choose(age, age == kYoung));  // both passes are `always`
    CHECK(idle() == (age == kOld));
  }
  CHECK(timed.choice.all().size() == 6);
  CHECK(timed.diagnostics.empty());
}

TEST_CASE("a variant that does not compile is reported once, and the pass keeps the one that it has") {
  const CleanScope clean;
  TemporaryFolder folder;
  folder.write("shaders/young.frag.glsl", R"(uniform sampler2D pulse;
out vec4 result;
#if YOUNG
void main() { result = vec4(missing); }
#else
void main() { result = texelFetch(pulse, ivec2(0), 0); }
#endif
)");
  folder.write("shaders/pulse.frag.glsl", "out vec4 result;\nvoid main() { result = vec4(1); }\n");
  folder.write("graph.json", R"({
  "resources": { "pulse": { "texture": "r32f", "size": 4 }, "shown": { "texture": "r32f", "size": 4 } },
  "passes": [
    { "name": "pulse", "type": "fullscreen", "shader": "pulse.frag.glsl", "update": "once", "write": { "result": "pulse" } },
    { "name": "show", "type": "fullscreen", "shader": "young.frag.glsl", "read": { "pulse": "pulse" },
      "write": { "result": "shown" }, "defines": { "YOUNG": "age(pulse) < 2" } }
  ],
  "present": "shown"
})");
  Choosing one(folder.at("graph.json"));
  const auto variant = one.prepared["show"].variant;
  CHECK_FALSE(one.choose(kYoung));
  CHECK(one.diagnostics.contains(base::Code::shaderDoesNotCompile));
  CHECK(one.prepared["show"].variant == variant);
  CHECK_FALSE(one.choose(kYoung));
  CHECK(one.diagnostics.empty());
  CHECK(one.prepared["show"].usable);
}
