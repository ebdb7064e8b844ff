// Box-filters the levels below `source` with glGenerateTextureMipmap.
#pragma once

#include "engine/passes/pass_type.h"

namespace weft::passes {

class Mipmap final : public PassType {
 public:
  graph::PassType reflect() const override;
  void execute(const PassContext& context) const override;
};

}  // namespace weft::passes
