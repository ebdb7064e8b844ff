// Versions: which FlatResource a texture, buffer or import is at this point of the declared order, and whether it has the
// versions that a use asks for. A whole rewrite makes another FlatResource ("hdr#2"). Who wrote what is the VersionWalk's
// (engine/graph/versions/version_walk.h). Does not decide what a missing version means (expand/judge/judge.h).
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
VersionCheck checkVersion(const Model& model, std::uint32_t entity, std::uint32_t element,
                          const FlatUse& rect);

// Adds `use` of `pass` to the graph, of the resource that it names, and links it to what it sees.
void addUse(Model& model, std::uint32_t entity, std::uint32_t element, const FlatUse& use,
            std::uint32_t pass);

// For a whole write: another FlatResource when the current one has been written or its version zero used. One that `covers`
// less than all of it begins with its "clear".
std::uint32_t resourceToWrite(Model& model, std::uint32_t entity, std::uint32_t element, bool whole,
                              bool covers);

// Notes in Model::would what would be used at this position. Imports do not matter.
void wouldUse(Model& model, WouldUse use);
// The same for all of `entity`, or of what it lists.
void wouldUse(Model& model, std::uint32_t entity, Access access, int history);

}  // namespace weft::graph::expansion
