// The imports that come with Weft. Each is in the one file, tables for the small ones, that knows its name.
#pragma once

#include "engine/imports/import.h"

namespace weft::imports {

void addTables(graph::PlugIns<Import>& imports);
std::unique_ptr<Import> makeEnvironment();
std::unique_ptr<Import> makeDrawList();
std::unique_ptr<Import> makeSun();
std::unique_ptr<Import> makeLamps();
std::unique_ptr<Import> makeCamera();
std::unique_ptr<Import> makeCubeLut();
std::unique_ptr<Import> makeImage();

}  // namespace weft::imports
