#include "engine/runtime/imports/registry.h"

#include <algorithm>
#include <map>
#include <type_traits>

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
  registry.drawLists = scene::drawListNames();
  registry.things.clear();
  std::map<std::uint8_t, std::uint64_t> unusual;  // by their lists
  const auto look = [&](const auto& row) {
    if (row.lists != 0 && row.lists != std::remove_cvref_t<decltype(row)>{}.lists) ++unusual[row.lists];
  };
  if (const scene::Scene* scene = facts.things.get()) {
    std::ranges::for_each(scene->spheres.rows(), look);
    std::ranges::for_each(scene->meshInstances.rows(), look);
  }
  for (const auto& [mask, count] : unusual) {
    graph::Registry::Things& things = registry.things.emplace_back();
    things.count = count;
    for (std::size_t i = 0; i < registry.drawLists.size(); ++i)
      if ((mask >> i & 1u) != 0) things.lists.push_back(registry.drawLists[i]);
  }
  registry.factsOf = [imports = plugIns.imports, facts, files](const graph::ImportRequest& request) {
    imports::Files once;
    return imports->find(request.type)->facts(request, facts, files ? *files : once);
  };
}

}  // namespace weft::runtime
