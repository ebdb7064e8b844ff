#include "engine/runtime/prepare/program_request.h"

#include "engine/glsl/tokens.h"
#include "engine/imports/scene_tables.h"

namespace weft::runtime {

using graph::Access;
using graph::FlatGraph;
using graph::FlatUse;
using graph::Kind;
using graph::PassSpec;
using graph::Plan;
using graph::ShaderShape;
using graph::SlotSpec;

const char* const kFullscreenVertex = R"(
out vec2 uv;
void main() {
  uv = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));
  gl_Position = vec4(uv * 2.0 - 1.0, 0.0, 1.0);
}
)";

std::span<const graph::TableColumn> columnsOf(const FlatGraph& graph, const FlatUse& use) {
  const std::uint32_t import = graph.resources[use.resource].import;
  if (import == graph::kNone) return {};
  return graph.imports[import].columns;
}

std::vector<graph::TableColumn> instanceColumnsOf(const PassSpec& spec) {
  return spec.meshes ? tell(imports::meshColumns()) : tell(imports::sphereColumns());
}

gl::ProgramRequest programRequestOf(const FlatGraph& graph, const Plan& plan, std::uint32_t pass,
                                    const graph::PassType& type) {
  const PassSpec& spec = graph.specs[pass];
  gl::ProgramRequest request;
  request.label = spec.name;
  request.pass = spec.name;
  request.place = spec.shaderPlace;
  if (type.shader == ShaderShape::none) return request;
  if (type.shader == ShaderShape::compute)
    request.stages = {{GL_COMPUTE_SHADER, spec.shader, ""}};
  else if (!spec.vertexShader.empty())
    request.stages = {{GL_VERTEX_SHADER, spec.vertexShader, ""}, {GL_FRAGMENT_SHADER, spec.shader, ""}};
  else if (type.shader == ShaderShape::draw)
    request.stages = {{GL_VERTEX_SHADER, spec.shader + ".vert.glsl", ""},
                      {GL_FRAGMENT_SHADER, spec.shader + ".frag.glsl", ""}};
  else
    request.stages = {{GL_VERTEX_SHADER, "fullscreen.vert.glsl", kFullscreenVertex},
                      {GL_FRAGMENT_SHADER, spec.shader, ""}};
  for (const SlotSpec& slot : graph.slotsOf(spec)) {
    if (slot.useCount == 0) continue;
    if (slot.access != Access::read && !plan.attached[slot.firstUse]) continue;
    request.defines.push_back({glsl::presenceDefineOf(slot.name), "1"});
    if (slot.kind == Kind::color) request.outputs.push_back(slot.name);
  }
  for (const graph::UniformSpec& uniform : spec.uniforms)
    if (uniform.isFirst()) request.defines.push_back({glsl::presenceDefineOf(uniform.name), "1"});
  for (const graph::DefineSpec& define : spec.defines) request.defines.push_back({define.name, define.text});
  return request;
}

}  // namespace weft::runtime
