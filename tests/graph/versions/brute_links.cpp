#include "tests/graph/versions/brute_links.h"

#include <map>

#include "engine/graph/subresource.h"

namespace weft::graph::checks {

namespace {

struct Part {
  std::uint32_t mip, layer, plane;
};

bool touches(const FlatGraph& graph, const FlatUse& use, const Part& part) {
  const FlatResource& r = graph.resources[use.resource];
  if (r.kind == ResourceKind::buffer || r.kind == ResourceKind::imported_buffer) return true;
  const bool depthStencil = r.format == Format::depth24_stencil8 || r.format == Format::depth32f_stencil8;
  return use.mip <= part.mip && part.mip < std::uint32_t{use.mip} + use.mips && use.layer <= part.layer &&
         part.layer < std::uint32_t{use.layer} + use.layers &&
         (!depthStencil || (use.planes & (part.plane == 0 ? 1 : 2)) != 0);
}

class Judge {
 public:
  Judge(const FlatGraph& graph, LinkCount& count) : graph_(graph), count_(count) {
    for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
      for (std::uint32_t u = 0; u < graph.passes[p].useCount; ++u) passOf_.push_back(p);
  }

  std::string run() {
    const VersionLinks& links = graph_.links;
    if (passOf_ != links.passOf) return "a use has another pass";
    if (links.seen.size() != graph_.uses.size() || links.outputs.size() != graph_.outputs.size())
      return "there are not as many links as uses";
    bool forward = false;
    for (std::uint32_t u = 0; u < graph_.uses.size(); ++u) {
      const FlatUse& use = graph_.uses[u];
      if (use.access == Access::write) {
        if (links.seen[u] != kNone) return "use " + std::to_string(u) + ", a write, has a link";
        continue;
      }
      const std::uint32_t before = use.history > 0 ? kNone : passOf_[u];
      if (!judge(use, links.seen[u], before)) return "use " + std::to_string(u) + " sees another version";
      links.forEachWriter(links.seen[u],
                          [&](std::uint32_t writer) { forward = forward || passOf_[writer] >= passOf_[u]; });
      count_.histories += use.history > 0 && links.seen[u] != kNone ? 1 : 0;
    }
    if (forward != links.forward) return "a link leads forward or not, wrongly";
    if (graph_.present.resource == kNone ? links.present != kNone
                                         : !judge(graph_.present, links.present, kNone))
      return "present sees another version";
    for (std::size_t i = 0; i < graph_.outputs.size(); ++i)
      if (!judge(graph_.outputs[i], links.outputs[i], kNone))
        return "output " + std::to_string(i) + " sees another version";
    return "";
  }

 private:
  // The number of a part, and who wrote it last in a pass before `before`.
  std::map<std::uint32_t, std::uint32_t> versionsOf(const FlatUse& use, std::uint32_t before) const {
    const FlatResource& r = graph_.resources[use.resource];
    const bool buffer = r.kind == ResourceKind::buffer || r.kind == ResourceKind::imported_buffer;
    const std::uint32_t layers = buffer ? 1 : r.layers, mips = buffer ? 1 : r.mips;
    std::map<std::uint32_t, std::uint32_t> versions;
    for (std::uint32_t plane = 0; plane < 2; ++plane)
      for (std::uint32_t layer = 0; layer < layers; ++layer)
        for (std::uint32_t mip = 0; mip < mips; ++mip) {
          const bool depthStencil =
              r.format == Format::depth24_stencil8 || r.format == Format::depth32f_stencil8;
          const Part part{mip, layer, plane};
          if ((plane == 1 && (buffer || !depthStencil)) || !touches(graph_, use, part)) continue;
          std::uint32_t& writer = versions[(plane * layers + layer) * mips + mip] = kNone;
          for (std::uint32_t u = 0; u < graph_.uses.size() && passOf_[u] < before; ++u)
            if (graph_.uses[u].resource == use.resource && graph_.uses[u].access != Access::read &&
                touches(graph_, graph_.uses[u], part))
              writer = u;
        }
    return versions;
  }

  bool judge(const FlatUse& use, std::uint32_t link, std::uint32_t before) {
    const auto expected = versionsOf(use, before);
    std::map<std::uint32_t, std::uint32_t> found;
    forEachVersion(graph_.links, link, use, graph_.resources[use.resource],
                   [&](std::uint32_t part, std::uint32_t writer) { found[part] = writer; });
    ++count_.links;
    count_.none += link == kNone ? 1 : 0;
    if (VersionLinks::hasRuns(link)) {
      ++count_.several;
      std::size_t runs = 0, parts = 0;
      graph_.links.forEachRun(link, [&](std::uint32_t, std::uint32_t count) { ++runs, parts += count; });
      if (runs < 2 || parts != expected.size()) return false;
    }
    return found == expected;
  }

  const FlatGraph& graph_;
  LinkCount& count_;
  std::vector<std::uint32_t> passOf_;
};

}  // namespace

std::string checkLinks(const FlatGraph& graph, LinkCount& count) {
  return Judge(graph, count).run();
}

}  // namespace weft::graph::checks
