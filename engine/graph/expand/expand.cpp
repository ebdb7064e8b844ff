#include "engine/graph/expand/expand.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "engine/graph/expand/judge/judge.h"
#include "engine/graph/expand/passes.h"
#include "engine/graph/pick/pick.h"
#include "engine/graph/subresource.h"
#include "engine/text/json/report.h"
#include "graph_sentences.h"

namespace weft::graph {

namespace expansion {

namespace {

// A reference at the top of a file, resolved as a read after the last pass. nullopt when there is nothing.
std::optional<FlatUse> resolveFinal(Model& model, Scope& scope, const RefDesc& ref, const std::string& user,
                                    const std::string& name) {
  Names names(model, scope);
  const SlotDesc slot{SlotHead{name, ref.place, Access::read}, ref};
  const SlotContext context{model, names, nullptr, user, {}};
  const SlotWork work = ref.wordsSize > 0 ? SlotWork() : resolveSlot(context, slot, kNone);
  if (work.array || ref.wordsSize > 0)
    context.report(say::finalIsMoreThanName, ref.place, ref.text, ref.name);
  if (work.array || !work.isConnected()) return std::nullopt;
  FlatUse use = work.use;
  use.kind = Kind::copy;
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
  if (!ref.mip || !ref.mip->range) use->mips = 1;  // a span is kept whole; what is shown is its first level
  use->layers = 1;
  model.graph.present = *use;  // also what cannot be shown: its writers are no mistake
  const FlatResource& resource = model.graph.resources[use->resource];
  if (model.diagnostics.errorCount() == before &&
      (isBuffer(resource) || isDepth(resource.format) || use->history > 0 || resource.samples > 1 ||
       resource.target == Target::texture_3d))
    report(model, say::presentsNoColor, ref.place, ref.text);
}

void resolveOutputs(Model& model) {
  for (Scope& scope : model.scopes)
    for (const OutputDesc& output : scope.desc->outputs) {
      const std::string name = scope.prefix + output.name;
      const RefDesc& ref = output.ref;
      const auto use = resolveFinal(model, scope, ref, fmt::format("output '{}'", name), name);
      if (!use) continue;
      // What the runtime can bring to the CPU every frame.
      const FlatResource& resource = model.graph.resources[use->resource];
      const std::uint64_t bytes = isImported(resource) ? 0 : outputBytesOf(*use, resource);
      if (isImported(resource) || resource.samples != 1 || bytes > kMaxOutputBytes) {
        report(model, say::cannotReadBack, ref.place, name, ref.text, kMaxOutputBytes,
               bytes > 0 ? fmt::format("{} bytes", bytes) : "");
        continue;
      }
      // A version zero alone is nothing to read back.
      std::uint32_t missing = kNone;
      if (use->history == 0)
        model.versions.forEachRun(*use, [&](std::uint32_t writer, std::uint32_t first, std::uint32_t) {
          if (writer == kNone) missing = first;
          return missing == kNone;
        });
      if (missing == kNone) {
        model.graph.outputs.push_back(*use);
        model.graph.outputNames.push_back(name);
      } else if (!ref.optional) {
        const Model::ElementOf& element = model.elementOf[use->resource];
        model.missing.push_back({.position = model.position,
                                 .slot = name,
                                 .ref = ref,
                                 .wanted = {{element.entity, element.element, missing, *use}}});
      }
    }
}

// What `entity`, a resource or an input that stands for it, says resets the history.
void addResets(Model& model, const Entity& entity, HistorySpec& spec) {
  Names names(model, *entity.scope);
  for (const Expr& value : entity.desc->resetValues)
    spec.resetValues.push_back(value.evaluate(names, model.diagnostics));
  for (const RefDesc& ref : entity.desc->resetRefs) {
    if (!isWhole(ref))
      report(model, say::resetNotWhole, ref.place, entity.name, ref.text, ref.import ? "@" : "", ref.name);
    const std::uint32_t found = findEntityOrReport(model, *entity.scope, ref, "\"reset\"", "names");
    if (found == kNone) continue;
    // An import that has nothing now may have something later.
    const std::uint32_t target =
        model.entities[found].kind == ResourceDesc::Kind::import ? found : staticTarget(model, found);
    if (target == kNone || !ensureShape(model, target)) continue;
    const Entity& reset = model.entities[target];
    if (reset.import != kNone) spec.resetImports.push_back(reset.import);
    for (const Element& element : reset.elements)
      if (reset.import == kNone && element.resource != kNone) spec.resetResources.push_back(element.resource);
  }
}

void resolveHistories(Model& model) {
  FlatGraph& graph = model.graph;
  std::vector<std::uint8_t> read(model.entities.size(), 0);  // a history that nobody reads is none
  for (const auto& [use, entity, element] : model.historyUses) {
    graph.uses[use].resource = currentResource(model, entity, element);
    read[entity] = 1;
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

// Names that are no resources and no imports of their own; and what is in the place of an import that is not there: it is shown
// until the import, once it is there, is published.
void nameAliases(Model& model) {
  for (const Entity& entity : model.entities) {
    if (!entity.desc) continue;
    AliasSpec alias{.name = entity.name, .place = entity.desc->place};
    for (std::size_t i = 0; i < entity.candidates.size(); ++i) {
      if (entity.candidates[i] == kNone) continue;
      const Entity& candidate = model.entities[entity.candidates[i]];
      alias.texts.push_back(entity.desc->alternatives[i].text);
      alias.targets.push_back(candidate.name);
      if (candidate.import == kNone || model.graph.imports[candidate.import].kind != ImportKind::texture)
        continue;
      for (const std::uint32_t other : entity.candidates)
        if (other != kNone && model.entities[other].kind == ResourceDesc::Kind::texture)
          model.graph.imports[candidate.import].standIns.push_back(model.entities[other].name);
    }
    if (entity.kind == ResourceDesc::Kind::input && entity.bound != kNone)
      alias.targets.push_back(model.entities[entity.bound].name);
    if (entity.import != kNone && model.graph.imports[entity.import].name != entity.name)
      alias.targets.push_back(model.graph.imports[entity.import].name);
    if (!alias.targets.empty()) model.graph.aliases.push_back(std::move(alias));
  }
}

// Folds what contains age() or live parameters.
void foldDeferred(Model& model, const std::vector<DeferredUniform>& deferred) {
  const auto ageless = [](std::uint32_t) { return 0.0; };
  const auto trialAge = [](std::uint32_t) { return kTrialAge; };
  const auto fold = [&](const DeferredUniform& each, Names names, text::Diagnostics& said) {
    names.indices = each.indices;
    names.follows = each.uniform != kNone;
    const Expr folded = each.expr->fold(names, said);
    return names.failed ? Expr() : folded;
  };
  for (const DeferredUniform& each : deferred) {
    if (!isDynamic(model, *each.scope, *each.expr)) continue;
    const Expr folded = fold(each, Names(model, *each.scope), model.diagnostics);
    PassSpec& spec = model.graph.specs[each.pass];
    (each.uniform == kNone ? spec.timedInstances : spec.uniforms[each.uniform].dynamic) = folded;
    if (each.uniform != kNone) spec.uniforms[each.uniform].value = folded.evaluateFolded(ageless);
  }
  if (model.diagnostics.hasErrors()) return;
  // An expression that cannot be folded with live parameters as leaves (it has branches that are not taken now and mean
  // nothing now, or it is too long) makes them structural: then it says what it says when it is evaluated anew.
  std::vector<Value> values;
  for (const Parameter& parameter : model.parameters) values.push_back(parameter.value);
  const text::Diagnostics said = model.diagnostics;
  text::Diagnostics unfollowed;  // what keeps values of imports from being followed
  for (const DeferredUniform& each : deferred) {
    const bool watched = isWatched(model, *each.scope, *each.expr);
    if (each.uniform == kNone || (!watched && !isLive(model, *each.scope, *each.expr))) continue;
    UniformSpec& uniform = model.graph.specs[each.pass].uniforms[each.uniform];
    Names names(model, *each.scope);
    names.live = true;
    text::Diagnostics ignored;
    Expr folded = fold(each, names, ignored);
    if (watched && !folded.present()) {  // parameters become numbers; the values of imports cannot
      markStructural(model, *each.scope, *each.expr);
      folded = fold(each, names, unfollowed);
    }
    for (std::size_t i = values.size() - model.parameters.size(); i < model.graph.watched.size(); ++i)
      values.push_back(model.graph.watched[i].shape);
    // The same as it is without leaves, which was checked.
    const Value before = uniform.dynamic.present() ? uniform.dynamic.evaluateFolded(trialAge) : uniform.value;
    if (folded.present() && folded.live() && folded.evaluateFolded(trialAge, values) == before)
      uniform.dynamic = folded;
    else if (folded.present() && !folded.live())
      continue;  // it needs none of them now
    else if (!watched)
      markStructural(model, *each.scope, *each.expr);
    else if (!unfollowed.hasErrors())
      unfollowed.error(say::cannotFollowImports, each.expr->place());
  }
  model.diagnostics = said;  // what cannot be folded is no mistake
  model.diagnostics.append(unfollowed);
  model.stopped = false;
}

// Which uses of a pass stay even when no other pass reads what they write.
void settleKept(FlatGraph& graph) {
  for (std::size_t p = 0; p < graph.passes.size(); ++p) {
    const FlatPass& pass = graph.passes[p];
    const StateSpec& state = graph.specs[p].state;
    // A depth or stencil test reads what it writes; so does a shader that modifies an image or a storage block.
    const bool tests = (state.depthTest && state.depthCompare != Compare::always) || state.stencil;
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

// Everything that looks at the versions after the last pass: present, outputs, histories and their resets, age().
void finishGraph(Model& model, const std::vector<DeferredUniform>& deferred) {
  model.position = static_cast<std::uint32_t>(-1);
  resolvePresent(model);
  resolveOutputs(model);
  foldDeferred(model, deferred);
  resolveHistories(model);
  settleKept(model.graph);
  model.versions.finish();
  inferComparisons(model);
  nameAliases(model);
  for (const Parameter& parameter : model.parameters)
    model.graph.parameters.push_back({parameter, *parameter.desc});
  model.graph.files = model.desc.files;
  model.graph.name = model.desc.name;
  model.graph.screenWidth = model.settings.screenWidth;
  model.graph.screenHeight = model.settings.screenHeight;
}

}  // namespace

}  // namespace expansion

std::shared_ptr<const FlatGraph> expandGraph(const GraphDesc& desc, const Registry& registry,
                                             const Settings& settings, text::Diagnostics& diagnostics) {
  using namespace expansion;
  // Of a file beyond a limit not all was read.
  if (enoughErrors(diagnostics) || diagnostics.contains(text::Code::limitExceeded)) return nullptr;
  text::Diagnostics own;
  Model model{desc, registry, settings, own};
  model.incomplete = diagnostics.hasErrors();  // of the reader
  buildScopes(model);
  if (!isOver(model)) applySettings(model);
  for (std::uint32_t i = 0; i < model.entities.size() && !isOver(model); ++i) {
    const auto kind = model.entities[i].kind;
    // An import's arguments are checked here; so is an input of the root, which nobody may read.
    if (kind == ResourceDesc::Kind::input)
      findEntity(model, *model.entities[i].scope, model.entities[i].desc->name, false);
    else if (model.entities[i].desc && kind != ResourceDesc::Kind::alternatives)
      ensureShape(model, i);
  }
  takeInputHistories(model);
  std::vector<DeferredUniform> deferred;
  const bool whole = !diagnostics.hasErrors() && !own.hasErrors();
  if (!isOver(model)) expandPasses(model, deferred);
  if (!isOver(model)) finishGraph(model, deferred);
  const auto isSound = [&] { return !diagnostics.hasErrors() && !own.hasErrors(); };
  if (isSound()) keepPicks(model.graph, settings.kept, own);
  if (whole && !isOver(model) && !model.leftOut.contains(kNone)) reportMissingReads(model);
  if (isSound()) checkSlices(model);
  if (isSound()) {
    warnUnread(model);
    warnUnused(model);
    warnCadence(model);
  }
  own.sortByPlace();
  diagnostics.append(own);
  if (diagnostics.hasErrors()) return nullptr;
  return std::make_shared<const FlatGraph>(std::move(model.graph));
}

std::vector<Refusal> findRefused(const GraphDesc& desc, const Registry& registry, const Settings& settings) {
  text::Diagnostics said;
  expansion::Model model{desc, registry, settings, said};
  std::vector<Refusal> refused;
  expansion::buildScopes(model);
  if (model.stopped) return refused;
  const auto note = [&](bool disable, std::size_t index) {
    const auto error = std::ranges::find(said.items(), text::Severity::error, &text::Diagnostic::severity);
    if (error != said.items().end()) refused.push_back({disable, index, *error});
    said.clear();
  };
  said.clear();
  for (std::size_t i = 0; i < settings.sets.size(); ++i) {
    expansion::applySetting(model, settings.sets[i]);
    note(false, i);
  }
  for (std::size_t i = 0; i < settings.disables.size(); ++i) {
    expansion::applyDisable(model, settings.disables[i]);
    note(true, i);
  }
  return refused;
}

}  // namespace weft::graph
