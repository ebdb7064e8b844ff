// Versions: which FlatResource a texture, buffer or import is at this point of the declared order, which of
// its sub-resources have a version and who wrote them. A whole rewrite makes another FlatResource ("hdr#2").
// Linear in the sub-resources touched. Does not decide what a missing version means (expand_live).
#pragma once

#include "engine/graph/expand/names/model.h"

namespace weft::graph::expansion {

// The current FlatResource of an element, made when there is none yet. The shape must be ensured.
std::uint32_t currentResource(Model& model, std::uint32_t entity, std::uint32_t element);

struct VersionCheck {
  bool complete = true;       // every selected sub-resource has a version (version zero counts)
  bool real = false;          // one of them at least is above zero
  std::uint32_t missing = 0;  // the first sub-resource without one, as an index
};
VersionCheck checkVersion(const Entity& entity, std::uint32_t element, const FlatUse& rect);

// Appends the uses that wrote the selected sub-resources, each run of equal ones once; marks version zero as
// used.
void collectWriters(Entity& entity, std::uint32_t element, const FlatUse& rect,
                    std::vector<std::uint32_t>& out);

// For a whole write: another FlatResource when the current one has been written or its version zero used.
std::uint32_t resourceToWrite(Model& model, std::uint32_t entity, std::uint32_t element, bool whole);

// `use` is now the version of the selected sub-resources.
void setWriter(Entity& entity, std::uint32_t element, const FlatUse& rect, std::uint32_t use, bool whole);

// "mip 2, layer 1" of a sub-resource index; "" when there is only one.
std::string subresourceText(const FlatResource& shape, std::uint32_t index);

}  // namespace weft::graph::expansion
