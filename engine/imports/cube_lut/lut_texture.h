// A .cube table as a texture that composite/lut.glsl knows how to read. Does not: keep textures, or apply the
// table (the shader does).
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "engine/assets/cube_lut.h"
#include "engine/gl/objects/objects.h"
#include "engine/imports/files.h"

namespace weft::imports {

// The table of a file. Null after errors, W001 and W154 as assets::loadCubeLut.
std::shared_ptr<const assets::CubeLut> tableOf(Files& files, const std::string& path,
                                               base::Diagnostics& diagnostics);

// The size of the texture: 3D, size^3, or for three curves rows of 1024 entries. Those have two slices,
// because a 3D texture of one would be taken for a 2D one; the second is as the first.
gl::Extent lutExtent(const assets::CubeLut& lut);

// RGBA16F, red along x. Alpha carries the domain. 3D: in the eight corners that every size has, the minimum
// of red, green and blue in texels (0,0,0), (0,1,0), (0,0,1), the maximum one step along x from each. 1D:
// minimum and maximum in the first six texels, then how often 1024 goes into the number of entries, then the
// rest.
std::optional<gl::Texture> makeLutTexture(const assets::CubeLut& lut, const std::string& label,
                                          base::Diagnostics& diagnostics);

}  // namespace weft::imports
