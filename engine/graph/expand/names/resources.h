// Shapes: evaluates size, format, levels, layers, target, bytes and history of a texture, buffer or import, and checks
// every range. Lazily, because sizes refer to each other. Also finds which alternative a list of references means before
// versions are known. versions.h makes FlatResources of them.
#pragma once

#include "engine/graph/expand/names/names.h"
#include "engine/graph/expand/names/scope.h"

namespace weft::graph::expansion {

// True when entity.shape is usable. Reports what is wrong the first time only.
bool ensureShape(Model& model, std::uint32_t entity);

// Gives what is bound to inputs the history that they ask for. To be called when all shapes were asked for, before passes.
void takeInputHistories(Model& model);

// The entity itself, or of a list of alternatives the first whose condition holds and which exists, whether or not it has
// a version. kNone when there is none. `mip` gets the level that its reference selects, 0 when it selects none.
std::uint32_t staticTarget(Model& model, std::uint32_t entity, std::uint32_t* mip = nullptr);

const ImportType* findImportType(const Registry& registry, std::string_view name);
// What else an unknown import may mean: what Weft calls it, the nearest of its types, or all of them.
std::string hintForImport(const Registry& registry, std::string_view name);

constexpr std::uint32_t kMaxSize = 16384, kMaxSize3d = 2048, kMaxMips = 32, kMaxLayers = 2048,
                        kMaxHistory = 16, kMaxArray = 256;
constexpr std::uint64_t kMaxBufferBytes = 2ull << 30;

}  // namespace weft::graph::expansion
