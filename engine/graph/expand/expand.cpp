#include "engine/graph/expand/expand.h"

#include <algorithm>

#include "engine/base/json/dom.h"
#include "engine/graph/expand/finish.h"
#include "engine/graph/expand/judge/judge.h"
#include "engine/graph/expand/names/apply_settings.h"
#include "engine/graph/expand/names/resources.h"
#include "engine/graph/expand/names/scope.h"
#include "engine/graph/expand/names/unread.h"
#include "engine/graph/expand/passes.h"
#include "engine/graph/language/enough.h"
#include "engine/graph/pick/pick.h"

namespace weft::graph {

std::shared_ptr<const FlatGraph> expandGraph(const GraphDesc& desc, const Registry& registry,
                                             const Settings& settings, base::Diagnostics& diagnostics) {
  using namespace expansion;
  // Of a file beyond a limit not all was read.
  if (enoughErrors(diagnostics) || diagnostics.contains(base::Code::limitExceeded)) return nullptr;
  base::Diagnostics own;
  Model model{desc, registry, settings, own};
  model.incomplete = diagnostics.hasErrors();  // of the reader
  buildScopes(model);
  if (!isOver(model)) applySettings(model);
  for (std::uint32_t i = 0; i < model.entities.size() && !isOver(model); ++i) {
    const auto kind = model.entities[i].kind;
    // An import's arguments are checked here; so is an input of the root, which nobody may read.
    if (kind == ResourceDesc::Kind::input)
      findEntity(model, *model.entities[i].scope, model.entities[i].desc->name, false);
    else if (kind != ResourceDesc::Kind::alternatives)
      ensureShape(model, i);
  }
  takeInputHistories(model);
  std::vector<DeferredUniform> deferred;
  if (!isOver(model)) expandPasses(model, deferred);
  if (!isOver(model)) finishGraph(model, deferred);
  if (!own.hasErrors() && !model.incomplete) keepPicks(model.graph, settings.kept, own);
  if (!isOver(model)) reportMissingReads(model);
  reportUnincluded(model);
  if (!own.hasErrors()) checkSlices(model);
  if (!own.hasErrors() && !diagnostics.hasErrors()) {
    warnUnread(model);
    warnUnused(model);
    warnCadence(model);
  }
  for (const auto& [path, text] : desc.texts) base::PointerScope(path, *text, own);
  own.sortByPlace();
  diagnostics.append(own);
  if (diagnostics.hasErrors()) return nullptr;
  return std::make_shared<const FlatGraph>(std::move(model.graph));
}

std::vector<Refusal> findRefused(const GraphDesc& desc, const Registry& registry, const Settings& settings) {
  base::Diagnostics said;
  expansion::Model model{desc, registry, settings, said};
  std::vector<Refusal> refused;
  expansion::buildScopes(model);
  if (model.stopped) return refused;
  const auto note = [&](bool disable, std::size_t index) {
    const auto error = std::ranges::find(said.items(), base::Severity::error, &base::Diagnostic::severity);
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
