#include "engine/graph/expand/finish.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "engine/graph/expand/checks.h"
#include "engine/graph/expand/judge/judge.h"
#include "engine/graph/expand/names/versions.h"
#include "engine/graph/subresource.h"

namespace weft::graph::expansion {

namespace {

// A reference at the top of a file, resolved as a read after the last pass. nullopt when there is nothing.
std::optional<FlatUse> resolveFinal(Model& model, Scope& scope, const RefDesc& ref, const std::string& user,
                                    const std::string& name) {
  Names names(model, scope);
  markStructural(model, scope, ref);
  const SlotDesc slot{.name = name, .place = ref.place, .access = Access::read, .ref = ref};
  const SlotContext context{model, names, nullptr, user, {}};
  if (ref.wordsSize > 0) {
    auto& d = model.diagnostics.error(Code::badKind, ref.place,
                                      fmt::format("{} reads '{}', and no shader samples it", user, ref.text));
    d.found = ref.text;
    d.hint = fmt::format("leave '{}' out", ref.words());
    return std::nullopt;
  }
  const SlotWork work = resolveSlot(context, slot, kNone);
  if (work.state != SlotWork::State::connected) return std::nullopt;
  if (work.array) {
    auto& d = model.diagnostics.error(Code::badKind, ref.place,
                                      fmt::format("{} reads '{}', which is an array", user, ref.text));
    d.expected = fmt::format("one element, '{}[0]'", ref.name);
    return std::nullopt;
  }
  FlatUse use = work.use;
  use.resource = currentResource(model, work.entity, work.firstElement);
  return use;
}

void resolvePresent(Model& model) {
  model.graph.present.resource = kNone;
  if (!model.desc.present) return;
  const RefDesc& ref = *model.desc.present;
  const std::size_t before = model.diagnostics.errorCount();
  auto use = resolveFinal(model, model.scopes[0], ref, "present", "present");
  if (!use) return;
  const bool sound = model.diagnostics.errorCount() == before;
  if (!ref.mip || !ref.mip->range) use->mips = 1;  // a span is kept whole; what is shown is its first level
  use->layers = 1;
  use->kind = Kind::copy;
  model.graph.present = *use;  // also what cannot be shown: its writers are no mistake
  if (!sound) return;
  const FlatResource& resource = model.graph.resources[use->resource];
  const bool texture =
      resource.kind == ResourceKind::texture || resource.kind == ResourceKind::imported_texture;
  if (!texture || isDepth(resource.format) || use->history > 0) {
    auto& d = model.diagnostics.error(
        Code::badKind, ref.place, fmt::format("present shows '{}', which is no colour texture", ref.text));
    d.expected = "a colour texture of this frame";
    if (texture && isDepth(resource.format))
      d.hint = fmt::format("to look at it: weft render --present {}", ref.text);
  }
}

// What the runtime can bring to the CPU every frame.
bool checkOutput(Model& model, const OutputDesc& output, const std::string& name, const FlatUse& use) {
  const FlatResource& resource = model.graph.resources[use.resource];
  std::string expected;
  const std::uint64_t bytes = isImported(resource) ? 0 : outputBytesOf(use, resource);
  if (isImported(resource))
    expected = "a texture or buffer of this graph; imports come from the CPU";
  else if (resource.samples > 1)
    expected = "a texture with one sample per texel";
  else if (bytes > kMaxOutputBytes)
    expected =
        fmt::format("at most {} bytes; of a texture every channel of a texel counts 4", kMaxOutputBytes);
  else
    return true;
  auto& d = model.diagnostics.error(Code::badOutput, output.ref.place,
                                    fmt::format("output '{}' cannot read back '{}'", name, output.ref.text));
  d.resource = model.graph.resourceNames[use.resource];
  d.expected = expected;
  if (bytes > 0) d.found = fmt::format("{} bytes", bytes);
  d.hint = "read back a small level (x.mip[n]) or a buffer that a pass sums up into";
  return false;
}

// A version zero alone is nothing to read back.
bool isWritten(Model& model, const OutputDesc& output, const std::string& name, const FlatUse& use) {
  if (use.history > 0) return true;
  std::uint32_t missing = kNone;
  model.versions.forEachRun(use, [&](std::uint32_t writer, std::uint32_t first, std::uint32_t) {
    if (writer == kNone) missing = first;
    return missing == kNone;
  });
  if (missing == kNone) return true;
  if (output.ref.optional) return false;
  const std::string part = subresourceText(model.graph.resources[use.resource], missing);
  const std::string& resource = model.graph.resourceNames[use.resource];
  auto& d = model.diagnostics.error(Code::nobodyWrites, output.ref.place,
                                    fmt::format("output '{}' reads {}'{}', which no pass writes", name,
                                                part.empty() ? "" : part + " of ", resource));
  d.resource = resource;
  d.found = output.ref.text;
  d.hint = "end the reference with '?' to leave the output out when nothing writes it";
  return false;
}

void resolveOutputs(Model& model) {
  for (Scope& scope : model.scopes)
    for (const OutputDesc& output : scope.desc->outputs) {
      const std::string name = scope.prefix + output.name;
      auto use = resolveFinal(model, scope, output.ref, fmt::format("output '{}'", name), name);
      if (!use || !checkOutput(model, output, name, *use) || !isWritten(model, output, name, *use)) continue;
      use->kind = Kind::copy;
      model.graph.outputs.push_back(*use);
      model.graph.outputNames.push_back(name);
    }
}

// What `entity`, a resource or an input that stands for it, says resets the history.
void addResets(Model& model, const Entity& entity, HistorySpec& spec) {
  Names names(model, *entity.scope);
  for (const Expr& value : entity.desc->resetValues) {
    markStructural(model, *entity.scope, value);
    spec.resetValues.push_back(value.evaluate(names, model.diagnostics));
  }
  for (const RefDesc& ref : entity.desc->resetRefs) {
    markStructural(model, *entity.scope, ref);
    if (ref.mip || ref.layer || ref.face || ref.element || ref.stencil || ref.history || ref.wordsSize > 0 ||
        ref.optional) {
      auto& d = model.diagnostics.error(Code::badSelector, ref.place,
                                        fmt::format("the reset of '{}' names '{}'", entity.name, ref.text));
      d.resource = entity.name;
      d.expected = "the name of a whole resource or import, perhaps with 'if'";
      d.found = ref.text;
      d.hint = fmt::format("write '{}{}'", ref.import ? "@" : "", ref.name);
    }
    const auto holds = evaluateCondition(names, ref.condition, true, "the condition of a reset");
    const std::uint32_t found =
        findEntityOrReport(model, *entity.scope, ref.name, ref.import, ref.place, {"\"reset\""});
    if (found == kNone) continue;
    if (!holds || !*holds) continue;
    // An import that has nothing now may have something later.
    const std::uint32_t target =
        model.entities[found].kind == ResourceDesc::Kind::import ? found : staticTarget(model, found);
    if (target == kNone || !ensureShape(model, target)) continue;
    const Entity& reset = model.entities[target];
    if (reset.import != kNone) {
      spec.resetImports.push_back(reset.import);
    } else {
      for (const Element& element : reset.elements)
        if (element.resource != kNone) spec.resetResources.push_back(element.resource);
    }
  }
}

void resolveHistories(Model& model) {
  FlatGraph& graph = model.graph;
  std::vector<std::uint8_t> read(model.entities.size(), 0);  // a history that nobody reads is none
  for (const Model::HistoryUse& use : model.historyUses) {
    graph.uses[use.use].resource = currentResource(model, use.entity, use.element);
    read[use.entity] = 1;
  }
  for (std::uint32_t index = 0; index < model.entities.size(); ++index) {
    Entity& entity = model.entities[index];
    if (entity.depth == 0 || !read[index] || entity.state != Progress::done) continue;
    HistorySpec spec;
    spec.first = entity.first.type == Value::Type::none ? Value::number(0) : entity.first;
    spec.firstUse = entity.firstUse;
    addResets(model, entity, spec);
    for (const std::uint32_t input : entity.inputs) addResets(model, model.entities[input], spec);
    for (const Element& element : entity.elements) {
      if (element.resource == kNone) continue;  // nobody touches it
      graph.resources[element.resource].history = static_cast<std::uint8_t>(entity.depth);
      spec.resource = element.resource;
      graph.histories.push_back(spec);
    }
  }
}

// What is in the place of an import that is not there: it is shown until the import, once it is there, is published.
void nameStandIns(Model& model) {
  for (const Entity& list : model.entities)
    for (const std::uint32_t candidate : list.candidates) {
      const std::uint32_t import = candidate == kNone ? kNone : model.entities[candidate].import;
      if (import == kNone || model.graph.imports[import].kind != ImportKind::texture) continue;
      for (const std::uint32_t other : list.candidates)
        if (other != kNone && model.entities[other].kind == ResourceDesc::Kind::texture)
          model.graph.imports[import].standIns.push_back(model.entities[other].name);
    }
}

// Names that are no resources and no imports of their own.
void nameAliases(Model& model) {
  for (const Entity& entity : model.entities) {
    if (!entity.desc) continue;
    AliasSpec alias{.name = entity.name, .place = entity.desc->place};
    if (entity.kind == ResourceDesc::Kind::alternatives) {
      for (std::size_t i = 0; i < entity.candidates.size(); ++i) {
        if (entity.candidates[i] == kNone) continue;
        alias.texts.push_back(entity.desc->alternatives[i].text);
        alias.targets.push_back(model.entities[entity.candidates[i]].name);
      }
    } else if (entity.kind == ResourceDesc::Kind::input && entity.bound != kNone) {
      alias.targets.push_back(model.entities[entity.bound].name);
    } else if (entity.kind == ResourceDesc::Kind::import && entity.import != kNone) {
      const std::string& first = model.graph.imports[entity.import].name;
      if (first != entity.name) alias.targets.push_back(first);
    }
    if (!alias.targets.empty()) model.graph.aliases.push_back(std::move(alias));
  }
}

// What contains age().
void foldTimed(Model& model, const std::vector<DeferredUniform>& deferred) {
  const auto ageless = [](std::uint32_t) { return 0.0; };
  for (const DeferredUniform& each : deferred) {
    if (!each.value.expr || !isDynamic(model, *each.scope, *each.value.expr)) continue;
    Names names(model, *each.scope);
    names.indices = each.indices;
    PassSpec& spec = model.graph.specs[each.pass];
    if (each.value.uniform == kNone) {
      spec.timedInstances = each.value.expr->fold(names, model.diagnostics);
      continue;
    }
    UniformSpec& uniform = spec.uniforms[each.value.uniform];
    uniform.dynamic = each.value.expr->fold(names, model.diagnostics);
    uniform.value = uniform.dynamic.evaluateFolded(ageless);
  }
}

// What reads live parameters. One whose expression cannot be folded with them as leaves (it has branches that
// are not taken now and mean nothing now, or it is too long) makes them structural: then it says what it says
// when it is evaluated anew.
void foldLive(Model& model, const std::vector<DeferredUniform>& deferred) {
  std::vector<Value> values;
  values.reserve(model.parameters.size());
  for (const Parameter& parameter : model.parameters) values.push_back(parameter.value);
  findLiveLets(model);
  const auto trialAge = [](std::uint32_t) { return kTrialAge; };
  for (const DeferredUniform& each : deferred) {
    if (each.value.uniform == kNone) continue;
    UniformSpec& uniform = model.graph.specs[each.pass].uniforms[each.value.uniform];
    if (!each.value.expr) {
      if (!model.parameters[each.value.parameter].structural)
        uniform.dynamic = Expr::parameter(each.value.parameter, uniform.place);
      continue;
    }
    const Expr& expr = *each.value.expr;
    if (!isLive(model, *each.scope, expr)) continue;
    Names names(model, *each.scope);
    names.indices = each.indices;
    names.live = true;
    base::Diagnostics ignored;
    const Expr folded = expr.fold(names, ignored);
    // The same as it is without leaves, which was checked.
    const Value before = uniform.dynamic.present() ? uniform.dynamic.evaluateFolded(trialAge) : uniform.value;
    if (folded.live() && !names.failed && folded.evaluateFolded(trialAge, values) == before)
      uniform.dynamic = folded;
    else if (!folded.present() || names.failed || folded.live())
      markStructural(model, *each.scope, expr);
  }
}

// Which uses of a pass stay even when no other pass reads what they write.
void settleKept(FlatGraph& graph) {
  for (std::size_t p = 0; p < graph.passes.size(); ++p) {
    const FlatPass& pass = graph.passes[p];
    const StateSpec& state = graph.specs[p].state;
    // A depth test reads what it writes; so does a shader that modifies an image or a storage block.
    const bool tests = state.depthTest && state.depthCompare != Compare::always;
    FlatUse* raster = nullptr;
    bool stores = false, hasRaster = false;
    for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u) {
      FlatUse& use = graph.uses[u];
      const bool store = isStore(use), attachment = use.kind == Kind::color || use.kind == Kind::depth;
      use.keep = use.access != Access::read && (pass.sideEffect || (store && use.access == Access::modify) ||
                                                (tests && use.kind == Kind::depth));
      stores = stores || store;
      hasRaster = hasRaster || (attachment && (use.keep || use.access == Access::read));
      if (attachment && !raster) raster = &use;
    }
    // A pass may live by what it stores alone: then one attachment says how large its raster is.
    if (stores && raster && !hasRaster) raster->keep = true;
  }
}

// One level and one layer of a texture that glCopyImageSubData can copy as glBlitFramebuffer does. The texture that an import
// gives may be a stand-in of another format.
bool isPlainImage(const FlatUse& use, const FlatResource& r) {
  return use.kind == Kind::copy && use.mips == 1 && use.layers == 1 && r.kind == ResourceKind::texture &&
         (r.target == Target::texture_2d || r.target == Target::texture_2d_array) && r.samples == 1 &&
         !isDepth(r.format) && r.format != Format::srgb8_a8;
}

// Which copies are exact: all uses of the pass are such images, of one format and one size.
void settleCopies(FlatGraph& graph) {
  for (const FlatPass& pass : graph.passes) {
    if (pass.useCount == 0 || !graph.uses[pass.firstUse].exact || graph.resources.empty()) continue;
    const std::span uses(&graph.uses[pass.firstUse], pass.useCount);
    const FlatUse& first = uses.front();
    const FlatResource& r = graph.resources[first.resource];
    const auto fits = [&](const FlatUse& use) {
      const FlatResource& other = graph.resources[use.resource];
      return isPlainImage(use, other) && other.format == r.format &&
             std::max(1u, other.width >> use.mip) == std::max(1u, r.width >> first.mip) &&
             std::max(1u, other.height >> use.mip) == std::max(1u, r.height >> first.mip);
    };
    const bool exact = uses.size() > 1 && std::ranges::all_of(uses, fits);
    for (FlatUse& use : uses) use.exact = exact;
  }
}

}  // namespace

void finishGraph(Model& model, const std::vector<DeferredUniform>& deferred) {
  model.position = static_cast<std::uint32_t>(-1);
  resolvePresent(model);
  resolveOutputs(model);
  foldTimed(model, deferred);
  resolveHistories(model);
  settleKept(model.graph);
  settleCopies(model.graph);
  model.versions.finish();
  inferComparisons(model);
  nameStandIns(model);
  nameAliases(model);
  if (!model.diagnostics.hasErrors()) {
    const base::Diagnostics said = model.diagnostics;
    foldLive(model, deferred);
    model.diagnostics = said;
  }
  model.graph.parameters.reserve(model.parameters.size());
  for (const Parameter& parameter : model.parameters)
    model.graph.parameters.push_back({*parameter.desc, parameter.path, parameter.value, parameter.origin,
                                      parameter.valuePlace, parameter.structural});
  model.graph.files = model.desc.files;
  model.graph.name = model.desc.name;
  model.graph.screenWidth = model.settings.screenWidth;
  model.graph.screenHeight = model.settings.screenHeight;
}

}  // namespace weft::graph::expansion
