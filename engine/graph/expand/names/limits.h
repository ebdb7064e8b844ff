// The limits of an expansion: counts in Model::effort, and reports Code::limitExceeded when a count is too large. That
// ends the expansion, whatever else may be wrong.
#pragma once

#include <string>
#include <string_view>

#include "engine/base/limit_report.h"
#include "engine/graph/expand/names/model.h"
#include "engine/graph/language/enough.h"

namespace weft::graph::expansion {

using base::Limit;

// Reports that a limit is exceeded, the first time only, and ends the expansion.
void stopAt(Model& model, Limit limit, Where place, const Called& message);
// True when `count` is beyond the limit; then the expansion ends. `place` is a Place or a Where.
template <class At>
bool exceeds(Model& model, Limit limit, std::uint64_t count, const At& place, const Called& message) {
  if (count <= base::limitOf(limit)) return false;
  stopAt(model, limit, place, message);
  return true;
}
// Counts `count` more alternatives as looked at. False when that is too many.
bool lookAt(Model& model, std::uint64_t count, const Place& place);
// What one alternative counts: more than 1 when its condition is long.
inline std::uint64_t costOf(const RefDesc& alternative) {
  return 1 + alternative.condition.terms() / 8;
}
// Comparisons for each slot that all passes may have.
inline constexpr std::uint64_t kComparedPerUse = 100;
// Counts a comparison of `count` things with each other. False when that is too many. `place` is a Place or a Where.
template <class At>
bool compare(Model& model, std::uint64_t count, const At& place) {
  model.effort.compared += count;
  return !exceeds(model, Limit::uses, model.effort.compared / kComparedPerUse, place,
                  "the passes of the graph use the same resources too often to compare their uses");
}

// What each instance of a stanza costs.
struct StanzaCost {
  std::uint64_t uses = 0, bytes = 0, terms = 0;
};
StanzaCost costOf(const PassDesc& desc, const std::string& declared);
// Counts one more instance of a stanza. False when that is too many.
bool mayExpand(Model& model, const StanzaCost& cost, const Place& place, const std::string& declared);
// Counts one more slot, of `elements` textures. False when the graph has too many uses, or when these see too many
// versions; each sub-resource counts.
bool mayUse(Model& model, std::uint32_t entity, const FlatUse& rect, std::uint32_t elements,
            const Place& place);

// True when nothing more is worth expanding.
inline bool isOver(const Model& model) {
  return model.effort.stopped || enoughErrors(model.diagnostics);
}

// Lives while one definition (a let, a size, what an input stands for) is evaluated for another. This recurses, so the
// number of definitions and of the operators around them is limited.
class Descent {
 public:
  // `label` names the definition in the report. `definition` is false for a list of alternatives: it does not count as
  // a definition, but takes its part of the stack.
  Descent(Model& model, int height, const Place& place, std::string_view label, bool definition = true);
  ~Descent();
  Descent(const Descent&) = delete;
  Descent& operator=(const Descent&) = delete;
  bool good() const { return good_; }

 private:
  Effort& effort_;
  std::uint32_t height_, depth_;
  bool good_ = true;
};

}  // namespace weft::graph::expansion
