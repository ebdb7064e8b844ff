// A folder of graph files to lay overlays over, and what reading and expanding them gives.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/graph/expand/support.h"
#include "tests/graph/test_folder.h"

namespace weft::graph::test::overlays {

// A folder of files for the time of a test, with a graph to lay overlays over.
class Folder : public TestFolder {
 public:
  Folder() : TestFolder("overlay_test_files") {
    write("base.json", R"({
  "name": "base",
  "parameters": { "gain": { "default": 1.0, "min": 0, "max": 8, "label": "Gain" }, "soft": { "default": true } },
  "description": "to lay overlays over",
  "resources": { "hdr": { "texture": "rgba16f", "size": "screen", "mips": 2 }, "ldr": { "texture": "rgba8", "size": "screen" },
                 "either": ["hdr if $soft", "ldr"] },
  "passes": [
    { "name": "fill", "type": "fullscreen", "shader": "fill.frag.glsl", "write": { "result": "hdr.mip[0]" },
      "parameters": { "gain": "$gain", "tint": { "default": 0.5, "min": 0, "max": 1 } } },
    { "include": "parts/post.json", "bind": { "source": "hdr" } },
    { "name": "show", "type": "fullscreen", "shader": "show.frag.glsl", "read": { "picture": "post.out", "extra": "hdr.mip[0]" },
      "write": { "result": "ldr" } }
  ],
  "present": "ldr"
})");
    write("parts/post.json", R"json({
  "parameters": { "curve": { "default": "filmic", "choices": ["filmic", "linear"] } },
  "inputs": ["source"], "resources": { "out": { "texture": "rgba8", "size": "size(source)" } },
  "passes": [
    { "include": "glow.json", "as": "bloom" },
    { "name": "composite", "type": "fullscreen", "shader": "c.frag.glsl", "read": { "color": "source.mip[0]", "glow": "bloom.glow" },
      "write": { "result": "out" }, "defines": { "CURVE": "$curve" }, "parameters": { "strength": { "default": 0.1 } } }
  ]
})json");
    write("parts/glow.json", R"({
  "inputs": ["source"], "resources": { "glow": { "texture": "rgba16f", "size": 64 } },
  "passes": [ { "name": "spread", "type": "fullscreen", "shader": "g.frag.glsl", "read": { "source": "source.mip[0]" },
      "write": { "result": "glow" } } ]
})");
  }
  // An overlay over base.json with these keys beside "extends".
  std::string over(const std::string& keys) const {
    return write("over.json",
                 "{ \"extends\": \"base.json\"" + std::string(keys.empty() ? "" : ", ") + keys + " }");
  }
};

inline Expanded expandFile(const std::string& path, const std::vector<std::string>& presets = {},
                           const Settings& settings = {}) {
  Expanded result;
  const auto desc = readGraph(path, result.diagnostics, {.presets = presets});
  if (desc) result.graph = expandGraph(*desc, testRegistry(), settings, result.diagnostics);
  return result;
}

inline Expanded fine(const std::string& path, const std::vector<std::string>& presets = {},
                     const Settings& settings = {}) {
  Expanded e = expandFile(path, presets, settings);
  CHECK_MESSAGE(e.text() == "", e.text());
  REQUIRE(e.graph);
  return e;
}

// "W017 over.json 3:5" of every diagnostic of reading.
inline std::string wrong(const std::string& path, const std::vector<std::string>& presets = {}) {
  text::Diagnostics diagnostics;
  readGraph(path, diagnostics, {.presets = presets});
  std::string out;
  for (const auto& d : diagnostics.items()) {
    out += (out.empty() ? "" : "; ") + text::nameOf(d.code) + " " +
           std::filesystem::path(d.place.file ? *d.place.file : "").filename().string() + " " +
           std::to_string(d.place.line) + ":" + std::to_string(d.place.column);
    CHECK_MESSAGE((!d.hint.empty() || !d.expected.empty()), text::format(d));
  }
  return out;
}

inline std::string valueOf(const Expanded& e, const std::string& parameter) {
  for (const ParameterSpec& spec : e.graph->parameters)
    if (spec.path == parameter) return toText(spec.value);
  return "none";
}

}  // namespace weft::graph::test::overlays
