// What becomes of a pipeline that was written for another program: the files of a Weft graph. Paths are relative
// to the folder that the person names. Does not: write anything.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/diagnostic.h"

namespace weft::convert {

struct ConvertedText {
  std::string path, text;
};

// Texels that stood in the foreign file: RGBA bytes, or RGBA floats, from the top row.
struct ConvertedImage {
  std::string path;  // .png for bytes, .exr for floats
  int width = 0, height = 0;
  std::vector<std::uint8_t> bytes;
  std::vector<float> floats;
};

struct Converted {
  std::string graph;  // the path of the graph among `texts`
  std::vector<ConvertedText> texts;
  std::vector<ConvertedImage> images;
};

struct ConvertOptions {
  std::string name;  // of the graph and its folder of shaders: letters, digits and '_'
  // From the folder that is written to the folder of the foreign file, for pictures that it names. "" is the same.
  std::string sourceFolder;
  std::vector<std::pair<std::string, std::string>> images;  // input, file as the graph shall name it
};

// Reports (W044) what `options.images` names and the file does not have; false then.
bool checkImageNames(const ConvertOptions& options, std::span<const std::string> known,
                     base::Diagnostics& diagnostics);

}  // namespace weft::convert
