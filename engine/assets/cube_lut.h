// .cube color tables (Adobe "Cube LUT Specification" 1.0): 1D or 3D of any legal size, DOMAIN_MIN/MAX, comments; and what DaVinci
// Resolve writes besides: a 1D table (a shaper) before the 3D one, input ranges, and the video range of LUT_IN_VIDEO_RANGE and
// LUT_OUT_VIDEO_RANGE. The first mistake is W154 with its line; an unreadable file is W001.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/text/diagnostic.h"

namespace weft::assets {

struct CubeLut {
  int dimensions = 3;                       // 1: three curves; 3: a cube
  int size = 0;                             // entries per axis, 2..65536 (1D) or 2..256 (3D)
  std::array<float, 3> domainMin{0, 0, 0};  // input that hits the first entry
  std::array<float, 3> domainMax{1, 1, 1};  // input that hits the last entry
  std::vector<float> texels;                // RGB triples, red fastest, size or size^3 of them; finite
  std::shared_ptr<const CubeLut> shaper{};  // 1D: what is looked up here is looked up in that one first
};

std::optional<CubeLut> loadCubeLut(const std::string& path, text::Diagnostics& diagnostics);
std::optional<CubeLut> readCubeLut(std::string_view text, const std::string& name,
                                   text::Diagnostics& diagnostics);

}  // namespace weft::assets
