// The import `cube_lut` on the GPU: a 3D .cube table as a texture that composite/lut.glsl knows how to read.
// Does not: cache (Imports does) or apply the table (the shader does).
#pragma once

#include <optional>
#include <string>

#include "engine/assets/cube_lut.h"
#include "engine/gl/objects.h"

namespace weft::runtime {

// A 3D table; W1 and W154 as assets::loadCubeLut, W154 for a 1D one too.
std::optional<assets::CubeLut> loadLut(const std::string& path, base::Diagnostics& diagnostics);

// RGBA16F, size^3, red along x. Alpha carries the domain in the eight corners that every size has: the
// minimum of red, green and blue in texels (0,0,0), (0,1,0), (0,0,1), the maximum one step along x from each.
std::optional<gl::Texture> makeLutTexture(const assets::CubeLut& lut, const std::string& label,
                                          base::Diagnostics& diagnostics);

}  // namespace weft::runtime
