// What the tests of importers share: files of tests/convert, and conversion of text in memory.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/graph/desc.h"
#include "engine/graph/expand/expand.h"
#include "engine/graph/read/read.h"
#include "engine/text/diagnostic.h"
#include "importers/import.h"
#include "tests/graph/test_registry.h"

namespace weft::importing::test {

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

inline std::optional<Converted> convertIsfText(std::string_view fragment, text::Diagnostics& diagnostics,
                                               std::string_view vertex = {}) {
  IsfSource source{.fragment = fragment, .fragmentFile = "x.fs", .vertexFile = "x.vs"};
  if (!vertex.empty()) source.vertex = vertex;
  return convertIsf(source, {.name = "x"}, diagnostics);
}

inline std::optional<Converted> convertMpvText(std::string_view text, text::Diagnostics& diagnostics) {
  return convertMpv(text, "x.glsl", {.name = "x"}, diagnostics);
}

inline std::string codesOf(const text::Diagnostics& diagnostics) {
  std::string codes;
  for (const text::Diagnostic& d : diagnostics.items()) codes += text::nameOf(d.code) + " ";
  return codes;
}

// The text of the file whose path ends so.
inline std::string partOf(const Converted& converted, std::string_view ending) {
  for (const ConvertedText& text : converted.texts)
    if (text.path.ends_with(ending)) return text.text;
  FAIL("no file " << ending);
  return {};
}

// Whether Weft reads the graph and expands it, with a picture and without. What the values of a foreign file make wrong, a
// size of 0 or a division by it, is no fault of the import: `values` allows it.
inline bool isSound(const Converted& converted, std::string& why, bool values = false) {
  text::Diagnostics diagnostics;
  const auto desc = graph::readGraphText(partOf(converted, converted.graph), converted.graph, diagnostics);
  if (!desc || !diagnostics.empty()) {
    why = diagnostics.text();
    return false;
  }
  for (const bool present : {false, true}) {
    graph::Registry registry = graph::test::testRegistry();
    registry.factsOf = [present](const graph::ImportRequest& request) {
      graph::ImportFacts facts = graph::test::testFacts({}, request);
      if (request.type != "image") return facts;
      facts.exists = present || !request.arguments[0].second.symbol.empty();
      facts.format = graph::Format::rgba8;
      facts.width = 96;
      facts.height = 64;
      return facts;
    };
    text::Diagnostics said;
    const auto flat = graph::expandGraph(*desc, registry, {.screenWidth = 96, .screenHeight = 64}, said);
    for (const text::Diagnostic& d : said.items()) {
      const bool ofValues = d.code == text::Code::numberOutOfRange || d.code == text::Code::noFiniteResult ||
                            d.code == text::Code::texturesTooLarge || d.code == text::Code::limitExceeded;
      if (d.severity == text::Severity::error && !(values && ofValues)) {
        why = said.text();
        return false;
      }
    }
    if (!flat && !values) return false;
  }
  return true;
}

}  // namespace weft::importing::test
