// Barriers from hazards: per bit, stab all intervals of positions on the circle of the frame.
#include "engine/graph/compile/barriers.h"

#include <algorithm>
#include <limits>

#include "engine/graph/compile/hazards.h"

namespace weft::graph {

namespace {

// Leaves out positions that have become superfluous. Starts at `anchor`, which is needed; one walk round the
// circle suffices, because leaving one out never makes another superfluous.
void thinOut(const std::vector<HazardInterval>& hazards, std::int32_t circle, std::int32_t anchor,
             std::vector<std::int32_t>& points) {
  constexpr std::int32_t kFar = std::numeric_limits<std::int32_t>::max();
  // Unrolled from anchor + 1 to anchor + circle: the nearest end of the intervals that begin at each
  // position.
  std::vector<std::int32_t> nearest(static_cast<std::size_t>(circle), kFar);
  for (const HazardInterval& h : hazards) {
    const std::int32_t offset = ((h.lo - anchor - 1) % circle + circle) % circle;
    std::int32_t& end = nearest[static_cast<std::size_t>(offset)];
    end = std::min(end, offset + h.hi - h.lo);
  }
  std::vector<std::int32_t> others;  // offsets of the other points, ascending; the anchor's is circle - 1
  for (const std::int32_t p : points)
    if (p != anchor) others.push_back(((p - anchor - 1) % circle + circle) % circle);
  std::sort(others.begin(), others.end());
  std::vector<std::int32_t> kept{anchor};
  std::int32_t from = 0, end = kFar;  // the nearest end of the intervals that begin after the last kept point
  for (std::size_t i = 0; i < others.size(); ++i) {
    for (; from <= others[i]; ++from) end = std::min(end, nearest[static_cast<std::size_t>(from)]);
    const std::int32_t next = i + 1 < others.size() ? others[i + 1] : circle - 1;
    if (end >= next) continue;
    kept.push_back((others[i] + anchor + 1) % circle);
    end = kFar;
  }
  std::sort(kept.begin(), kept.end());
  points = std::move(kept);
}

}  // namespace

std::vector<std::int32_t> stab(const std::vector<HazardInterval>& hazards, std::int32_t circle) {
  std::vector<std::int32_t> points;
  // Within the frame: the greedy choice of the latest position is optimal.
  for (const HazardInterval& h : hazards)
    if (h.lo >= 0 && (points.empty() || points.back() < h.lo)) points.push_back(h.hi);
  // Across frames: all of them hold position 0, so the earliest end stabs every one that is left.
  std::int32_t anchor = std::numeric_limits<std::int32_t>::max();
  for (const HazardInterval& h : hazards) {
    if (h.lo >= 0 || (!points.empty() && (points.front() <= h.hi || points.back() >= h.lo + circle)))
      continue;
    anchor = std::min(anchor, h.hi);
  }
  if (anchor == std::numeric_limits<std::int32_t>::max()) return points;
  const bool alone = points.empty();
  points.insert(points.begin(), anchor);
  if (!alone) thinOut(hazards, circle, anchor, points);
  return points;
}

void steps::placeBarriers(const FlatGraph& graph, Plan& plan, CompileScratch& scratch) {
  HazardIntervals hazards;
  collectHazards(graph, plan, scratch, hazards);
  const auto end = static_cast<std::int32_t>(plan.steps.size());
  for (int bit = 0; bit < kBarrierBitCount; ++bit) {
    const auto mask = static_cast<std::uint16_t>(1u << bit);
    for (const std::int32_t at : stab(hazards[static_cast<std::size_t>(bit)], 2 * (end + 1))) {
      if (at / 2 == end) {
        plan.finalBarriers |= mask;
        continue;
      }
      Step& step = plan.steps[static_cast<std::size_t>(at / 2)];
      (at % 2 == 0 ? step.barriers : step.barriersAfterClears) |= mask;
    }
  }
}

}  // namespace weft::graph
