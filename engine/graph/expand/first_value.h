// What a pass reads in the place of a history's publication that is not there yet, where "first" names a texture or buffer.
// Does not: choose between the two, which the executor does in every frame.
#pragma once

#include <utility>
#include <vector>

#include "engine/graph/expand/slots.h"

namespace weft::graph::expansion {

class FirstValues {
 public:
  // For each connected slot that reads @-n: the same part of what `first` of the resource names, read in the same way. Reports
  // what does not fit.
  void resolve(const SlotContext& context, const std::vector<SlotWork>& slots, std::uint32_t pass);
  // `slots` and these, for the checks of a whole pass.
  const std::vector<SlotWork>& with(const std::vector<SlotWork>& slots);
  // Adds the use that belongs to `work`, if there is one, to the graph.
  void emit(Model& model, const SlotWork& work, std::uint32_t pass, SlotSpec& spec) const;

 private:
  std::vector<std::pair<const SlotDesc*, SlotWork>> works_;  // by the slot that reads the history
  std::vector<SlotDesc> slots_;                              // of the works
  std::vector<SlotWork> all_;
};

}  // namespace weft::graph::expansion
