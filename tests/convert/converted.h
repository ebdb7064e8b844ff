// What the tests of engine/convert share: files of tests/convert, and conversion of text in memory.
#pragma once

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/diagnostic.h"
#include "engine/convert/isf/convert_isf.h"
#include "engine/convert/mpv/convert_mpv.h"
#include "engine/graph/desc.h"
#include "engine/graph/read/read.h"

namespace weft::convert::test {

inline const std::filesystem::path kFolder = std::filesystem::path(WEFT_SOURCE_DIR) / "tests/convert";

inline std::string textOf(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  REQUIRE_MESSAGE(in, path.string());
  return {std::istreambuf_iterator<char>(in), {}};
}

inline std::vector<std::filesystem::path> filesIn(const char* folder, const char* extension) {
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder / folder))
    if (entry.path().extension() == extension) found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  REQUIRE(found.size() >= 8);
  return found;
}

inline std::optional<Converted> convertIsfText(std::string_view fragment, base::Diagnostics& diagnostics,
                                               std::string_view vertex = {}) {
  IsfSource source{.fragment = fragment,
                   .vertex = vertex,
                   .fragmentFile = "x.fs",
                   .vertexFile = "x.vs",
                   .hasVertex = !vertex.empty()};
  return convertIsf(source, {.name = "x"}, diagnostics);
}

inline std::optional<Converted> convertMpvText(std::string_view text, base::Diagnostics& diagnostics) {
  return convertMpv(text, "x.glsl", {.name = "x"}, diagnostics);
}

inline std::string codesOf(const base::Diagnostics& diagnostics) {
  std::string codes;
  for (const base::Diagnostic& d : diagnostics.items()) codes += base::nameOf(d.code) + " ";
  return codes;
}

// The text of the file whose path ends so.
inline std::string partOf(const Converted& converted, std::string_view ending) {
  for (const ConvertedText& text : converted.texts)
    if (text.path.ends_with(ending)) return text.text;
  FAIL("no file " << ending);
  return {};
}

// Whether Weft's own reader takes the graph.
inline bool isReadable(const Converted& converted, std::string& why) {
  base::Diagnostics diagnostics;
  const auto desc = graph::readGraphText(partOf(converted, converted.graph), converted.graph, diagnostics);
  why = diagnostics.text();
  return desc && diagnostics.empty();
}

}  // namespace weft::convert::test
