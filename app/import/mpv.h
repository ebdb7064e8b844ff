// A user shader of mpv taken apart: its //! headers, with places, and which lines hold what.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/import/text.h"

namespace weft::importing {

struct MpvHook {
  text::Place place;
  std::vector<PlacedText> hooks, binds;
  std::optional<PlacedText> save, width, height, when;
  double offset[2] = {0, 0};
  int components = 0;  // 0: those of what is hooked
  bool compute = false;
  int block[2] = {0, 0}, threads[2] = {0, 0};
};

struct MpvTexture {
  text::Place place;
  std::string name, format;
  std::vector<double> size = {1};
  bool linear = true, repeat = false;
  // Without a path; the lowest row is the first of the data. None of other than two dimensions.
  ConvertedImage image;
};

struct MpvParameter {
  text::Place place;
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

// Empty after errors (W225). `text` must outlive the result.
std::optional<MpvFile> readMpvFile(std::string_view text, const std::shared_ptr<const std::string>& file,
                                   text::Diagnostics& diagnostics);

}  // namespace weft::importing
