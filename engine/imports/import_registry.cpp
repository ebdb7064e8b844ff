#include "engine/imports/import_registry.h"

#include <cassert>

#include "engine/imports/camera/camera.h"
#include "engine/imports/cube_lut/cube_lut.h"
#include "engine/imports/cut/cut.h"
#include "engine/imports/draw_order/draw_order.h"
#include "engine/imports/environment/environment.h"
#include "engine/imports/ground/ground.h"
#include "engine/imports/image/image.h"
#include "engine/imports/joints/joints.h"
#include "engine/imports/lamps/lamps.h"
#include "engine/imports/material_maps/material_maps.h"
#include "engine/imports/materials/materials.h"
#include "engine/imports/meshes/meshes.h"
#include "engine/imports/mouse/mouse.h"
#include "engine/imports/probes/probes.h"
#include "engine/imports/silhouettes/silhouettes.h"
#include "engine/imports/spheres/spheres.h"
#include "engine/imports/sun/sun.h"
#include "engine/imports/vertex_colors/vertex_colors.h"

namespace weft::imports {

ImportRegistry ImportRegistry::builtin() {
  ImportRegistry registry;
  registry.add(std::make_unique<Environment>());
  registry.add(std::make_unique<Spheres>());
  registry.add(std::make_unique<DrawOrder>());
  registry.add(std::make_unique<Silhouettes>());
  registry.add(std::make_unique<Meshes>());
  registry.add(std::make_unique<Materials>());
  registry.add(std::make_unique<MaterialMaps>());
  registry.add(std::make_unique<Joints>());
  registry.add(std::make_unique<VertexColors>());
  registry.add(std::make_unique<Sun>());
  registry.add(std::make_unique<Lamps>());
  registry.add(std::make_unique<Ground>());
  registry.add(std::make_unique<Camera>());
  registry.add(std::make_unique<CubeLut>());
  registry.add(std::make_unique<Image>());
  registry.add(std::make_unique<Cut>());
  registry.add(std::make_unique<Mouse>());
  registry.add(std::make_unique<Probes>());
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
