// Texture formats as other APIs call them: DXGI, Vulkan, OpenGL, Metal, WebGPU, and what people write by heart. For hints.
#pragma once

#include <string>
#include <string_view>

namespace weft::base {

// The texture format that another API's name for it means ("R16G16B16A16_FLOAT": "rgba16f"), or "". One that Weft does not
// have becomes the nearest that it has: three channels become four.
std::string formatMeantBy(std::string_view word);

}  // namespace weft::base
