// The pass types that come with Weft. Each is in a folder of its own, which alone knows its name.
#pragma once

#include "engine/passes/pass_type.h"

namespace weft::passes {

std::unique_ptr<PassType> makeFullscreen();
std::unique_ptr<PassType> makeCompute();
std::unique_ptr<PassType> makeDraw();
std::unique_ptr<PassType> makeBlit();
std::unique_ptr<PassType> makeMipmap();

}  // namespace weft::passes
