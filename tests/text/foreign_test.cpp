// Words of other engines and APIs, and what Weft and GLSL call the same thing; words of GLSL.
#include <doctest/doctest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>

#include "engine/text/files/file.h"
#include "engine/text/json/edit.h"
#include "engine/text/words/words.h"

using namespace weft::text;

TEST_CASE("the table of foreign words: what is to be written, then the words that mean it, each once") {
  std::ifstream file(dataFolder() + "/engine/text/words/foreign.json");
  const auto table = loadJson(std::string(std::istreambuf_iterator(file), {}));
  for (const auto& [kind, rows] : table.items()) {
    std::set<std::string> seen;
    for (const auto& [ours, words] : rows.items()) {
      CHECK_MESSAGE(!ours.empty(), kind);
      const auto see = [&](const nlohmann::ordered_json& list) {
        for (const std::string theirs : list) CHECK_MESSAGE(seen.insert(theirs).second, kind, ": ", theirs);
      };
      if (words.is_array())
        see(words);
      else
        for (const auto& [hint, list] : words.items()) see(list);
    }
    CHECK_MESSAGE(!seen.empty(), kind);
  }
}

TEST_CASE("a word of each kind is found however it is decorated") {
  const std::pair<const char*, const char*> kWords[] = {
      {"graph_key", "nodes"},       {"pass_key", "renderToScreen"},
      {"texture_key", "format"},    {"state_key", "ZTest"},
      {"state_word", "GL_LEQUAL"},  {"state_word", "One One"},
      {"value_key", "value"},       {"value_type", "Range(0, 1)"},
      {"sampling", "LinearFilter"}, {"expression", "clamp"},
      {"value", "width"},           {"import_type", "texture"},
      {"shader_name", "saturate"}};
  for (const auto& [kind, word] : kWords) CHECK_MESSAGE(!hintForForeign(kind, word).empty(), word);
  CHECK(hintForForeign("state_word", "less-equal") == "write 'less_equal'");
  CHECK(findForeignWord("texture_key", "width").key == "size");
  CHECK_FALSE(findForeignWord("texture_key", "width").isOnlyKey);
  CHECK(findForeignWord("value_key", "initial").key == "default");
  CHECK(findForeignWord("value_key", "initial").isOnlyKey);
  CHECK(hintForForeign("value_key", "initial") == "write \"default\"");
  // GLSL tells cases apart, and a word that nobody knows has no hint.
  CHECK(hintForForeign("shader_name", "Saturate").empty());
  CHECK(hintForForeign("pass_key", "read").empty());
}

TEST_CASE("texture formats of other APIs become the one that is meant") {
  const std::pair<const char*, const char*> kFormats[] = {
      {"RGBA8_UNORM", "rgba8"},
      {"R8G8B8A8_UNORM", "rgba8"},
      {"DXGI_FORMAT_R8G8B8A8_UNORM_SRGB", "srgb8_a8"},
      {"DXGI_FORMAT_R16G16B16A16_FLOAT", "rgba16f"},
      {"DXGI_FORMAT_R11G11B10_FLOAT", "r11f_g11f_b10f"},
      {"VK_FORMAT_R16G16B16A16_SFLOAT", "rgba16f"},
      {"VK_FORMAT_R32G32_SFLOAT", "rg32f"},
      {"VK_FORMAT_D32_SFLOAT", "depth32f"},
      {"VK_FORMAT_R8_UNORM", "r8"},
      {"VK_FORMAT_R32_UINT", "r32ui"},
      {"GL_RGBA16F", "rgba16f"},
      {"GL_SRGB8_ALPHA8", "srgb8_a8"},
      {"GL_DEPTH_COMPONENT24", "depth24"},
      {"bgra8unorm", "rgba8"},
      {"rgba16float", "rgba16f"},
      {"rgb10a2unorm", "rgb10_a2"},
      {"depth24plus-stencil8", "depth24_stencil8"},
      {"RGBAHalf", "rgba16f"},
      {"R8G8B8A8_SNORM", "rgba8_snorm"},
      {"rgb8", "rgba8"},
      {"rgb16f", "rgba16f"},
      {"srgb8", "srgb8_a8"},
      {"rgba32", "rgba32f"},
      {"D32", "depth32f"},
      {"depth", "depth32f"},
      {"D24S8", "depth24_stencil8"},
      {"RGBAFormat", "rgba8"},
      {"THREE.RedFormat", "r8"},
      {"HalfFloatType", "rgba16f"},
      {"FloatType", "rgba32f"},
      {"DepthStencilFormat", "depth24_stencil8"},
  };
  for (const auto& [theirs, ours] : kFormats) CHECK_MESSAGE(hintForForeign("format", theirs) == ours, theirs);
  for (const char* none : {"", "colour", "rgba12", "texture", "bc7"})
    CHECK_MESSAGE(hintForForeign("format", none).empty(), none);
}

TEST_CASE("words that GLSL keeps for itself") {
  for (const char* word : {"sample", "input", "output", "filter", "vec4", "mat3x2", "sampler2DArray",
                           "uimage3D", "gl_FragCoord", "main", "half"})
    CHECK_MESSAGE(isGlslWord(word), word);
  for (const char* name : {"source", "color", "texture", "vec5", "sampler", "image", "mat", "samples",
                           "position", "result", "mix"})
    CHECK_MESSAGE(!isGlslWord(name), name);
}

TEST_CASE("functions that GLSL has by itself") {
  for (const char* name : {"mix", "texture", "atomicAnd", "textureGatherOffset", "uaddCarry", "fwidthCoarse"})
    CHECK_MESSAGE(isGlslFunction(name), name);
  for (const char* name : {"saturate", "main", "mixed", "Texture"})
    CHECK_MESSAGE(!isGlslFunction(name), name);
}
