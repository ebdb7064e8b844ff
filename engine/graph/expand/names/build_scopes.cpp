// The scopes of a graph and its includes, before any name is looked up.
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <filesystem>

#include "engine/base/nearest.h"
#include "engine/graph/expand/names/scope.h"

namespace weft::graph::expansion {

namespace {

// `path` begins with the prefix of the scope; the rest is its name there.
void addParameter(Model& model, Scope& scope, const ParameterDesc& desc, std::string path) {
  const auto index = static_cast<std::uint32_t>(model.parameters.size());
  Leaves& leaves = model.parametersByLeaf[desc.name];
  (leaves.count++ == 0 ? leaves.first : model.parameters[leaves.last].nextOfLeaf) = index;
  leaves.last = index;
  assert(index < model.parameters.capacity());
  model.parameters.push_back({&desc, std::move(path), desc.initial, false, desc.initialPlace});
  const std::string_view name = std::string_view(model.parameters.back().path).substr(scope.prefix.size());
  scope.variables.try_emplace(name, Variable{Variable::Kind::parameter, index});
}

// How many of each there will be, of a file and all that it includes.
struct Counts {
  std::size_t scopes = 0, parameters = 0, lets = 0, resources = 0;

  void add(const GraphDesc& desc) {
    ++scopes;
    parameters += desc.parameters.size();
    lets += desc.lets.size();
    resources += desc.resources.size();
    for (const PassDesc& pass : desc.passes) {
      for (const PassParameterDesc& parameter : pass.parameters) parameters += parameter.declared ? 1 : 0;
      if (pass.include && pass.include->graph) add(*pass.include->graph);
    }
  }
};

void buildScope(Model& model, Scope& scope);

void addInclude(Model& model, Scope& scope, const PassDesc& stanza) {
  const IncludeDesc& include = *stanza.include;
  if (!include.graph) {  // the reader said why
    for (Scope* outer = &scope; outer; outer = outer->parent) outer->broken = true;
    return;
  }
  assert(model.scopes.size() < model.scopes.capacity());
  Scope& child = model.scopes.emplace_back();
  child.desc = include.graph.get();
  child.parent = &scope;
  child.stanza = &stanza;
  child.prefix = scope.prefix + include.as + ".";
  child.group = include.group.empty() ? scope.group : scope.prefix + include.group;
  scope.includes.try_emplace(include.as, &child);
  buildScope(model, child);
  std::vector<std::string> inputs;
  for (const ResourceDesc& resource : child.desc->resources)
    if (resource.kind == ResourceDesc::Kind::input) inputs.push_back(resource.name);
  for (const auto& [name, ref] : include.binds) {
    const bool part = ref.mip || ref.layer || ref.face || ref.element || ref.stencil || ref.history ||
                      ref.condition.present() || ref.optional;
    if (std::find(inputs.begin(), inputs.end(), name) == inputs.end()) {
      auto& d = model.diagnostics.error(
          Code::badBind, ref.place,
          fmt::format("include '{}' binds '{}', which is no input of '{}'", include.as, name, include.file));
      d.hint = base::nearestHint(name, inputs);
    }
    if (part) {
      auto& d = model.diagnostics.error(
          Code::badBind, ref.place,
          fmt::format("include '{}' binds '{}' to a part of a resource", include.as, name));
      d.expected = "the name of a whole resource";
      d.found = ref.text;
      d.hint =
          fmt::format("give the part a name with a resource that is a list, \"{}\": [\"{}\"], and bind that",
                      name, ref.text);
    } else if (const std::string_view words = ref.words(); !words.empty()) {
      auto& d = model.diagnostics.error(
          Code::badBind, ref.place,
          fmt::format("include '{}' binds '{}' {}, which only a slot can say", include.as, name, words));
      d.expected = "the name of a whole resource";
      d.found = ref.text;
      d.hint = fmt::format("write \"{}\" here, and '{} {}' in the slots of '{}' that read it", ref.name, name,
                           words, include.file);
    }
  }
}

void buildScope(Model& model, Scope& scope) {
  const GraphDesc& desc = *scope.desc;
  scope.variables.reserve(desc.parameters.size() + desc.lets.size());
  scope.resources.reserve(desc.resources.size());
  scope.passes.reserve(desc.passes.size());
  for (const ParameterDesc& parameter : desc.parameters)
    addParameter(model, scope, parameter, scope.prefix + parameter.name);
  for (const NamedExpr& let : desc.lets) {
    scope.variables.try_emplace(let.name,
                                Variable{Variable::Kind::let, static_cast<std::uint32_t>(model.lets.size())});
    Let& made = model.lets.emplace_back();
    made.desc = &let;
    made.scope = &scope;
    made.path = scope.prefix + let.name;
  }
  for (const ResourceDesc& resource : desc.resources) {
    if (!scope.resources.try_emplace(resource.name, static_cast<std::uint32_t>(model.entities.size())).second)
      continue;
    Entity& entity = model.entities.emplace_back();
    entity.kind = resource.kind;
    entity.desc = &resource;
    entity.scope = &scope;
    entity.name = scope.prefix + resource.name;
  }
  for (const PassDesc& pass : desc.passes) {
    if (pass.include) {
      addInclude(model, scope, pass);
      continue;
    }
    if (!scope.passes.try_emplace(pass.name, &pass).second) continue;  // W009 of the reader
    for (const PassParameterDesc& parameter : pass.parameters)
      if (parameter.declared)
        addParameter(model, scope, *parameter.declared, scope.prefix + pass.name + "." + parameter.name);
  }
}

// A file with inputs that is opened by itself has nothing behind them.
void reportToInclude(Model& model) {
  const GraphDesc& desc = model.desc;
  const ResourceDesc* first = nullptr;
  std::string inputs, binds;
  for (const ResourceDesc& resource : desc.resources) {
    if (resource.kind != ResourceDesc::Kind::input || resource.optional) continue;
    if (!first) first = &resource;
    inputs += (inputs.empty() ? "" : ", ") + resource.name;
    if (binds.empty()) binds = fmt::format("\"{}\": …", resource.name);
  }
  if (!first) return;
  model.toInclude = model.incomplete = true;
  const std::string file = std::filesystem::path(desc.path).filename().string();
  auto& d = model.diagnostics.error(
      Code::unboundInput, first->place,
      fmt::format("'{}' is a file to include, not a graph: nothing is behind its inputs ({})", file, inputs));
  d.resource = first->name;
  d.hint = fmt::format(
      "open a graph that includes it, or include it in one: {{ \"include\": \"{}\", \"bind\": {{ {} }} }}",
      file, binds);
}

}  // namespace

void buildScopes(Model& model) {
  Counts counts;
  counts.add(model.desc);
  model.scopes.reserve(counts.scopes);
  model.parameters.reserve(counts.parameters);
  model.parametersByLeaf.reserve(counts.parameters);
  model.lets.reserve(counts.lets);
  // Each type of import may be named without a declaration.
  model.entities.reserve(counts.resources + model.registry.imports.size());
  Scope& root = model.scopes.emplace_back();
  root.desc = &model.desc;
  buildScope(model, root);
  reportToInclude(model);
  findDynamicLets(model);
  linkAlternatives(model);
}

}  // namespace weft::graph::expansion
