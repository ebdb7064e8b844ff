// One misspelt key is one mistake: it is reported, and read as what it is meant for.
#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/graph/read/overlay_files.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;
using namespace weft::graph::test::overlays;

namespace {

const char* const kWholeGraph = R"({
  "parameters": { "gain": { "default": 1.0, "min": 0, "max": 8 } },
  "let": { "n": 4 },
  "resources": {
    "seed": { "texture": "r8", "size": 8 },
    "cells": { "texture": "r8", "size": 8, "array": 4, "history": 1, "first": "seed" },
    "sky": { "texture": "rgba8", "size": 8, "view": "cube" },
    "keys": { "buffer": "$n*4", "clear": 0 },
    "ldr": { "texture": "rgba8", "size": "screen" }
  },
  "passes": [
    { "name": "sow", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "result": "seed" } },
    { "name": "live", "type": "fullscreen", "shader": "a.frag.glsl", "repeat": { "i": [0, 3] },
      "read": { "before": "cells[i]@-1" }, "write": { "result": "cells[i]" }, "parameters": { "gain": "$gain + i" } },
    { "name": "faces", "type": "fullscreen", "shader": "a.frag.glsl", "write": { "result": "sky" } },
    { "name": "count", "type": "compute", "shader": "a.comp.glsl", "threads": "$n", "modify": { "keys": "keys" } },
    { "name": "show", "type": "fullscreen", "shader": "a.frag.glsl",
      "read": { "cells": "cells[3]", "keys": "keys", "sky": "sky.face[1]" }, "write": { "result": "ldr" } }
  ],
  "present": "ldr"
})";

const char* const kOverlayOfBase = R"({
  "extends": "base.json",
  "resources": { "bins": { "buffer": 64, "clear": 0 }, "paper": { "texture": "rgba8", "size": 8, "clear": 0 } },
  "passes": [
    { "name": "count", "before": "show", "type": "compute", "shader": "a.comp.glsl", "threads": 4,
      "read": { "paper": "paper" }, "modify": { "bins": "bins" } },
    { "name": "show", "read": { "bins": "bins" } }
  ]
})";

std::string withKey(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE_MESSAGE(at != std::string::npos, from);
  return text.replace(at, from.size(), to);
}

void checkOneMistake(Folder& folder, const std::string& text, const std::string& right,
                     const std::string& wrong) {
  const std::string path = folder.write("g.json", withKey(text, "\"" + right + "\":", "\"" + wrong + "\":"));
  const text::Diagnostics said = expandFile(path).diagnostics;
  REQUIRE_MESSAGE(said.size() == 1, wrong << "\n" << said.text());
  CHECK(said.items()[0].code == text::Code::unknownKey);
  CHECK_MESSAGE(said.items()[0].hint.find("\"" + right + "\"") != std::string::npos, said.text());
}

}  // namespace

TEST_CASE("a misspelt key gives one error, whatever needs what it says") {
  Folder folder;
  const std::pair<const char*, const char*> kWrong[] = {
      {"resources", "resorces"}, {"parameters", "paramters"},
      {"let", "lets"},           {"passes", "pases"},
      {"present", "presnet"},    {"array", "aray"},
      {"history", "histroy"},    {"view", "veiw"},
      {"buffer", "bufer"},       {"clear", "claer"},
      {"texture", "textrue"},    {"size", "sise"},
      {"shader", "shadr"},       {"type", "tpye"},
      {"repeat", "repat"},       {"threads", "thread"},
      {"modify", "modfy"},       {"default", "value"},
      {"read", "raed"},          {"write", "wirte"},
  };
  for (const auto& [right, wrong] : kWrong) checkOneMistake(folder, kWholeGraph, right, wrong);
}

TEST_CASE("a misspelt key of an overlay or a preset gives one error") {
  Folder folder;
  const std::pair<const char*, const char*> kWrong[] = {{"extends", "extend"},
                                                        {"before", "befor"},
                                                        {"buffer", "bufer"},
                                                        {"texture", "textrue"},
                                                        {"resources", "resorces"}};
  for (const auto& [right, wrong] : kWrong) checkOneMistake(folder, kOverlayOfBase, right, wrong);
  const std::string preset =
      folder.write("preset.json", R"({ "passes": [ { "nmae": "show", "enabled": true } ] })");
  const text::Diagnostics said =
      expandFile(folder.write("g.json", R"({ "extends": "base.json" })"), {preset}).diagnostics;
  REQUIRE_MESSAGE(said.size() == 1, said.text());
  CHECK(said.items()[0].hint == "did you mean \"name\"?");
}

TEST_CASE("a key that is near one that is there already, or near none, is only reported") {
  Folder folder;
  const std::string twice =
      withKey(kWholeGraph, "\"history\": 1", "\"history\": 1, \"histroy\": 2, \"flavour\": 3, \"mpss\": 4");
  const Expanded expanded = expandFile(folder.write("g.json", twice));
  CHECK_MESSAGE(expanded.diagnostics.size() == 3, expanded.text());
  for (const text::Diagnostic& d : expanded.diagnostics.items()) CHECK(d.code == text::Code::unknownKey);
}

TEST_CASE("a repeat of a wrong form gives one error, whatever uses its index") {
  Folder folder;
  for (const char* form : {"7", "[0, 3]", "{ \"i\": 4 }", "{ \"i\": [0] }", "{ \"i\": [0, null] }"}) {
    const std::string text = withKey(kWholeGraph, "{ \"i\": [0, 3] }", form);
    const Expanded expanded = expandFile(folder.write("g.json", text));
    REQUIRE_MESSAGE(expanded.diagnostics.size() == 1, form << "\n" << expanded.text());
    CHECK(expanded.diagnostics.items()[0].code == text::Code::wrongType);
  }
}

TEST_CASE(
    "a resource of an included file, and a misspelt one in a slot of its name, get the name that is meant") {
  Folder folder;
  const auto hintFor = [&](const std::string& path, text::Code code) {
    return expandFile(path).of(code).hint;
  };
  CHECK(hintFor(folder.over(R"("passes": [ { "name": "show", "read": { "picture": "glow" } } ])"),
                text::Code::unknownResource) == "did you mean 'post.bloom.glow'?");
  CHECK(hintFor(folder.write("g.json", withKey(kWholeGraph, "\"sky\": \"sky.face[1]\"", "\"sky\": \"skyy\"")),
                text::Code::unknownResource) == "did you mean 'sky'?");
}
