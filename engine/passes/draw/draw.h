// Instanced geometry: a draw list of the scene, or `instances` copies of a built-in shape.
#pragma once

#include "engine/passes/pass_type.h"

namespace weft::passes {

class Draw final : public PassType {
 public:
  graph::PassType reflect() const override;
  void execute(const PassContext& context) const override;
};

}  // namespace weft::passes
