// The matrix against what is known of a small graph: which passes it needs, which pairs, which values.
#include "engine/graph/survey/matrix.h"

#include <doctest/doctest.h>

#include <set>

#include "tests/graph/expand/support.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;

namespace {

// Either of two passes can make 'hdr'; without both nothing is shown. 'glow' is optional.
constexpr const char* kGraph = R"({
  "parameters": {
    "curve": { "type": "choice", "choices": ["soft", "hard"], "default": "soft" },
    "bloom": { "type": "bool", "default": true },
    "levels": { "type": "int", "default": 2, "min": 0, "max": 4 }
  },
  "resources": {
    "sun": { "texture": "rgba8", "size": 8 }, "sky": { "texture": "rgba8", "size": 8 },
    "hdr": ["sun", "sky"],
    "glow": { "texture": "rgba8", "size": "8/$levels" },
    "ldr": { "texture": "rgba8", "size": 8 }
  },
  "passes": [
    { "name": "sun", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "result": "sun" } },
    { "name": "sky", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "result": "sky" } },
    { "name": "glow", "type": "fullscreen", "shader": "a.frag.glsl", "enabled": "$bloom",
      "read": { "source": "hdr" }, "write": { "result": "glow" } },
    { "name": "show", "type": "fullscreen", "shader": "a.frag.glsl", "defines": { "CURVE": "$curve" },
      "read": { "source": "hdr", "glow": "glow?" }, "write": { "result": "ldr" } }
  ],
  "present": "ldr"
})";

struct Tried {
  Matrix matrix;
  std::set<std::string> made;  // variations that make a graph
};

Tried tryAll(const std::string& text, bool pairs = true) {
  text::Diagnostics diagnostics;
  const auto desc = readGraphText(text, "matrix.json", diagnostics);
  REQUIRE_MESSAGE(desc, diagnostics.text());
  Tried tried;
  tried.matrix = tryMatrix(*desc, testRegistry(), {},
                           {.pairs = pairs, .visit = [&](const Variation& variation, auto graph) {
                              CHECK(graph);
                              tried.made.insert(variation.text());
                            }});
  return tried;
}

}  // namespace

TEST_CASE("single passes, pairs and values are tried, each once") {
  const Tried tried = tryAll(kGraph);
  const Matrix& matrix = tried.matrix;
  CHECK(matrix.passes == 4);
  CHECK(matrix.pairs == 3);   // of the three that the graph does without
  CHECK(matrix.values == 6);  // two words, two switches, two ends of a range
  REQUIRE(matrix.needed.size() == 2);
  CHECK(matrix.needed[0].variation.text() == "--disable show");
  CHECK(matrix.needed[1].variation.text() == "--disable sun --disable sky");
  // A value that the file offers and that divides by zero.
  REQUIRE(matrix.broken.size() == 1);
  CHECK(matrix.broken[0].variation.text() == "--set levels=0");
  CHECK(matrix.broken[0].said.contains(text::Code::noFiniteResult));
  const std::set<std::string> made = {"as it is",
                                      "--disable sun",
                                      "--disable sky",
                                      "--disable glow",
                                      "--disable sun --disable glow",
                                      "--disable sky --disable glow",
                                      "--set curve=soft",
                                      "--set curve=hard",
                                      "--set bloom=false",
                                      "--set bloom=true",
                                      "--set levels=4"};
  CHECK(tried.made == made);
}

TEST_CASE("without pairs only single passes are disabled") {
  const Tried tried = tryAll(kGraph, false);
  CHECK(tried.matrix.pairs == 0);
  CHECK(tried.matrix.broken.size() == 1);
}
