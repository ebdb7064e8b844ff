// A graph tried in all its simple variations, without a device: each pass disabled, each pair of passes disabled, each
// choice of each parameter.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/graph/desc.h"
#include "engine/graph/expand/expand.h"
#include "engine/graph/flat_graph.h"
#include "engine/graph/registry.h"

namespace weft::graph {

struct Variation {
  std::vector<std::string> disables;  // none, one or two passes
  std::string parameter, value;       // or one that is set; as behind --set
  std::string text() const;           // "--disable sky --disable fog", "--set curve=filmic"
};

struct RefusedVariation {
  Variation variation;
  text::Diagnostics said;  // errors only; of `lost` what it warns of and no variation before it does
};

struct Matrix {
  std::size_t passes = 0, pairs = 0, values = 0;
  // Passes that the graph does not do without, and pairs of which it needs one, where it says so: every error names a
  // disabled pass and the ways out.
  std::vector<RefusedVariation> needed;
  // Whatever else is refused: a value that a parameter offers, and passes whose errors do not tell that they are disabled.
  std::vector<RefusedVariation> broken;
  // Variations in which a pass does not reach the picture, or reads what is written below it, and which the graph as it is has not.
  std::vector<RefusedVariation> lost;
};

struct MatrixOptions {
  bool pairs = true;
  // Called for each variation that makes a graph, and for the graph as it is.
  std::function<void(const Variation&, std::shared_ptr<const FlatGraph>)> visit{};
};

// `settings` hold in all variations. The graph expands as it is, without errors.
Matrix tryMatrix(const GraphDesc& desc, const Registry& registry, const Settings& settings,
                 const MatrixOptions& options);

}  // namespace weft::graph
