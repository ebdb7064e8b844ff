#include "tests/graph/compile/plan_checks.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/graph/subresource.h"

namespace weft::graph::checks {

namespace {

std::set<std::uint32_t> subsOf(const FlatGraph& graph, const FlatUse& use) {
  std::set<std::uint32_t> subs;
  forEachSubresource(use, graph.resources[use.resource], [&](std::uint32_t s) { subs.insert(s); });
  return subs;
}

bool overlap(const FlatGraph& graph, const FlatUse& a, const FlatUse& b, std::uint32_t sub) {
  return a.resource == b.resource && subsOf(graph, a).count(sub) + subsOf(graph, b).count(sub) == 2;
}

// The last write of `sub` by passes before `pass`, kNone for version zero.
std::uint32_t writerBefore(const FlatGraph& graph, const FlatUse& use, std::uint32_t sub,
                           std::uint32_t pass) {
  for (std::uint32_t p = pass; p-- > 0;)
    for (std::uint32_t u = graph.passes[p].firstUse + graph.passes[p].useCount;
         u-- > graph.passes[p].firstUse;)
      if (graph.uses[u].access != Access::read && overlap(graph, graph.uses[u], use, sub)) return u;
  return kNone;
}

}  // namespace

std::string checkLiveness(const Plan& plan) {
  const FlatGraph& graph = *plan.graph;
  const auto passes = static_cast<std::uint32_t>(graph.passes.size());
  std::vector<char> livePass(passes, 0), liveUse(graph.uses.size(), 0);
  bool changed = true;
  const auto set = [&](char& flag) {
    if (flag == 0) flag = 1, changed = true;
  };
  const auto want = [&](const FlatUse& use, std::uint32_t before) {
    for (const std::uint32_t sub : subsOf(graph, use)) {
      const std::uint32_t writer = writerBefore(graph, use, sub, before);
      if (writer != kNone) set(liveUse[writer]);
    }
  };
  while (changed) {
    changed = false;
    if (graph.present.resource != kNone) want(graph.present, passes);
    for (const FlatUse& output : graph.outputs) want(output, passes);
    for (std::uint32_t p = 0; p < passes; ++p) {
      const FlatPass& pass = graph.passes[p];
      if (pass.sideEffect) set(livePass[p]);
      for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u) {
        const FlatUse& use = graph.uses[u];
        if (liveUse[u] != 0) set(livePass[p]);
        if (livePass[p] == 0) continue;
        if (use.access == Access::read || use.keep) set(liveUse[u]);
        if (use.access == Access::read && use.history > 0) want(use, passes);
        if (use.access == Access::read && use.history == 0) want(use, p);
        if (use.access == Access::modify && liveUse[u] != 0) want(use, p);
      }
    }
  }
  for (std::uint32_t p = 0; p < passes; ++p)
    if ((livePass[p] != 0) != (plan.stepOf[p] != kNone))
      return "pass " + graph.passNames[p] + " live or culled wrongly";
  for (std::size_t u = 0; u < graph.uses.size(); ++u)
    if ((liveUse[u] != 0) != (plan.attached[u] != 0)) return "use " + std::to_string(u) + " attached wrongly";
  return "";
}

// What a pass in slices writes, or any pass that must publish with it: by closure, one pass after the other.
// All that write what is written so belong to it, and the on_change passes that such a pass reads from.
static std::vector<char> slicedResources(const Plan& plan) {
  const FlatGraph& graph = *plan.graph;
  const auto writes = [&](std::uint32_t p, std::uint32_t r) {
    for (std::uint32_t u = graph.passes[p].firstUse; u < graph.passes[p].firstUse + graph.passes[p].useCount;
         ++u)
      if (plan.attached[u] != 0 && graph.uses[u].resource == r && graph.uses[u].access != Access::read)
        return true;
    return false;
  };
  const auto reads = [&](std::uint32_t p, std::uint32_t r) {
    for (std::uint32_t u = graph.passes[p].firstUse; u < graph.passes[p].firstUse + graph.passes[p].useCount;
         ++u)
      if (graph.uses[u].resource == r && graph.uses[u].access == Access::read && graph.uses[u].history == 0)
        return true;
    return false;
  };
  const auto together = [&](std::uint32_t p, std::uint32_t member) {
    for (std::uint32_t r = 0; r < graph.resources.size(); ++r) {
      if (writes(p, r) && writes(member, r)) return true;
      if (graph.passes[p].cadence == Cadence::on_change && writes(p, r) && reads(member, r)) return true;
    }
    return false;
  };
  std::vector<std::uint32_t> members;
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
    if (plan.stepOf[p] != kNone && graph.passes[p].cadence != Cadence::always && graph.passes[p].slices > 1)
      members.push_back(p);
  for (std::size_t i = 0; i < members.size(); ++i)
    for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
      if (plan.stepOf[p] != kNone && graph.passes[p].cadence != Cadence::always &&
          std::ranges::find(members, p) == members.end() && together(p, members[i]))
        members.push_back(p);
  std::vector<char> sliced(graph.resources.size(), 0);
  for (const std::uint32_t p : members)
    for (std::uint32_t r = 0; r < graph.resources.size(); ++r)
      if (writes(p, r)) sliced[r] = 1;
  return sliced;
}

std::string checkStorage(const Plan& plan) {
  const FlatGraph& graph = *plan.graph;
  const std::size_t count = graph.resources.size(), steps = plan.steps.size();
  // Steps that touch each resource, the end of the frame included, from the uses alone.
  std::vector<std::pair<std::size_t, std::size_t>> life(count, {steps + 1, 0});
  std::vector<char> own(count, 0);
  const auto touch = [&](std::uint32_t r, std::size_t t) {
    life[r] = {std::min(life[r].first, t), std::max(life[r].second, t)};
  };
  for (std::size_t t = 0; t < steps; ++t) {
    const FlatPass& pass = graph.passes[plan.steps[t].pass];
    for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u) {
      const FlatUse& use = graph.uses[u];
      if (plan.attached[u] == 0) continue;
      touch(use.resource, t);
      if (use.access != Access::read && pass.cadence != Cadence::always) own[use.resource] = 1;
    }
    for (std::uint32_t c = plan.steps[t].firstClear; c < plan.steps[t].firstClear + plan.steps[t].clearCount;
         ++c)
      touch(plan.clears[c].use.resource, t);
  }
  if (graph.present.resource != kNone && life[graph.present.resource].first <= steps)
    touch(graph.present.resource, steps);
  for (std::size_t i = 0; i < graph.outputs.size(); ++i)
    if (plan.outputLive[i] != 0) touch(graph.outputs[i].resource, steps);

  const std::vector<char> sliced = slicedResources(plan);
  using Class = std::tuple<int, std::uint32_t, std::uint32_t, std::uint32_t, int, int, int, int>;
  const auto classOf = [&](const FlatResource& r) {
    const int family = r.target == Target::texture_3d               ? 1
                       : r.target == Target::texture_2d_multisample ? 2
                                                                    : 0;
    return Class{family, r.width, r.height, r.depth, r.layers, r.mips, r.samples, infoOf(r.format).viewClass};
  };
  std::map<Class, std::uint64_t> bytes, peak;
  std::uint64_t fixed = 0, declared = 0;
  for (std::uint32_t r = 0; r < count; ++r) {
    const FlatResource& resource = graph.resources[r];
    const bool alive = life[r].first <= steps, mine = own[r] != 0 || resource.history > 0;
    const std::string& name = graph.resourceNames[r];
    if (!alive || isImported(resource)) {
      if (plan.storageOf[r] != kNone || plan.bufferOffsetOf[r] != Plan::kNoOffset)
        return name + " has storage";
      continue;
    }
    if (plan.firstStep[r] != life[r].first || plan.lastStep[r] != life[r].second)
      return name + " has a wrong lifetime";
    if ((plan.persistent[r] != 0) != mine) return name + " is persistent or not, wrongly";
    const std::uint32_t copies = resource.history + (sliced[r] != 0 ? 2u : 1u);
    declared += resource.bytes * copies;
    if (mine) fixed += resource.bytes * copies;
    if (isBuffer(resource)) {
      if ((plan.bufferOffsetOf[r] != Plan::kNoOffset) == mine)
        return name + " is in the arena or not, wrongly";
      if (!mine &&
          (plan.bufferOffsetOf[r] % 256 != 0 || plan.bufferOffsetOf[r] + resource.bytes > plan.arenaBytes))
        return name + " does not lie in the arena";
    } else {
      const Storage& storage = plan.storages[plan.storageOf[r]];
      if (storage.width != resource.width || storage.height != resource.height ||
          storage.layers != resource.layers || storage.mips != resource.mips ||
          infoOf(storage.format).viewClass != infoOf(resource.format).viewClass || storage.copies != copies ||
          storage.persistent != mine)
        return name + " has a storage of another class";
      if (!mine) bytes[classOf(resource)] = resource.bytes;
    }
    for (std::uint32_t q = 0; q < r; ++q) {
      const bool together = life[q].first <= life[r].second && life[r].first <= life[q].second;
      const bool both = together || mine || own[q] != 0 || graph.resources[q].history > 0;
      if (both && plan.storageOf[r] != kNone && plan.storageOf[q] == plan.storageOf[r])
        return name + " and " + graph.resourceNames[q] + " share while alive";
      if (together && plan.bufferOffsetOf[r] != Plan::kNoOffset &&
          plan.bufferOffsetOf[q] != Plan::kNoOffset &&
          plan.bufferOffsetOf[r] < plan.bufferOffsetOf[q] + graph.resources[q].bytes &&
          plan.bufferOffsetOf[q] < plan.bufferOffsetOf[r] + resource.bytes)
        return name + " and " + graph.resourceNames[q] + " overlap while alive";
    }
  }
  for (std::size_t t = 0; t <= steps; ++t) {
    std::map<Class, std::uint64_t> alive;
    for (std::uint32_t r = 0; r < count; ++r) {
      const FlatResource& resource = graph.resources[r];
      if (isBuffer(resource) || isImported(resource) || own[r] != 0 || resource.history > 0) continue;
      if (life[r].first <= t && t <= life[r].second) ++alive[classOf(resource)];
    }
    for (const auto& [key, n] : alive) peak[key] = std::max(peak[key], n);
  }
  std::uint64_t bound = fixed;
  for (const auto& [key, n] : peak) bound += n * bytes[key];
  if (plan.bytesAllocated - plan.arenaBytes != bound) return "textures take more or less than the bound";
  if (plan.bytesDeclared != declared) return "wrong bytes declared";
  if (plan.bytesLowerBound < bound || plan.bytesLowerBound > plan.bytesAllocated) return "wrong lower bound";
  return "";
}

std::string checkOrder(const Plan& plan) {
  const FlatGraph& graph = *plan.graph;
  std::vector<char> ran(graph.passes.size(), 0);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> writer;  // (resource, sub) -> use
  for (std::size_t t = 0; t < plan.steps.size(); ++t) {
    const std::uint32_t p = plan.steps[t].pass;
    if (ran[p] != 0 || plan.stepOf[p] != t) return "pass " + graph.passNames[p] + " runs twice";
    ran[p] = 1;
    const FlatPass& pass = graph.passes[p];
    for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u) {
      const FlatUse& use = graph.uses[u];
      if (plan.attached[u] == 0 || use.history > 0 || use.access == Access::write) continue;
      for (const std::uint32_t sub : subsOf(graph, use)) {
        const auto it = writer.find({use.resource, sub});
        if ((it == writer.end() ? kNone : it->second) != writerBefore(graph, use, sub, p))
          return graph.passNames[p] + " sees another version of " + graph.resourceNames[use.resource];
      }
    }
    for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u)
      if (plan.attached[u] != 0 && graph.uses[u].access != Access::read)
        for (const std::uint32_t sub : subsOf(graph, graph.uses[u]))
          writer[{graph.uses[u].resource, sub}] = u;
  }
  for (std::uint32_t p = 0; p < ran.size(); ++p)
    if ((ran[p] != 0) != (plan.stepOf[p] != kNone)) return "steps and stepOf disagree";
  return "";
}

}  // namespace weft::graph::checks
