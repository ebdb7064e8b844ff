// The imports that come with Weft. Each is in a folder of its own, which alone knows its name.
#pragma once

#include "engine/imports/import.h"

namespace weft::imports {

std::unique_ptr<Import> makeEnvironment();
std::unique_ptr<Import> makeSpheres();
std::unique_ptr<Import> makeDrawOrder();
std::unique_ptr<Import> makeSilhouettes();
std::unique_ptr<Import> makeMeshes();
std::unique_ptr<Import> makeMaterials();
std::unique_ptr<Import> makeMaterialMaps();
std::unique_ptr<Import> makeJoints();
std::unique_ptr<Import> makeVertexColors();
std::unique_ptr<Import> makeSun();
std::unique_ptr<Import> makeLamps();
std::unique_ptr<Import> makeGround();
std::unique_ptr<Import> makeCamera();
std::unique_ptr<Import> makeCubeLut();
std::unique_ptr<Import> makeImage();
std::unique_ptr<Import> makeCut();
std::unique_ptr<Import> makeMouse();
std::unique_ptr<Import> makeProbes();

}  // namespace weft::imports
