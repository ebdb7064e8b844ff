// One triangle over the whole target; the shader is a single .frag.glsl file.
#pragma once

#include "engine/passes/pass_type.h"

namespace weft::passes {

class Fullscreen final : public PassType {
 public:
  graph::PassType reflect() const override;
  void execute(const PassContext& context) const override;
};

}  // namespace weft::passes
