#include "engine/passes/pass_registry.h"

#include <cassert>

#include "engine/passes/blit/blit.h"
#include "engine/passes/compute/compute.h"
#include "engine/passes/draw/draw.h"
#include "engine/passes/fullscreen/fullscreen.h"
#include "engine/passes/mipmap/mipmap.h"

namespace weft::passes {

PassRegistry PassRegistry::builtin() {
  PassRegistry registry;
  registry.add(std::make_unique<Fullscreen>());
  registry.add(std::make_unique<Compute>());
  registry.add(std::make_unique<Draw>());
  registry.add(std::make_unique<Blit>());
  registry.add(std::make_unique<Mipmap>());
  return registry;
}

void PassRegistry::add(std::unique_ptr<PassType> type) {
  std::string name = type->reflect().name;
  assert(!find(name) && "a pass type of this name is already registered");
  types_.push_back({std::move(name), std::move(type)});
}

const PassType* PassRegistry::find(std::string_view name) const {
  for (const Entry& each : types_)
    if (each.name == name) return each.type.get();
  return nullptr;
}

std::vector<graph::PassType> PassRegistry::reflect() const {
  std::vector<graph::PassType> all;
  for (const Entry& each : types_) all.push_back(each.type->reflect());
  return all;
}

}  // namespace weft::passes
