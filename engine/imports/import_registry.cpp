#include "engine/imports/import_registry.h"

#include <cassert>

#include "engine/imports/builtin.h"

namespace weft::imports {

ImportRegistry ImportRegistry::builtin() {
  ImportRegistry registry;
  for (const auto make : {makeEnvironment, makeSpheres, makeDrawOrder, makeSilhouettes, makeMeshes,
                          makeMaterials, makeMaterialMaps, makeJoints, makeVertexColors, makeSun, makeLamps,
                          makeGround, makeCamera, makeCubeLut, makeImage, makeCut, makeMouse, makeProbes})
    registry.add(make());
  return registry;
}

void ImportRegistry::add(std::unique_ptr<Import> import) {
  std::string name = import->reflect().name;
  assert(!find(name) && "an import of this name is already registered");
  imports_.push_back({std::move(name), std::move(import)});
}

const Import* ImportRegistry::find(std::string_view name) const {
  for (const Entry& each : imports_)
    if (each.name == name) return each.import.get();
  return nullptr;
}

std::vector<graph::ImportType> ImportRegistry::reflect() const {
  std::vector<graph::ImportType> all;
  for (const Entry& each : imports_) all.push_back(each.import->reflect());
  return all;
}

}  // namespace weft::imports
