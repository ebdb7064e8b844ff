#include "engine/runtime/imports/registry.h"

#include "engine/imports/files.h"
#include "engine/passes/draw/geometry.h"

namespace weft::runtime {

graph::Registry makeRegistry(const PlugIns& plugIns, const imports::WorldFacts& facts,
                             imports::Files* files) {
  graph::Registry registry;
  registry.passTypes = plugIns.passTypes->reflect();
  registry.imports = plugIns.imports->reflect();
  registry.geometries = passes::reflectGeometries();
  changeWorld(registry, plugIns, facts, files);
  return registry;
}

void changeWorld(graph::Registry& registry, const PlugIns& plugIns, const imports::WorldFacts& facts,
                 imports::Files* files) {
  registry.drawLists.clear();
  for (const imports::WorldFacts::List& list : facts.lists) registry.drawLists.push_back(list.name);
  registry.things.clear();
  for (const auto& [mask, count] : facts.unusual) {
    graph::Registry::Things& things = registry.things.emplace_back();
    things.count = count;
    for (std::size_t i = 0; i < facts.lists.size(); ++i)
      if ((mask >> i & 1u) != 0) things.lists.push_back(facts.lists[i].name);
  }
  registry.factsOf = [imports = plugIns.imports, facts, files](const graph::ImportRequest& request) {
    imports::Files once;
    return imports->find(request.type)->facts(request, facts, files ? *files : once);
  };
}

}  // namespace weft::runtime
