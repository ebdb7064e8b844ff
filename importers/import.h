// Pipelines that were written for other programs, as graphs: ISF files (Interactive Shader Format, versions 1 and 2) and user
// shaders of mpv (docs/importing.md); and graphs of the language's first edition. What cannot be mapped is refused with a place and a code (W220 to W226). `weft check`
// checks the graph that comes out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/text/diagnostic.h"

namespace weft::importing {

struct ConvertedText {
  std::string path, text;
};

// Texels of the foreign file: RGBA bytes, or RGBA floats, from the top row.
struct ConvertedImage {
  std::string path;  // .png for bytes, .exr for floats
  int width = 0, height = 0;
  std::vector<std::uint8_t> bytes;
  std::vector<float> floats;
};

// Paths are relative to the folder that the person names.
struct Converted {
  std::string graph;  // the path of the graph among `texts`
  std::vector<ConvertedText> texts;
  std::vector<ConvertedImage> images;
};

struct ConvertOptions {
  // Of the graph and its folder of shaders: letters, digits and '_'; empty: that of the file.
  std::string name;
  // From the folder that is written to the folder of the foreign file, for pictures that it names. "" is the same.
  std::string sourceFolder;
  std::vector<std::pair<std::string, std::string>> images;  // input, file as the graph shall name it
};

// Reads `path` and, for an ISF file, the .vs beside it. The kind comes from what the file says.
std::optional<Converted> convertFile(const std::string& path, ConvertOptions options,
                                     text::Diagnostics& diagnostics);

// Where the vertex shader of an ISF file would be.
std::string vertexFileOf(const std::string& path);

// An ISF file: inputs become parameters and images, passes passes, what persists a history. The shader keeps its lines: it
// becomes a file of its own, which a small stage file includes behind the declarations that ISF gives every shader.
struct IsfSource {
  std::string_view fragment;                 // the .fs
  std::optional<std::string_view> vertex{};  // the .vs where there is one
  std::string fragmentFile, vertexFile;
};
std::optional<Converted> convertIsf(const IsfSource& source, const ConvertOptions& options,
                                    text::Diagnostics& diagnostics);

// A user shader of mpv: its passes run on a picture instead of a video. The stages RGB, NATIVE, MAINPRESUB, MAIN, SCALED,
// PREOUTPUT and OUTPUT are that picture, one after the other. mpv counts rows from the top: the graph turns the picture over at
// the start and back at the end.
std::optional<Converted> convertMpv(std::string_view text, const std::string& file,
                                    const ConvertOptions& options, text::Diagnostics& diagnostics);

// The text of a graph file as `weft format` writes it: laid out (engine/text/json/edit.h), and a file that was written before the
// language's second edition in its words. Each pass that is "like" one above it is written out whole: what it has of the other
// stands in the place of "like", without comments. Inputs move from "resources" to "inputs", with their comments; each '?' at a
// slot that reads an optional input goes; an `if` at a slot that reads becomes alternatives, except in a pass with "repeat". What
// cannot be decided stays as it is. `text` is what parseJson takes without a report.
std::string layoutGraph(std::string_view text);

}  // namespace weft::importing
