#include "app/lsp/files/analysis.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/session/session.h"
#include "engine/base/json/dom.h"
#include "engine/base/nearest.h"
#include "engine/graph/compile/compile.h"
#include "engine/graph/read/read.h"
#include "engine/runtime/frame/renderer.h"
#include "engine/runtime/imports/registry.h"
#include "engine/runtime/prepare/program_check.h"
#include "engine/runtime/prepare/program_request.h"

namespace weft::app::lsp {

namespace {

// Graphs are checked even when the scene cannot be read, so its messages are left out.
runtime::WorldFacts factsOf(const Options& options) {
  base::Diagnostics ignored;
  const auto world = loadWorld(options, ignored);
  return world ? world->facts() : factsWithoutWorld();
}

std::string pathOf(const base::Diagnostic& diagnostic, const std::string& root) {
  return diagnostic.place.file && diagnostic.place.line > 0 ? pathKey(*diagnostic.place.file) : root;
}

// The shader files of a pass, described or expanded.
template <class Pass>
std::vector<std::string> shaderFilesOf(const Pass& pass, graph::ShaderShape shape) {
  if (!pass.vertexShader.empty()) return {pass.shader, pass.vertexShader};
  if (shape == graph::ShaderShape::draw) return {pass.shader + ".vert.glsl", pass.shader + ".frag.glsl"};
  return {pass.shader};
}

// Whether the graph's folders of shaders are still the same: one may appear or go while the graph is open.
bool hasShaderRoots(const Analysis::Graph& graph) {
  return graph.sources && graph.sources->roots() == runtime::shaderRootsOf(graph.read, dataFolder());
}

}  // namespace

Analysis::Analysis(const Options& options, const Texts& texts, const Project& project)
    : options_(options),
      texts_(texts),
      project_(project),
      registry_(runtime::makeRegistry({}, factsOf(options))) {}

// Whether a file was a graph and a mistake hides that now, such as an open comment or quote before the first key.
bool Analysis::isBrokenGraph(const std::string& path, const FileIndex& file) const {
  if (!graphs_.contains(path)) return false;
  base::Diagnostics said;
  return !base::parseJson(file.text->bytes(), std::make_shared<const std::string>(path), said);
}

// The open graphs that no other open graph includes or extends, and all that include each other in a circle.
std::set<std::string> Analysis::roots() const {
  std::map<std::string, std::set<std::string>> closures;
  for (const auto& [path, opened] : texts_.opened()) {
    const auto file = project_.index(path);
    if (!file || (!file->isGraph && !isBrokenGraph(path, *file))) continue;
    std::vector<std::string> closure = project_.closure(path);
    closures[path] = {closure.begin(), closure.end()};
  }
  std::set<std::string> roots;
  for (const auto& [path, files] : closures)
    if (std::ranges::none_of(closures, [&](const auto& other) {
          return other.second.contains(path) && !files.contains(other.first);
        }))
      roots.insert(path);
  return roots;
}

std::set<std::string> Analysis::refresh(const std::set<std::string>& changed) {
  std::set<std::string> touched = changed;
  const std::set<std::string> wanted = roots();
  std::erase_if(graphs_, [&](const auto& known) {
    if (wanted.contains(known.first)) return false;
    touched.insert(known.second.files.begin(), known.second.files.end());
    return true;
  });
  for (const std::string& path : wanted) {
    const auto known = graphs_.find(path);
    const bool same = known != graphs_.end() && (!known->second.sources || hasShaderRoots(known->second)) &&
                      std::ranges::none_of(changed, [&](const std::string& each) {
                        return known->second.files.contains(each);
                      });
    if (same) continue;
    Graph& graph = graphs_[path];
    touched.insert(graph.files.begin(), graph.files.end());
    look(path, graph);
    touched.insert(graph.files.begin(), graph.files.end());
  }
  return touched;
}

void Analysis::look(const std::string& path, Graph& graph) {
  base::takeUncompared();  // a new budget for nearest names: each look is a run of its own
  graph.said.clear();
  graph.files = {path};
  graph.current = false;
  loaded_.clear();
  const auto file = project_.index(path);
  if (file && project_.isPreset(path)) {
    base::parseJson(file->text->bytes(), std::make_shared<const std::string>(path), graph.said);
    return;
  }
  const auto desc = graph::readGraph(path, graph.said);
  if (desc)
    for (const std::string& each : desc->files) graph.files.insert(pathKey(each));
  for (std::string& each : project_.closure(path)) graph.files.insert(std::move(each));
  if (!desc) return;
  graph.read = desc->files;
  if (!hasShaderRoots(graph))
    graph.sources = std::make_unique<glsl::SourceLoader>(runtime::shaderRootsOf(graph.read, dataFolder()));
  graph.sources->forgetTouched();
  const auto flat = graph::expandGraph(*desc, registry_, settingsOf(options_, true), graph.said);
  if (flat && !graph.said.hasErrors()) {
    auto plan = std::make_shared<const graph::Plan>(graph::compile(flat));
    graph.current = graph::checkMemory(*plan, graph.said);
    checkShaders(graph, *plan);
    graph.plan = std::move(plan);
  } else {
    checkFiles(graph, *desc);
  }
  for (const std::string& each : graph.sources->touched()) graph.files.insert(pathKey(each));
  graph.said.sortByPlace();
}

std::shared_ptr<const glsl::ShaderSource> Analysis::source(Graph& graph, const std::string& shader,
                                                           const base::Place& place) {
  const auto [known, fresh] = loaded_.try_emplace(shader);
  if (fresh) known->second = graph.sources->load(shader, graph.said, place);
  return known->second;
}

// Checks the shaders by what they declare.
void Analysis::checkShaders(Graph& graph, const graph::Plan& plan) {
  const graph::FlatGraph& flat = *plan.graph;
  for (const graph::Step& step : plan.steps) {
    const graph::PassSpec& spec = flat.specs[step.pass];
    const auto type = std::ranges::find(registry_.passTypes, spec.type, &graph::PassType::name);
    if (type == registry_.passTypes.end() || type->shader == graph::ShaderShape::none) continue;
    const gl::ProgramRequest request = runtime::programRequestOf(flat, plan, step.pass, *type);
    std::vector<gl::StageSource> stages;
    bool whole = true;
    for (const gl::ProgramRequest::Stage& stage : request.stages) {
      if (!stage.text.empty()) continue;
      stages.push_back({stage.stage, source(graph, stage.file, spec.shaderPlace)});
      whole = whole && stages.back().source;
    }
    if (whole) runtime::checkProgram(plan, step.pass, stages, request.defines, nullptr, graph.said);
  }
}

// Reports which shaders of a graph without a plan are missing.
void Analysis::checkFiles(Graph& graph, const graph::GraphDesc& desc) {
  for (const graph::PassDesc& pass : desc.passes) {
    if (pass.include && pass.include->graph) checkFiles(graph, *pass.include->graph);
    const auto type = std::ranges::find(registry_.passTypes, pass.type, &graph::PassType::name);
    if (pass.shader.empty() || type == registry_.passTypes.end()) continue;
    // A draw with a shader of one stage has its own message (W067).
    if (type->shader == graph::ShaderShape::draw && pass.vertexShader.empty() &&
        pass.shader.ends_with(".glsl"))
      continue;
    for (const std::string& each : shaderFilesOf(pass, type->shader)) source(graph, each, pass.shaderPlace);
  }
}

std::vector<base::Diagnostic> Analysis::diagnosticsOf(const std::string& path) const {
  std::vector<base::Diagnostic> found;
  for (const auto& [root, graph] : graphs_)
    for (const base::Diagnostic& each : graph.said.items()) {
      if (pathOf(each, root) != path) continue;
      const bool known = std::ranges::any_of(found, [&](const base::Diagnostic& other) {
        return other.code == each.code && other.message == each.message &&
               other.place.line == each.place.line && other.place.column == each.place.column;
      });
      if (!known) found.push_back(each);
    }
  return found;
}

Analysis::Found Analysis::graphWith(const std::string& path) const {
  for (const bool itself : {true, false})
    for (const auto& [root, graph] : graphs_) {
      if (!graph.plan || (root == path) != itself) continue;
      if (itself) return {&graph, ""};
      if (const auto prefix = project_.prefixIn(root, path)) return {&graph, *prefix};
    }
  return {};
}

}  // namespace weft::app::lsp
