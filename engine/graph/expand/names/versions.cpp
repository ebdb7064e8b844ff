// Declared in names.h.
#include <fmt/format.h>

#include <algorithm>

#include "engine/graph/expand/names/names.h"
#include "engine/graph/subresource.h"

namespace weft::graph::expansion {

namespace {

std::string flatName(const Entity& entity, std::uint32_t element, std::uint32_t count) {
  std::string name = entity.name;
  if (entity.arrayCount > 0) name += fmt::format("[{}]", element);
  if (count > 1) name += fmt::format("#{}", count);
  return name;
}

std::uint32_t addResource(Model& model, std::uint32_t index, std::uint32_t element, bool covers = true) {
  Entity& entity = model.entities[index];
  Element& e = entity.elements[element];
  const auto resource = static_cast<std::uint32_t>(model.graph.resources.size());
  ++e.count;
  model.graph.resources.push_back(entity.shape);
  model.elementOf.push_back({index, element});
  model.graph.resourceNames.push_back(flatName(entity, element, e.count));
  model.graph.resourcePlaces.push_back(entity.desc ? entity.desc->place : Place{});
  // Only the first FlatResource has a version zero; the others begin with a write, which mostly covers them.
  if (e.count > 1 && covers) model.graph.resources.back().hasClear = false;
  if (model.graph.resources.back().hasClear) model.graph.clears.push_back({resource, entity.clear});
  e.resource = resource;
  return resource;
}

}  // namespace

std::uint32_t currentResource(Model& model, std::uint32_t index, std::uint32_t element) {
  Entity& entity = model.entities[index];
  if (entity.kind == ResourceDesc::Kind::import) {
    const std::uint32_t import = entity.import + element;
    if (model.importResource[import] == kNone) {
      const std::uint32_t resource = addResource(model, index, element);
      model.graph.resources[resource].import = import;
      model.importResource[import] = resource;
    }
    return model.importResource[import];
  }
  const std::uint32_t current = entity.elements[element].resource;
  return current != kNone ? current : addResource(model, index, element);
}

VersionCheck checkVersion(const Model& model, std::uint32_t index, std::uint32_t element,
                          const FlatUse& rect) {
  const Entity& entity = model.entities[index];
  if (entity.kind == ResourceDesc::Kind::import) return {entity.exists || entity.fallback, entity.exists, 0};
  VersionCheck check;
  const auto see = [&](std::uint32_t writer, std::uint32_t first) {
    if (writer != kNone) {
      check.real = true;
    } else if (!entity.shape.hasClear) {
      check.complete = false;
      check.missing = first;
    }
    return check.complete;
  };
  FlatUse use = rect;
  use.resource = entity.elements[element].resource;
  if (use.resource != kNone)
    model.versions.forEachRun(
        use, [&](std::uint32_t writer, std::uint32_t first, std::uint32_t) { return see(writer, first); });
  else
    forEachSubresource(use, entity.shape, [&](std::uint32_t first) {
      see(kNone, first);
      return false;
    });
  return check;
}

void addUse(Model& model, std::uint32_t index, std::uint32_t element, const FlatUse& use,
            std::uint32_t pass) {
  Entity& entity = model.entities[index];
  VersionLinks& links = model.graph.links;
  const auto at = static_cast<std::uint32_t>(model.graph.uses.size());
  model.graph.uses.push_back(use);
  const bool sees = use.history == 0 && use.access != Access::write;
  if (use.history > 0) model.historyUses.push_back({at, index, element});
  if (sees) model.graph.uses[at].resource = currentResource(model, index, element);
  model.versions.see(at, pass);
  if (!sees || entity.kind == ResourceDesc::Kind::import) return;
  links.forEachRun(links.seen[at], [&](std::uint32_t writer, std::uint32_t) {
    if (writer == kNone) entity.elements[element].zeroUsed = true;
  });
}

std::uint32_t resourceToWrite(Model& model, std::uint32_t index, std::uint32_t element, bool whole,
                              bool covers) {
  Element& e = model.entities[index].elements[element];
  const bool used = e.zeroUsed || (e.resource != kNone && model.versions.isWritten(e.resource));
  if (!whole || !used) return currentResource(model, index, element);
  const std::uint32_t last = e.resource, next = addResource(model, index, element, covers);
  e.zeroUsed = false;
  if (last != kNone) model.versions.replace(last, next);
  return next;
}

void wouldUse(Model& model, WouldUse use) {
  if (use.entity != kNone && model.entities[use.entity].kind == ResourceDesc::Kind::import) return;
  use.position = model.position;
  use.slot = model.slot;
  model.would.push_back(use);
}

void wouldUse(Model& model, std::uint32_t index, Access access, int history) {
  const Entity& entity = model.entities[index];
  for (std::size_t i = 0; i < entity.candidates.size(); ++i)
    if (entity.candidates[i] != kNone)
      wouldUse(model, entity.candidates[i], access, history + entity.desc->alternatives[i].history);
  const bool own = entity.kind == ResourceDesc::Kind::texture || entity.kind == ResourceDesc::Kind::buffer;
  if (!own || entity.state != Progress::done) return;
  FlatUse whole = wholeUse(0, entity.shape, Kind::copy, access);
  whole.history = static_cast<std::uint8_t>(history);
  wouldUse(model, {.entity = index, .elementCount = std::max(1u, entity.arrayCount), .rect = whole});
}

}  // namespace weft::graph::expansion
