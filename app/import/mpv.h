// A user shader of mpv taken apart: its //! headers, with places, and which lines hold what.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "app/import/import.h"

namespace weft::convert {

struct MpvText {  // behind a header's word
  std::string text;
  base::Place place;
};

struct MpvHook {
  base::Place place;
  std::vector<MpvText> hooks, binds;
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
  ConvertedImage
      image;  // without a path; the lowest row is the first of the data. None of other than two dimensions
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

// Empty after errors (W225). `text` must outlive the result.
std::optional<MpvFile> readMpvFile(std::string_view text, const std::shared_ptr<const std::string>& file,
                                   base::Diagnostics& diagnostics);

// The text that the stage files include: its headers as #if, so that lines keep their numbers.
std::string translateMpvText(const MpvFile& file);
// The names that the shader mentions, with and without mpv's endings: HOOKED_texOff and HOOKED.
std::set<std::string> namesMentioned(const std::string& text);

// What the passes of the graph need of the shaders.
struct MpvNeeds {
  std::set<std::string> bound;     // pictures that passes bind: HOOKED, MAIN, those of SAVE
  std::set<std::string> textures;  // and those of TEXTURE
  bool fragment = false, compute = false;
};
std::vector<ConvertedText> writeMpvShaders(const MpvFile& file, const MpvNeeds& needs,
                                           const std::string& text, const std::set<std::string>& used,
                                           const std::string& name);

// mpv's own numbers that depend on sizes, which the graph sets where the shader mentions them.
inline constexpr const char* kMpvSizes[] = {"input_size", "target_size"};

}  // namespace weft::convert
