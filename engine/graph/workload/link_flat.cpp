#include "engine/graph/workload/link_flat.h"

#include <algorithm>
#include <vector>

#include "engine/graph/versions/version_walk.h"
#include "engine/graph/workload/name_table.h"

namespace weft::graph {

namespace {

using base::Code;

class Linker {
 public:
  Linker(FlatGraph& graph, base::Diagnostics& diagnostics)
      : graph_(graph), diagnostics_(diagnostics), walk_(graph) {}

  bool run() {
    const std::size_t before = diagnostics_.errorCount();
    checkNames(graph_.passNames, "passes");
    checkNames(graph_.resourceNames, "resources");
    indexCells();
    VersionLinks& links = graph_.links;
    links = {};
    walk_.reserve();
    for (std::uint32_t p = 0; p < graph_.passes.size(); ++p) linkPass(p);
    if (!checkFinals()) return false;
    walk_.finish();
    if (graph_.present.resource != kNone && !isImported(graph_.resources[graph_.present.resource]) &&
        seesNothing(links.present))
      reportPresent();
    return diagnostics_.errorCount() == before;
  }

 private:
  void checkNames(const std::vector<std::string>& names, const char* what) {
    NameTable table(names);
    table.reserve(names.size());
    for (std::uint32_t i = 0; i < names.size(); ++i)
      if (!table.add(i))
        diagnostics_.error(Code::duplicateFlatName, {},
                           std::string("two ") + what + " are named '" + names[i] + "'");
  }

  void indexCells() {
    base_.resize(graph_.resources.size() + 1);
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < graph_.resources.size(); ++i) {
      base_[i] = next;
      next += subresourceCount(graph_.resources[i]);
    }
    base_.back() = next;
    touched_.assign(next, 0);
  }

  bool inRange(const FlatUse& use) const {
    if (use.resource >= graph_.resources.size()) return false;
    const FlatResource& r = graph_.resources[use.resource];
    if (isBuffer(r)) return use.history <= r.history;
    return use.mips > 0 && use.layers > 0 && use.mip + use.mips <= r.mips &&
           use.layer + use.layers <= r.layers && use.planes != 0 && (use.planes & ~planeMask(r)) == 0 &&
           use.history <= (isImported(r) ? 1 : r.history) && (use.history == 0 || use.access == Access::read);
  }

  std::string nameOf(std::uint32_t resource) const {
    return resource < graph_.resourceNames.size() ? graph_.resourceNames[resource]
                                                  : "#" + std::to_string(resource);
  }

  void report(Code code, std::uint32_t pass, const FlatUse& use, const char* what) {
    const std::string& name = graph_.passNames[pass];
    auto& diagnostic =
        diagnostics_.error(code, {}, "pass '" + name + "' " + what + " '" + nameOf(use.resource) + "'");
    diagnostic.pass = name;
    diagnostic.resource = nameOf(use.resource);
  }

  void linkPass(std::uint32_t p) {
    const FlatPass& pass = graph_.passes[p];
    const std::uint32_t end = pass.firstUse + pass.useCount;
    bool good = true;
    for (std::uint32_t u = pass.firstUse; u < end; ++u) {
      const FlatUse& use = graph_.uses[u];
      if (!inRange(use)) {
        report(Code::useOutsideResource, p, use, "goes outside the range of");
        good = false;
        continue;
      }
      walk_.see(u, p);
      if (use.history > 0) continue;
      const FlatResource& r = graph_.resources[use.resource];
      if (use.access != Access::write && !r.hasClear && !isImported(r) && seesNothing(graph_.links.seen[u]))
        report(Code::flatReadBeforeWrite, p, use,
               use.access == Access::read ? "reads before any write" : "modifies before any write");
      if (touchedBefore(use, r, p)) report(Code::touchedTwice, p, use, "touches one sub-resource twice of");
    }
    for (std::uint32_t u = pass.firstUse; u < end; ++u)
      if (graph_.uses[u].access != Access::read && (good || inRange(graph_.uses[u]))) walk_.write(u);
  }

  // Whether some of what the link covers has no writer.
  bool seesNothing(std::uint32_t link) const {
    bool nothing = link == kNone;
    if (!VersionLinks::hasRuns(link)) return nothing;
    graph_.links.forEachRun(
        link, [&](std::uint32_t writer, std::uint32_t) { nothing = nothing || writer == kNone; });
    return nothing;
  }

  // Another use of pass `p` has touched some of it, and one of the two writes. Notes that this one has.
  bool touchedBefore(const FlatUse& use, const FlatResource& r, std::uint32_t p) {
    const std::uint32_t read = 2 * p + 2, written = read + 1,
                        mine = use.access == Access::read ? read : written;
    bool twice = false;
    if (base_[use.resource + 1] == base_[use.resource] + 1) {
      std::uint32_t& cell = touched_[base_[use.resource]];
      twice = cell == written || (cell == read && mine == written);
      cell = std::max(cell, mine);
      return twice;
    }
    forEachSubresource(use, r, [&](std::uint32_t s) {
      std::uint32_t& cell = touched_[base_[use.resource] + s];
      twice = twice || cell == written || (cell == read && mine == written);
      cell = std::max(cell, mine);
    });
    return twice;
  }

  // Present and outputs name resources and ranges that are there.
  bool checkFinals() {
    bool good = graph_.present.resource == kNone || inRange(graph_.present);
    if (!good) reportPresent();
    for (const FlatUse& output : graph_.outputs) {
      if (inRange(output)) continue;
      good = false;
      diagnostics_
          .error(Code::useOutsideResource, {},
                 "an output goes outside the range of '" + nameOf(output.resource) + "'")
          .resource = nameOf(output.resource);
    }
    return good;
  }
  void reportPresent() {
    diagnostics_.error(Code::presentsUnwritten, {},
                       "nothing writes '" + nameOf(graph_.present.resource) + "', which is presented");
  }

  FlatGraph& graph_;
  base::Diagnostics& diagnostics_;
  VersionWalk walk_;
  std::vector<std::uint32_t> base_;  // per resource: its first cell; then the end
  std::vector<std::uint32_t>
      touched_;  // per sub-resource: twice the number of the last pass from 1 on, 1 more: written
};

}  // namespace

bool linkFlat(FlatGraph& graph, base::Diagnostics& diagnostics) {
  return Linker(graph, diagnostics).run();
}

}  // namespace weft::graph
