#include <doctest/doctest.h>

#include "engine/graph/read/read.h"
#include "importers/import.h"

using namespace weft;
using namespace weft::importing;

namespace {

std::string laidOut(std::string_view text) {
  return layoutGraph(text);
}

}  // namespace

TEST_CASE("inputs move to their list, with their comments") {
  const std::string made = laidOut(R"J({
  "resources": {
    "hdr": { "input": "texture" },
    // What moves.
    "velocity": { "input": "texture", "optional": true, "history": 1 },
    "ldr": { "texture": "rgba8", "size": 8 } // the picture
  },
  "passes": [ { "name": "p", "type": "fullscreen", "shader": "a.frag.glsl",
    "read": { "hdr": "hdr?", "v": "velocity.mip[0] as linear ?" }, "write": { "r": "ldr" } } ] })J");
  CHECK(made == R"J({
  "inputs": [
    "hdr",
    // What moves.
    { "velocity ?": { "history": 1 } }
  ],
  "resources": {
    "ldr": { "texture": "rgba8", "size": 8 } // the picture
  },
  "passes": [
    { "name": "p", "type": "fullscreen", "shader": "a.frag.glsl",
      "read": { "hdr": "hdr?", "v": "velocity.mip[0] as linear" }, "write": { "r": "ldr" } }
  ]
}
)J");
  CHECK(laidOut(made) == made);
  text::Diagnostics said;
  graph::readGraphText(made, "test.json", said);
  CHECK_MESSAGE(said.empty(), said.text());
}

TEST_CASE("an if at a slot becomes an alternative, where it can be decided") {
  const std::string made = laidOut(R"J({
  "parameters": { "on": { "default": true } },
  "resources": { "hdr": { "texture": "rgba8", "size": 8, "clear": 0 }, "ldr": { "texture": "rgba8", "size": 8 } },
  "passes": [ { "name": "p", "type": "fullscreen", "shader": "a.frag.glsl",
    "read": { "soft": "hdr.mip[0] as linear if $on ?", "ldr": "hdr if !$on ?", "again": "hdr if $on?", "other": "ibl.map.mip[0] if $on" }, "write": { "r": "ldr" } },
    { "name": "q", "type": "fullscreen", "shader": "a.frag.glsl", "repeat": { "i": [0, 1] }, "read": { "s": "hdr if i > 0 ?" } } ] })J");
  CHECK(made.find(R"(["hdr if $on"])") != std::string::npos);
  CHECK(made.find(R"("p_ldr": ["hdr if !$on"])") != std::string::npos);
  CHECK(
      made.find(
          R"("read": { "soft": "soft.mip[0] as linear ?", "ldr": "p_ldr ?", "again": "again ?", "other": "other.mip[0]" })") !=
      std::string::npos);
  CHECK(made.find(R"(["ibl.map if $on"])") != std::string::npos);
  CHECK(made.find(R"("s": "hdr if i > 0 ?")") != std::string::npos);
}
