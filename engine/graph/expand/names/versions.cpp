#include "engine/graph/expand/names/versions.h"

#include <fmt/format.h>

#include "engine/graph/expand/names/resources.h"

namespace weft::graph::expansion {

namespace {

// Calls f(index) for the sub-resources of `rect` until it returns false.
template <class F>
void forEachSub(const FlatResource& shape, const FlatUse& rect, F f) {
  const std::uint32_t planes = planeCount(shape);
  for (std::uint32_t plane = 0; plane < planes; ++plane) {
    if ((rect.planes >> plane & 1) == 0) continue;
    for (std::uint32_t layer = rect.layer; layer < rect.layer + rect.layers; ++layer)
      for (std::uint32_t mip = rect.mip; mip < static_cast<std::uint32_t>(rect.mip + rect.mips); ++mip)
        if (!f((plane * shape.layers + layer) * shape.mips + mip)) return;
  }
}

std::string flatName(const Entity& entity, std::uint32_t element, std::uint32_t count) {
  std::string name = entity.name;
  if (entity.arrayCount > 0) name += fmt::format("[{}]", element);
  if (count > 1) name += fmt::format("#{}", count);
  return name;
}

std::uint32_t addResource(Model& model, std::uint32_t index, std::uint32_t element) {
  Entity& entity = model.entities[index];
  Element& e = entity.elements[element];
  const auto resource = static_cast<std::uint32_t>(model.graph.resources.size());
  ++e.count;
  model.graph.resources.push_back(entity.shape);
  model.graph.resourceNames.push_back(flatName(entity, element, e.count));
  model.graph.resourcePlaces.push_back(entity.desc ? entity.desc->place : Place{});
  // Only the first FlatResource has a version zero; the others begin with a write that covers them.
  if (e.count > 1) model.graph.resources.back().hasClear = false;
  if (model.graph.resources.back().hasClear) model.graph.clears.push_back({resource, entity.clear});
  e.resource = resource;
  return resource;
}

}  // namespace

std::uint32_t currentResource(Model& model, std::uint32_t index, std::uint32_t element) {
  Entity& entity = model.entities[index];
  if (entity.kind == ResourceDesc::Kind::import) {
    std::uint32_t& shared = model.importResource[entity.import];
    if (shared == kNone) shared = addResource(model, index, 0);
    return shared;
  }
  const std::uint32_t current = entity.elements[element].resource;
  return current != kNone ? current : addResource(model, index, element);
}

VersionCheck checkVersion(const Entity& entity, std::uint32_t element, const FlatUse& rect) {
  if (entity.kind == ResourceDesc::Kind::import) return {entity.exists || entity.fallback, entity.exists, 0};
  const Element& e = entity.elements[element];
  if (e.writers.empty()) {
    const bool written = e.wholeWriter != kNone;
    VersionCheck check{written || entity.shape.hasClear, written, 0};
    if (!check.complete)
      forEachSub(entity.shape, rect, [&](std::uint32_t sub) {
        check.missing = sub;
        return false;
      });
    return check;
  }
  VersionCheck check;
  forEachSub(entity.shape, rect, [&](std::uint32_t sub) {
    if (e.writers[sub] != kNone) {
      check.real = true;
    } else if (!entity.shape.hasClear) {
      check.complete = false;
      check.missing = sub;
      return false;
    }
    return true;
  });
  return check;
}

void collectWriters(Entity& entity, std::uint32_t element, const FlatUse& rect,
                    std::vector<std::uint32_t>& out) {
  if (entity.kind == ResourceDesc::Kind::import) return;
  Element& e = entity.elements[element];
  if (e.writers.empty()) {
    if (e.wholeWriter != kNone)
      out.push_back(e.wholeWriter);
    else
      e.zeroUsed = true;
    return;
  }
  std::uint32_t last = kNone;
  forEachSub(entity.shape, rect, [&](std::uint32_t sub) {
    const std::uint32_t writer = e.writers[sub];
    if (writer == kNone) e.zeroUsed = true;
    if (writer != kNone && writer != last) out.push_back(writer);
    last = writer;
    return true;
  });
}

std::uint32_t resourceToWrite(Model& model, std::uint32_t index, std::uint32_t element, bool whole) {
  Element& e = model.entities[index].elements[element];
  const bool used = e.zeroUsed || e.wholeWriter != kNone || e.written > 0;
  if (!whole || !used) return currentResource(model, index, element);
  e.writers.clear();
  e.wholeWriter = kNone;
  e.written = 0;
  e.zeroUsed = false;
  return addResource(model, index, element);
}

void setWriter(Entity& entity, std::uint32_t element, const FlatUse& rect, std::uint32_t use, bool whole) {
  Element& e = entity.elements[element];
  const std::uint32_t total = subresourceCount(entity.shape);
  if (whole || total == 1) {
    e.writers.clear();
    e.wholeWriter = use;
    e.written = total;
    return;
  }
  if (e.writers.empty()) e.writers.assign(total, e.wholeWriter);
  forEachSub(entity.shape, rect, [&](std::uint32_t sub) {
    if (e.writers[sub] == kNone) ++e.written;
    e.writers[sub] = use;
    return true;
  });
  e.wholeWriter = kNone;
}

std::string subresourceText(const FlatResource& shape, std::uint32_t index) {
  std::string text;
  const auto part = [&](const char* word, std::uint32_t n) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", word, n);
  };
  if (shape.mips > 1) part("mip", index % shape.mips);
  const std::uint32_t layer = index / shape.mips % shape.layers;
  const bool cube = shape.target == Target::texture_cube || shape.target == Target::texture_cube_array;
  if (shape.target == Target::texture_2d_array || shape.target == Target::texture_cube_array)
    part("layer", cube ? layer / 6 : layer);
  if (cube) part("face", layer % 6);
  if (planeCount(shape) > 1 && index / shape.mips / shape.layers == 1)
    text += text.empty() ? "stencil" : ", stencil";
  return text;
}

}  // namespace weft::graph::expansion
