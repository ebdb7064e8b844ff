// What a plan that is prepared shares with the one that runs, which stays as it was whatever happens.
#include <algorithm>

#include "engine/runtime/frame/execution.h"
#include "tests/runtime/plan_on_device.h"
#include "tests/runtime/stage.h"
#include "tests/temporary_folder.h"

namespace frame_prepared_plan_test {

using namespace weft;
using namespace weft::runtime::test;
using runtime::ShaderFiles;

TEST_CASE("a plan of equal passes keeps all of them, with their storage") {
  const CleanScope clean;
  PlanOnDevice running("tests/runtime/graphs/live.json");
  CHECK(running.prepared.passesPrepared == 4);
  const std::uint64_t serial = (*running.pool)[running["kept"].written.at(0)].serial;
  const auto variant = running["kept"].variant;
  text::Diagnostics diagnostics;
  const auto next = preparePlan(running.device, compiledPlan("tests/runtime/graphs/live.json"),
                                &running.prepared, ShaderFiles::keep, diagnostics);
  REQUIRE_MESSAGE(next, diagnostics.text());
  CHECK(diagnostics.empty());
  CHECK(next->passesPrepared == 0);
  const runtime::PreparedPass& kept = next->passes.at(running.step("kept"));
  CHECK(kept.variant == variant);
  CHECK((*next->pool)[kept.written.at(0)].serial == serial);
}

TEST_CASE("a plan of other passes prepares its own") {
  const CleanScope clean;
  PlanOnDevice running("tests/runtime/graphs/live.json");
  text::Diagnostics diagnostics;
  const auto next = preparePlan(running.device, compiledPlan("tests/runtime/graphs/obsolete.json"),
                                &running.prepared, ShaderFiles::keep, diagnostics);
  REQUIRE_MESSAGE(next, diagnostics.text());
  CHECK(next->passesPrepared == next->passes.size());
}

TEST_CASE("a shader that does not compile leaves the running plan as it was") {
  const CleanScope clean;
  const TemporaryFolder folder;
  const auto write = [&](const char* result) {
    folder.write("shaders/a.frag.glsl",
                 std::string("out vec4 result;\nvoid main() { result = ") + result + "; }\n");
  };
  folder.write("graph.json", R"({
  "resources": { "a": { "texture": "r32f", "size": 4 }, "b": { "texture": "r32f", "size": 4 } },
  "passes": [
    { "name": "a", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "result": "a" }, "side_effect": true },
    { "name": "b", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "result": "b" } }
  ],
  "present": "b"
})");
  write("vec4(1)");
  PlanOnDevice running(folder.at("graph.json"));
  write("vec4(missing)");
  text::Diagnostics diagnostics;
  CHECK_FALSE(preparePlan(running.device, running.plan, &running.prepared, ShaderFiles::read, diagnostics));
  CHECK(diagnostics.contains(text::Code::shaderDoesNotCompile));
  REQUIRE(running.passes.size() == 2);
  for (const runtime::PreparedPass& pass : running.passes) {
    CHECK(pass.variant);
    CHECK((*running.pool)[pass.written.at(0)].texture);
  }
}

TEST_CASE("storage that cannot be made leaves the running plan as it was") {
  const CleanScope clean;
  PlanOnDevice running("tests/runtime/graphs/live.json");
  const auto serials = [&] {
    std::vector<std::uint64_t> found;
    for (std::size_t r = 0; r < running.plan->graph->resources.size(); ++r) {
      const runtime::GpuResource& resource = (*running.pool)[r];
      found.push_back(resource.serial);
      if (resource.texture) CHECK(resource.texture->serial() == resource.serial);
    }
    return found;
  };
  const std::vector<std::uint64_t> before = serials();
  // Each storage in turn is one that no device has: the others are there by then, or not yet.
  for (std::size_t s = 0; s < running.plan->storages.size(); ++s) {
    CAPTURE(s);
    auto large = std::make_shared<graph::Plan>(*running.plan);
    large->storages[s].width = 1u << 24;
    text::Diagnostics diagnostics;
    CHECK_FALSE(preparePlan(running.device, large, &running.prepared, ShaderFiles::keep, diagnostics));
    CHECK(diagnostics.contains(text::Code::textureNotCreated));
    CHECK(serials() == before);
    CHECK(running.passes.size() == running.plan->steps.size());
  }
  text::Diagnostics diagnostics;
  const auto next =
      preparePlan(running.device, running.plan, &running.prepared, ShaderFiles::keep, diagnostics);
  REQUIRE_MESSAGE(next, diagnostics.text());
  CHECK(next->passesPrepared == 0);
  for (std::size_t r = 0; r < before.size(); ++r)
    CHECK((*next->pool)[r].texture == (*running.pool)[r].texture);
}

}  // namespace frame_prepared_plan_test
