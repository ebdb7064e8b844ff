#include "tests/runtime/prepared_plan.h"

#include <algorithm>

#include "engine/graph/compile/compile.h"
#include "engine/graph/expand/expand.h"
#include "engine/graph/read/read.h"
#include "engine/runtime/frame/renderer.h"
#include "engine/runtime/prepare/prepare.h"
#include "engine/runtime/prepare/program_request.h"
#include "tests/runtime/stage.h"

namespace weft::runtime::test {

PreparedPlan::PreparedPlan(const std::string& graphFile)
    : device(context(), shaderRootsOf(sourcePath(graphFile), {}, WEFT_SOURCE_DIR), "") {
  base::Diagnostics diagnostics;
  const auto desc = graph::readGraph(sourcePath(graphFile), diagnostics);
  const auto flat = desc ? graph::expandGraph(*desc, makeRegistry({}, {}), {}, diagnostics) : nullptr;
  REQUIRE_MESSAGE(flat, diagnostics.text());
  plan = std::make_shared<const graph::Plan>(graph::compile(flat));
  pool = ResourcePool::create(*plan, nullptr, diagnostics);
  REQUIRE_MESSAGE(pool, diagnostics.text());
  for (std::size_t at = 0; at < plan->steps.size(); ++at) {
    const std::uint32_t pass = plan->steps[at].pass;
    const graph::PassSpec& spec = flat->specs[pass];
    const graph::PassType type = device.passTypes.find(spec.type)->reflect();
    const std::uint32_t conditions = settledConditionsOf(spec);
    std::shared_ptr<const gl::Variant> variant;
    if (type.shader != graph::ShaderShape::none)
      variant = device.programs.get(programRequestOf(*flat, *plan, pass, type, conditions), diagnostics);
    PrepareContext context{*plan, device.passTypes,  variant,         conditions,
                           *pool, device.geometries, device.samplers, diagnostics};
    passes.push_back(preparePass(context, at));
  }
  REQUIRE_MESSAGE(diagnostics.empty(), diagnostics.text());
}

std::size_t PreparedPlan::step(std::string_view pass) const {
  const auto found =
      std::ranges::find_if(passes, [&](const PreparedPass& each) { return each.context.spec->name == pass; });
  REQUIRE_MESSAGE(found != passes.end(), std::string(pass));
  return static_cast<std::size_t>(found - passes.begin());
}

float PreparedPlan::texel(std::string_view resource) {
  const std::uint32_t index = lastVersionOf(*plan, resource);
  REQUIRE_MESSAGE(index != graph::kNone, std::string(resource));
  base::Diagnostics ignored;
  const gl::TextureRef texture =
      pool->view(*plan, {.resource = index}, (*pool)[index].copyOf(0), GL_TEXTURE_2D, ignored);
  return gl::readFloats(texture).at(0);
}

std::vector<PreparedPass*> PreparedPlan::all() {
  std::vector<PreparedPass*> pointers;
  for (PreparedPass& pass : passes) pointers.push_back(&pass);
  return pointers;
}

std::function<double(std::uint32_t)> agedBy(double seconds) {
  return [seconds](std::uint32_t) { return seconds; };
}

}  // namespace weft::runtime::test
