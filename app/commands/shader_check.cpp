#include "app/commands/shader_check.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/session/session.h"
#include "engine/graph/language/enough.h"
#include "engine/passes/pass_registry.h"
#include "engine/runtime/prepare/program_check.h"
#include "engine/runtime/prepare/program_request.h"

namespace weft::app {

namespace {

// What tells the variants of a plan's passes apart, and which slots and parameters a pass holds against them.
std::string keyOf(const gl::ProgramRequest& request) {
  std::string key = request.pass;
  for (const gl::ProgramRequest::Stage& stage : request.stages) key += "|" + stage.file;
  for (const glsl::Define& define : request.defines) key += "|" + define.name + "=" + define.value;
  for (const std::string& output : request.outputs) key += "|" + output;
  return key;
}

// What tells messages apart: the place and the words.
std::string keyOf(const base::Diagnostic& d) {
  const base::Place& place = d.place.inFile();
  return fmt::format("{}:{}:{} {}", place.file ? *place.file : "", place.line, place.column, d.message);
}

// Whether two instances of one stanza have the same variant with the same things in its slots, so that one of them is enough. There
// may be a million.
bool isAlike(const graph::Plan& plan, const graph::PassSpec& a, const graph::PassSpec& b) {
  const graph::FlatGraph& graph = *plan.graph;
  const auto sameDefine = [](const graph::DefineSpec& x, const graph::DefineSpec& y) {
    return x.name == y.name && x.text == y.text;
  };
  if (a.declared != b.declared || a.shader != b.shader || a.vertexShader != b.vertexShader ||
      a.slotCount != b.slotCount || !std::ranges::equal(a.defines, b.defines, sameDefine) ||
      !std::ranges::equal(a.uniforms, b.uniforms, {}, &graph::UniformSpec::name, &graph::UniformSpec::name))
    return false;
  for (std::uint32_t i = 0; i < a.slotCount; ++i) {
    const graph::SlotSpec &mine = graph.slots[a.firstSlot + i], &theirs = graph.slots[b.firstSlot + i];
    if (mine.name != theirs.name || mine.kind != theirs.kind || (mine.useCount > 0) != (theirs.useCount > 0))
      return false;
    if (mine.useCount == 0) continue;
    if (plan.attached[mine.firstUse] != plan.attached[theirs.firstUse]) return false;
    const auto formatOf = [&](const graph::SlotSpec& slot) {
      return graph.resources[graph.uses[slot.firstUse].resource].format;
    };
    if (formatOf(mine) != formatOf(theirs)) return false;
  }
  return true;
}

}  // namespace

// A warning about a shader's text is the same in all its variants.
void ShaderCheck::tell(const base::Diagnostics& said, const std::string& with,
                       base::Diagnostics& diagnostics) {
  for (base::Diagnostic each : said.items()) {
    if (each.severity == base::Severity::warning && !told_.insert(keyOf(each)).second) continue;
    if (!with.empty()) each.message += fmt::format(" (with {})", with);
    diagnostics.add(std::move(each));
  }
}

void ShaderCheck::check(const graph::Plan& plan, const std::string& with, base::Diagnostics& diagnostics) {
  if (failed_) return;
  if (!session_) {
    Options headless = options_;
    headless.backend = "auto";
    base::Diagnostics environment;
    session_ = openDevice(headless, environment);
    failed_ = !session_;
    if (failed_) diagnostics.append(environment);
    if (failed_) return;
  }
  runtime::Device& device = session_->renderer.device();
  device.sources.setRoots(runtime::shaderRootsOf(plan.graph->files, dataFolder()));
  base::Diagnostics said;
  for (const graph::Step& step : plan.steps) {
    const graph::PassSpec& spec = plan.graph->specs[step.pass];
    const graph::PassType type = device.passTypes.find(spec.type)->reflect();
    if (type.shader == graph::ShaderShape::none) continue;
    const auto request = runtime::programRequestOf(*plan.graph, plan, step.pass, type);
    if (!known_.insert(keyOf(request)).second) continue;
    const auto variant = device.programs.get(request, said);
    if (!variant) continue;
    const runtime::LinkedProgram linked{variant->program.reflection(), session_->context->device().limits};
    if (runtime::checkProgram(plan, step.pass, variant->stages, variant->defines, &linked, said))
      runtime::warnOfConditions(spec.name, variant->stages, variant->defines, said);
  }
  tell(said, with, diagnostics);
  read_.insert(device.sources.touched().begin(), device.sources.touched().end());
}

void ShaderCheck::checkDeclared(const graph::Plan& plan, const std::string& with,
                                base::Diagnostics& diagnostics) {
  if (!sources_)
    sources_ = std::make_unique<glsl::SourceLoader>(runtime::shaderRootsOf(plan.graph->files, dataFolder()));
  const passes::PassRegistry types = passes::PassRegistry::builtin();
  base::Diagnostics said;
  const graph::PassSpec* last = nullptr;
  for (const graph::Step& step : plan.steps) {
    if (graph::enoughErrors(said)) break;
    const graph::PassSpec& spec = plan.graph->specs[step.pass];
    if (last && isAlike(plan, *last, spec)) continue;
    last = &spec;
    const graph::PassType type = types.find(spec.type)->reflect();
    if (type.shader == graph::ShaderShape::none) continue;
    const auto request = runtime::programRequestOf(*plan.graph, plan, step.pass, type);
    if (!known_.insert(keyOf(request)).second) continue;
    std::vector<gl::StageSource> stages;
    bool whole = true;
    for (const gl::ProgramRequest::Stage& stage : request.stages) {
      if (!stage.text.empty()) continue;
      const auto [known, fresh] = loaded_.try_emplace(stage.file);
      if (fresh) known->second = sources_->load(stage.file, unread_, request.place);
      stages.push_back({stage.stage, known->second});
      whole = whole && known->second;
    }
    if (whole) runtime::checkProgram(plan, step.pass, stages, request.defines, nullptr, said);
    if (whole) runtime::warnOfConditions(spec.name, stages, request.defines, said);
  }
  tell(said, with, diagnostics);
  read_.insert(sources_->touched().begin(), sources_->touched().end());
}

void ShaderCheck::checkFiles(const graph::GraphDesc& desc, base::Diagnostics& diagnostics) {
  glsl::SourceLoader sources(runtime::shaderRootsOf(desc.files, dataFolder()));
  checkFiles(desc, sources, diagnostics);
  read_.insert(sources.touched().begin(), sources.touched().end());
}

void ShaderCheck::checkFiles(const graph::GraphDesc& desc, glsl::SourceLoader& sources,
                             base::Diagnostics& diagnostics) {
  const passes::PassRegistry types = passes::PassRegistry::builtin();
  for (const graph::PassDesc& pass : desc.passes) {
    if (graph::enoughErrors(diagnostics)) return;
    if (pass.include && pass.include->graph) checkFiles(*pass.include->graph, sources, diagnostics);
    const passes::PassType* type = pass.shader.empty() ? nullptr : types.find(pass.type);
    if (!type) continue;
    std::vector<std::string> files = {pass.shader};
    if (!pass.vertexShader.empty())
      files.push_back(pass.vertexShader);
    else if (type->reflect().shader == graph::ShaderShape::draw && pass.shader.ends_with(".glsl"))
      continue;  // a shader of one stage, for a draw (W067)
    else if (type->reflect().shader == graph::ShaderShape::draw)
      files = {pass.shader + ".vert.glsl", pass.shader + ".frag.glsl"};
    base::Diagnostics said;
    for (const std::string& file : files) sources.load(file, said, pass.shaderPlace);
    for (const base::Diagnostic& each :
         said.items()) {  // a pass that is like another has its shader from there
      if (told_.insert(keyOf(each)).second) diagnostics.add(each);
    }
  }
}

std::vector<std::string> ShaderCheck::files() const {
  return {read_.begin(), read_.end()};
}

}  // namespace weft::app
