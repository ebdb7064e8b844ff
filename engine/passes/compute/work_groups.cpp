#include "engine/passes/compute/work_groups.h"

#include <algorithm>

namespace weft::passes {

WorkGroups workGroupsOf(const PassContext& context) {
  WorkGroups groups;
  for (int axis = 0; axis < 3; ++axis) {
    const std::uint32_t size = std::max(1u, context.groupSize[axis]);
    groups.count[axis] = (context.spec->threads[axis] + size - 1) / size;
  }
  // Long one-dimensional work may need more groups than one axis allows, so it is folded into rows. A shader that
  // supports this computes its index from gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x and checks its range.
  if (groups.count[0] > context.maxGroups[0] && groups.count[1] == 1) {
    groups.count[1] = (groups.count[0] + context.maxGroups[0] - 1) / context.maxGroups[0];
    groups.count[0] = context.maxGroups[0];
  }
  const int axis = groups.count[1] > 1 ? 1 : 0;
  const auto at = [&](std::uint64_t slice) {
    return static_cast<std::uint32_t>(groups.count[axis] * slice / context.slices);
  };
  groups.first[axis] = at(context.slice);
  groups.count[axis] = at(context.slice + context.sliceCount) - groups.first[axis];
  return groups;
}

}  // namespace weft::passes
