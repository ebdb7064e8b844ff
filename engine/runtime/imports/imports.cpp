#include "engine/runtime/imports/imports.h"

#include <algorithm>
#include <cassert>

namespace weft::runtime {

Imports::Held& Imports::hold(const graph::ImportRequest& request, std::uint64_t key) {
  const imports::Import* import = registry_->find(request.type);
  assert(import && "expansion accepts registered imports only");
  return held_.emplace_back(Held{.key = key, .provider = import->provide(request)});
}

void Imports::prepare(const graph::FlatGraph& graph) {
  std::erase_if(held_, [](Held& each) { return !each.provider->renew(each.used); });
  for (Held& each : held_) each.used = false;
  for (const graph::ImportSpec& import : graph.imports) of(import);
}

void Imports::beginFrame(const World& world, const FrameInput& input) {
  world_ = &world;
  input_ = input;
  ++frames_;
  tables_.beginFrame(world, input_, frames_);
}

const scene::ViewData& Imports::view(const graph::FlatGraph& graph, const graph::PassSpec& spec,
                                     std::uint32_t width, std::uint32_t height) {
  if (spec.view == graph::kNone) return camera_.view(frame(), {spec.screen[0], spec.screen[1]});
  const graph::ImportSpec& import = graph.imports[spec.view];
  imports::ViewPart part{spec.screen[0], spec.screen[1], spec.viewLayer, spec.viewFace};
  if (import.kind != graph::ImportKind::view) {
    part.width = width;
    part.height = height;
  }
  return of(import).view(frame(), part);
}

bool Imports::isPending(const graph::FlatGraph& graph, const World& world) {
  for (std::uint32_t i = 0; i < graph.imports.size(); ++i) {
    const graph::ImportSpec& import = graph.imports[i];
    // Nobody reads a texture for which a list of alternatives has something else.
    if (import.kind == graph::ImportKind::texture &&
        std::ranges::find(graph.resources, i, &graph::FlatResource::import) == graph.resources.end())
      continue;
    if (heldOf(import).provider->isPending(world)) return true;
  }
  return false;
}

}  // namespace weft::runtime
