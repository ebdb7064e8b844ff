#include "engine/graph/workload/validate_flat.h"

#include <vector>

#include "engine/graph/subresource.h"
#include "engine/graph/workload/name_table.h"

namespace weft::graph {

namespace {

using base::Code;

class Validator {
 public:
  Validator(const FlatGraph& graph, base::Diagnostics& diagnostics)
      : graph_(graph), diagnostics_(diagnostics) {}

  bool run() {
    const std::size_t before = diagnostics_.errorCount();
    checkNames(graph_.passNames, "passes");
    checkNames(graph_.resourceNames, "resources");
    indexCells();
    for (std::uint32_t p = 0; p < graph_.passes.size(); ++p) checkPass(p);
    if (graph_.present.resource != kNone) checkPresent();
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
    base_.resize(graph_.resources.size());
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < graph_.resources.size(); ++i) {
      base_[i] = next;
      next += subresourceCount(graph_.resources[i]);
    }
    cells_.assign(next, {});
  }

  bool inRange(const FlatUse& use) const {
    if (use.resource >= graph_.resources.size()) return false;
    const FlatResource& r = graph_.resources[use.resource];
    if (isBuffer(r)) return use.history <= r.history;
    const std::uint32_t planes = planesOf(r) == 2 ? 3 : 1;
    return use.mips > 0 && use.layers > 0 && use.mip + use.mips <= r.mips &&
           use.layer + use.layers <= r.layers && use.planes != 0 && (use.planes & ~planes) == 0 &&
           use.history <= (isImported(r) ? 1 : r.history) && (use.history == 0 || use.access == Access::read);
  }

  std::string nameOf(std::uint32_t resource) const {
    return resource < graph_.resourceNames.size() ? graph_.resourceNames[resource]
                                                  : "#" + std::to_string(resource);
  }

  void complain(Code code, std::uint32_t pass, const FlatUse& use, const char* what) {
    const std::string& name = graph_.passNames[pass];
    auto& diagnostic =
        diagnostics_.error(code, {}, "pass '" + name + "' " + what + " '" + nameOf(use.resource) + "'");
    diagnostic.pass = name;
    diagnostic.resource = nameOf(use.resource);
  }

  void checkPass(std::uint32_t p) {
    const std::uint32_t stamp = p + 1;
    const FlatPass& pass = graph_.passes[p];
    for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u) {
      const FlatUse& use = graph_.uses[u];
      if (!inRange(use)) {
        complain(Code::useOutsideResource, p, use, "goes outside the range of");
        continue;
      }
      if (use.history > 0) continue;
      const FlatResource& r = graph_.resources[use.resource];
      bool missing = false, twice = false;
      forEachSubresource(use, r, [&](std::uint32_t s) {
        Cell& cell = cells_[base_[use.resource] + s];
        const bool there = cell.writtenBy != 0 && cell.writtenBy != stamp;
        missing = missing ||
                  (use.access != Access::write && !there && cell.older == 0 && !r.hasClear && !isImported(r));
        twice = twice || cell.writtenBy == stamp || (use.access != Access::read && cell.readBy == stamp);
        if (use.access == Access::read) {
          cell.readBy = stamp;
        } else {
          if (there) cell.older = 1;
          cell.writtenBy = stamp;
        }
      });
      if (missing)
        complain(Code::flatReadBeforeWrite, p, use,
                 use.access == Access::read ? "reads before any write" : "modifies before any write");
      if (twice) complain(Code::touchedTwice, p, use, "touches one sub-resource twice of");
    }
  }

  void checkPresent() {
    bool written = inRange(graph_.present);
    if (written)
      forEachSubresource(graph_.present, graph_.resources[graph_.present.resource], [&](std::uint32_t s) {
        written = written && (cells_[base_[graph_.present.resource] + s].writtenBy != 0 ||
                              isImported(graph_.resources[graph_.present.resource]));
      });
    if (!written)
      diagnostics_.error(Code::presentsUnwritten, {},
                         "nothing writes '" + nameOf(graph_.present.resource) + "', which is presented");
  }

  struct Cell {
    std::uint32_t writtenBy = 0, readBy = 0;  // pass + 1 of the latest
    std::uint8_t older = 0;                   // an earlier pass wrote it as well
  };

  const FlatGraph& graph_;
  base::Diagnostics& diagnostics_;
  std::vector<std::uint32_t> base_;
  std::vector<Cell> cells_;
};

}  // namespace

bool validateFlat(const FlatGraph& graph, base::Diagnostics& diagnostics) {
  return Validator(graph, diagnostics).run();
}

}  // namespace weft::graph
