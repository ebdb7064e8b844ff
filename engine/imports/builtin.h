// The imports that come with Weft. Each is in a folder of its own, or in tables, which alone knows its name.
#pragma once

#include "engine/imports/import.h"

namespace weft::imports {

void addTables(graph::PlugIns<Import>& imports);
std::unique_ptr<Import> makeEnvironment();
std::unique_ptr<Import> makeDrawList();
std::unique_ptr<Import> makeDrawOrder();
std::unique_ptr<Import> makeSilhouettes();
std::unique_ptr<Import> makeMaterialMaps();
std::unique_ptr<Import> makeSun();
std::unique_ptr<Import> makeLamps();
std::unique_ptr<Import> makeCamera();
std::unique_ptr<Import> makeCubeLut();
std::unique_ptr<Import> makeImage();
std::unique_ptr<Import> makeCut();

}  // namespace weft::imports
