// The work groups of a compute pass, or of some slices of it. Slices divide the rows of groups, along y when there is
// more than one, else along x. The last groups may reach beyond `threads`, as they do without slices.
#pragma once

#include "engine/passes/pass_type.h"

namespace weft::passes {

struct WorkGroups {
  std::uint32_t first[3] = {0, 0, 0}, count[3] = {0, 0, 0};
};

WorkGroups workGroupsOf(const PassContext& context);

}  // namespace weft::passes
