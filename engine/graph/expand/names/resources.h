// Shapes: evaluates what a texture, buffer or import is (size, format, levels, layers, target, bytes,
// history), lazily because sizes refer to each other, with every range checked. Also which alternative a list
// of references means before versions are known. Does not: make FlatResources (expand_versions).
#pragma once

#include "engine/graph/expand/names/names.h"
#include "engine/graph/expand/names/scope.h"

namespace weft::graph::expansion {

// True when entity.shape is usable. Reports what is wrong the first time only.
bool ensureShape(Model& model, std::uint32_t entity);

// The part of ensureShape for an import: its arguments, and what the registry says of it.
bool evaluateImport(Model& model, Entity& entity);

// The index of an import in FlatGraph::imports; equal requests share one.
std::uint32_t internImport(Model& model, ImportRequest request, ImportKind kind, const std::string& name);

// Ignoring versions: a texture, buffer or import as it is; of alternatives the first whose condition holds
// and which exists. kNone when none does. `mip` gets the level its reference selects, 0 when it selects none.
std::uint32_t staticTarget(Model& model, std::uint32_t entity, std::uint32_t* mip = nullptr);

const ImportType* findImportType(const Registry& registry, std::string_view name);

// Sub-resources of one FlatResource: planes x layers x mips.

constexpr std::uint32_t kMaxSize = 16384, kMaxSize3d = 2048, kMaxMips = 32, kMaxLayers = 2048,
                        kMaxHistory = 16, kMaxArray = 256;
constexpr std::uint64_t kMaxBufferBytes = 2ull << 30;

}  // namespace weft::graph::expansion
