// Copies, and scales, one texture level to another with the fixed-function blit.
#pragma once

#include "engine/passes/pass_type.h"

namespace weft::passes {

class Blit final : public PassType {
 public:
  graph::PassType reflect() const override;
  void execute(const PassContext& context) const override;
};

}  // namespace weft::passes
