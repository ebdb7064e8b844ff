// A user shader of mpv taken apart: its //! headers, with places, and which lines hold what. Broken headers are W225.
// Does not: know which stages and textures have a meaning in Weft.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/diagnostic.h"

namespace weft::convert {

struct MpvText {  // behind a header's word
  std::string text;
  base::Place place;
};

struct MpvHook {
  base::Place place;
  std::vector<MpvText> hooks, binds;
  std::string description;
  std::optional<MpvText> save, width, height, when;
  double offset[2] = {0, 0};
  int components = 0;  // 0: those of what is hooked
  bool compute = false;
  int block[2] = {0, 0}, threads[2] = {0, 0};
  std::size_t headerLine = 0;  // of its first header, from 0
};

struct MpvTexture {
  base::Place place;
  std::string name = "USER_TEX", format;
  int dimensions = 2, size[3] = {1, 1, 1};
  bool linear = true, repeat = false;
  std::vector<std::uint8_t> bytes;
};

struct MpvParameter {
  base::Place place;
  std::string name, description, type;
  std::optional<double> min, max;
  double initial = 0;
};

struct MpvFile {
  std::vector<MpvHook> hooks;
  std::vector<MpvTexture> textures;
  std::vector<MpvParameter> parameters;
  std::vector<std::string_view> lines;  // of the text, without line ends
  std::vector<bool> data;               // by line: texels or a default, no GLSL
};

// Empty after errors. `text` must outlive the result.
std::optional<MpvFile> readMpvFile(std::string_view text, const std::shared_ptr<const std::string>& file,
                                   base::Diagnostics& diagnostics);

}  // namespace weft::convert
