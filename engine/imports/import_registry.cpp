#include "engine/imports/import_registry.h"

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

}  // namespace weft::imports
