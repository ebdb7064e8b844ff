#include "engine/graph/compile/plan_memory.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/limits.h"

namespace weft::graph {

namespace {

constexpr std::size_t kNamed = 4;  // of the largest

struct Piece {
  std::uint64_t bytes = 0;
  std::uint32_t resource = kNone;  // the first of those that share it
  std::uint32_t sharing = 0;
};

// Every texture and buffer that would be made.
std::vector<Piece> piecesOf(const Plan& plan) {
  const FlatGraph& graph = *plan.graph;
  std::vector<Piece> pieces(plan.storages.size());
  for (std::uint32_t r = 0; r < graph.resources.size(); ++r) {
    const std::uint32_t storage = plan.storageOf[r];
    if (storage != kNone) {
      Piece& piece = pieces[storage];
      piece.bytes = plan.storages[storage].bytes;
      if (piece.sharing++ == 0) piece.resource = r;
    } else if (graph.resources[r].kind == ResourceKind::buffer && plan.firstStep[r] != kNone) {
      pieces.push_back({graph.resources[r].bytes * plan.copiesOf(r), r, 1});
    }
  }
  return pieces;
}

}  // namespace

bool checkMemory(const Plan& plan, base::Diagnostics& diagnostics) {
  const std::uint64_t most = base::raised(kMostTextureBytes);
  if (plan.bytesAllocated <= most) return true;
  const FlatGraph& graph = *plan.graph;
  std::vector<Piece> pieces = piecesOf(plan);
  const std::size_t named = std::min(kNamed, pieces.size());
  std::ranges::partial_sort(pieces, pieces.begin() + static_cast<std::ptrdiff_t>(named),
                            [](const Piece& a, const Piece& b) {
                              return a.bytes != b.bytes ? a.bytes > b.bytes : a.resource < b.resource;
                            });
  const std::uint32_t largest = pieces[0].resource;
  base::Diagnostic& d =
      diagnostics.error(base::Code::texturesTooLarge,
                        largest < graph.resourcePlaces.size() ? graph.resourcePlaces[largest] : base::Place{},
                        fmt::format("the textures and buffers of '{}' need {} bytes, more than they may",
                                    graph.name, plan.bytesAllocated));
  d.resource = graph.resourceNames[largest];
  d.expected = fmt::format("at most {} bytes", most);
  for (std::size_t i = 0; i < named; ++i)
    d.found += fmt::format(
        "{}'{}' {} bytes{}", i == 0 ? "the largest are " : ", ", graph.resourceNames[pieces[i].resource],
        pieces[i].bytes,
        pieces[i].sharing > 1 ? fmt::format(" (shared with {} others)", pieces[i].sharing - 1) : "");
  d.hint = "make them smaller or keep less history";
  if (const std::string raise = base::hintToRaise(kMostTextureBytes, plan.bytesAllocated); !raise.empty())
    d.hint += "; " + raise;
  return false;
}

}  // namespace weft::graph
