// Barriers from hazards: per bit, a position in every interval on the circle of the frame. Declared in steps.h.
#include <algorithm>
#include <cassert>
#include <limits>

#include "engine/graph/compile/steps.h"

namespace weft::graph {

namespace {

// Leaves out positions that have become superfluous. Starts at `anchor`, which is needed; one walk round the
// circle suffices, because leaving one out never makes another superfluous.
void thinOut(const std::vector<HazardInterval>& hazards, std::int32_t circle, std::int32_t anchor,
             std::vector<std::int32_t>& points) {
  constexpr std::int32_t kFar = std::numeric_limits<std::int32_t>::max();
  // Unrolled from anchor + 1 to anchor + circle: the nearest end of the intervals that begin at each place.
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

std::vector<std::int32_t> chooseBarrierPositions(const std::vector<HazardInterval>& hazards,
                                                 std::int32_t circle) {
  std::vector<std::int32_t> points;
  // Within the frame: the greedy choice of the latest position is optimal.
  for (const HazardInterval& h : hazards)
    if (h.lo >= 0 && (points.empty() || points.back() < h.lo)) points.push_back(h.hi);
  // Across frames: all of them hold position 0, so the earliest end serves every one that is left.
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

namespace {

BarrierAccess accessOf(const Plan& plan, std::uint32_t who, std::uint32_t step) {
  const FlatGraph& graph = *plan.graph;
  BarrierAccess access{.pass = step == plan.steps.size() ? kNone : plan.steps[step].pass,
                       .clear = who >= kClearAccess && who < kEndAccess};
  access.use = access.clear       ? plan.clears[who & ~kClearAccess].use
               : who < kEndAccess ? graph.uses[who]
               : who > kEndAccess ? graph.outputs[(who & ~kEndAccess) - 1]
                                  : graph.present;
  return access;
}

// Of each position, an interval in which no other of the positions is.
void addReasons(const Plan& plan, BarrierBit bit, const std::vector<HazardInterval>& hazards,
                const std::vector<HazardCause>& causes, const std::vector<std::int32_t>& positions,
                std::int32_t circle, std::vector<BarrierReason>& reasons) {
  std::vector<std::size_t> why(positions.size(), hazards.size());
  for (std::size_t i = 0; i < hazards.size(); ++i) {
    std::ptrdiff_t count = 0, which = 0;
    const auto addWithin = [&](std::int32_t lo, std::int32_t hi) {
      const auto first = std::ranges::lower_bound(positions, lo),
                 end = std::ranges::upper_bound(positions, hi);
      if (first != end) which = first - positions.begin();
      count += end - first;
    };
    addWithin(std::max(hazards[i].lo, 0), hazards[i].hi);
    if (hazards[i].lo < 0) addWithin(hazards[i].lo + circle, circle - 1);
    if (count == 1) why[static_cast<std::size_t>(which)] = std::min(why[static_cast<std::size_t>(which)], i);
  }
  for (std::size_t p = 0; p < positions.size(); ++p) {
    assert(why[p] < hazards.size());
    const auto [from, to] = causes[why[p]];
    const std::int32_t behind = static_cast<std::int32_t>(from >> 32) - 1;
    const std::int32_t frame = (behind - (behind < 0 ? circle - 1 : 0)) / circle;
    const std::int32_t own = positions[p] <= hazards[why[p]].hi ? 0 : -1;
    reasons.push_back({.step = static_cast<std::uint32_t>(positions[p] / 2),
                       .afterClears = positions[p] % 2 == 1,
                       .bit = bit,
                       .before = accessOf(plan, static_cast<std::uint32_t>(from),
                                          static_cast<std::uint32_t>((behind - frame * circle) / 2)),
                       .after = accessOf(plan, to, static_cast<std::uint32_t>(hazards[why[p]].hi / 2)),
                       .framesAgo = static_cast<std::uint32_t>(own - frame)});
  }
}

}  // namespace

void steps::placeBarriers(const FlatGraph& graph, Plan& plan, const CompileScratch& scratch,
                          std::vector<BarrierReason>* reasons) {
  HazardIntervals hazards;
  HazardCauses causes;
  collectHazards(graph, plan, scratch, hazards, reasons ? &causes : nullptr);
  const auto end = static_cast<std::int32_t>(plan.steps.size()), circle = 2 * (end + 1);
  for (std::size_t bit = 0; bit < hazards.size(); ++bit) {
    const auto mask = static_cast<std::uint16_t>(1u << bit);
    const std::vector<std::int32_t> positions = chooseBarrierPositions(hazards[bit], circle);
    for (const std::int32_t at : positions) {
      if (at / 2 == end) {
        plan.finalBarriers |= mask;
        continue;
      }
      Step& step = plan.steps[static_cast<std::size_t>(at / 2)];
      (at % 2 == 0 ? step.barriers : step.barriersAfterClears) |= mask;
    }
    if (reasons)
      addReasons(plan, static_cast<BarrierBit>(mask), hazards[bit], causes[bit], positions, circle, *reasons);
  }
}

}  // namespace weft::graph
