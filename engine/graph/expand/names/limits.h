// The limits of an expansion: what is counted in Model::effort, and the report (Code::limitExceeded) when it is too
// much. A limit that is exceeded ends the expansion, whatever else may be wrong.
#pragma once

#include <string>
#include <string_view>

#include "engine/base/limit_report.h"
#include "engine/graph/expand/names/model.h"
#include "engine/graph/language/enough.h"

namespace weft::graph::expansion {

using base::Limit;

// True when `count` is beyond the limit; reported the first time only.
bool exceeds(Model& model, Limit limit, std::uint64_t count, const Place& place, const std::string& message);
// `count` more alternatives are looked at. False when it is too many.
bool lookAt(Model& model, std::uint64_t count, const Place& place);
// What looking at one counts: a long condition counts more than once.
inline std::uint64_t costOf(const RefDesc& alternative) {
  return 1 + alternative.condition.terms() / 8;
}
// `count` things are compared with each other. False when it is too many.
bool compare(Model& model, std::uint64_t count, const Place& place);

// What each instance of a stanza costs.
struct StanzaCost {
  std::uint64_t uses = 0, bytes = 0, terms = 0;
};
StanzaCost costOf(const PassDesc& desc, const std::string& declared);
// One more instance. False when it is too many.
bool mayExpand(Model& model, const StanzaCost& cost, const Place& place, const std::string& declared);
// One more slot, of `elements` textures. False when the graph has too many uses, or they see too many
// versions: those of each sub-resource count.
bool mayUse(Model& model, std::uint32_t entity, const FlatUse& rect, std::uint32_t elements,
            const Place& place);

// True when nothing more is worth expanding.
inline bool isOver(const Model& model) {
  return model.effort.stopped || enoughErrors(model.diagnostics);
}

// While one definition (a let, a size, what an input stands for) is evaluated for another. The walk goes down
// the stack, so it is limited by the number of definitions and by the operators around them.
class Descent {
 public:
  // `label` names the definition in the report.
  // A list of alternatives is none; it takes its part of the stack.
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
