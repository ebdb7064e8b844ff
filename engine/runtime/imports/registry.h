// What graphs may name: pass types and imports, of plug-ins that an embedder may add to, and the draw lists of a world. No GL
// context is needed, so a graph is checked on a machine that has none.
#pragma once

#include <memory>

#include "engine/graph/registry.h"
#include "engine/imports/import_registry.h"
#include "engine/passes/pass_registry.h"

namespace weft::runtime {

// Never null.
struct PlugIns {
  std::shared_ptr<const passes::PassRegistry> passTypes =
      std::make_shared<const passes::PassRegistry>(passes::PassRegistry::builtin());
  std::shared_ptr<const imports::ImportRegistry> imports =
      std::make_shared<const imports::ImportRegistry>(imports::ImportRegistry::builtin());
};

// `files` keeps what imports were read from, and must outlive the registry; without, it is read whenever it is asked for.
graph::Registry makeRegistry(const PlugIns& plugIns, const imports::WorldFacts& facts,
                             imports::Files* files = nullptr);
// The same of another world, in a registry that was made for these plug-ins. They cannot change, and many words say what
// they are.
void changeWorld(graph::Registry& registry, const PlugIns& plugIns, const imports::WorldFacts& facts,
                 imports::Files* files = nullptr);

}  // namespace weft::runtime
