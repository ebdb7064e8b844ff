#include "engine/passes/pass_type.h"

#include "engine/passes/builtin.h"

namespace weft::passes {

PassRegistry PassRegistry::builtin() {
  PassRegistry registry;
  for (const auto make : {makeFullscreen, makeCompute, makeDraw, makeBlit, makeMipmap}) registry.add(make());
  return registry;
}

}  // namespace weft::passes
