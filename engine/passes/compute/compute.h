// A dispatch of `threads` invocations, rounded up to the program's local size.
#pragma once

#include "engine/passes/pass_type.h"

namespace weft::passes {

class Compute final : public PassType {
 public:
  graph::PassType reflect() const override;
  void execute(const PassContext& context) const override;
};

}  // namespace weft::passes
