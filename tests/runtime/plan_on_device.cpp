#include "tests/runtime/plan_on_device.h"

#include <algorithm>

#include "engine/graph/compile/compile.h"
#include "engine/graph/expand/expand.h"
#include "engine/graph/read/read.h"
#include "engine/runtime/frame/execution.h"
#include "engine/runtime/frame/publications.h"
#include "engine/runtime/frame/renderer.h"
#include "tests/runtime/stage.h"

namespace weft::runtime::test {

std::shared_ptr<const graph::Plan> compiledPlan(const std::string& graphFile) {
  text::Diagnostics diagnostics;
  const auto desc = graph::readGraph(sourcePath(graphFile), diagnostics);
  const auto flat = desc ? graph::expandGraph(*desc, makeRegistry({}, {}), {}, diagnostics) : nullptr;
  REQUIRE_MESSAGE(flat, diagnostics.text());
  REQUIRE_MESSAGE(diagnostics.empty(), diagnostics.text());
  return std::make_shared<const graph::Plan>(graph::compile(flat));
}

PlanOnDevice::PlanOnDevice(const std::string& graphFile)
    : device(context(), shaderRootsOf({{sourcePath(graphFile)}}, WEFT_SOURCE_DIR), "") {
  text::Diagnostics diagnostics;
  auto made = preparePlan(device, compiledPlan(graphFile), nullptr, ShaderFiles::read, diagnostics);
  REQUIRE_MESSAGE(diagnostics.empty(), diagnostics.text());
  REQUIRE(made);
  prepared = *std::move(made);
}

std::size_t PlanOnDevice::step(std::string_view pass) const {
  const auto found =
      std::ranges::find_if(passes, [&](const PreparedPass& each) { return each.context.spec->name == pass; });
  REQUIRE_MESSAGE(found != passes.end(), std::string(pass));
  return static_cast<std::size_t>(found - passes.begin());
}

float PlanOnDevice::texel(std::string_view resource) {
  const std::uint32_t index = lastVersionOf(*plan, resource);
  REQUIRE_MESSAGE(index != graph::kNone, std::string(resource));
  text::Diagnostics ignored;
  const gl::TextureRef texture =
      pool->view(*plan, {.resource = index}, (*pool)[index].copyOf(0), GL_TEXTURE_2D, ignored);
  return gl::readFloats(texture).at(0);
}

std::function<double(std::uint32_t)> agedBy(double seconds) {
  return [seconds](std::uint32_t) { return seconds; };
}

}  // namespace weft::runtime::test
