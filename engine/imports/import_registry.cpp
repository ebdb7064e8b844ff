#include "engine/imports/import_registry.h"

#include "engine/imports/builtin.h"

namespace weft::imports {

ImportRegistry ImportRegistry::builtin() {
  ImportRegistry registry;
  addTables(registry);
  for (const auto make : {makeEnvironment, makeDrawList, makeDrawOrder, makeSilhouettes, makeMaterialMaps,
                          makeSun, makeLamps, makeCamera, makeCubeLut, makeImage, makeCut, makeMouse})
    registry.add(make());
  return registry;
}

}  // namespace weft::imports
