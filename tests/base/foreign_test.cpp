// Words of other engines and APIs, and what Weft and GLSL call the same thing.
#include <doctest/doctest.h>

#include <utility>

#include "engine/base/words/foreign_formats.h"
#include "engine/base/words/foreign_words.h"
#include "engine/base/words/glsl_words.h"

using namespace weft::base;

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
  };
  for (const auto& [theirs, ours] : kFormats) CHECK_MESSAGE(formatMeantBy(theirs) == ours, theirs);
  for (const char* none : {"", "colour", "rgba12", "texture", "bc7"})
    CHECK_MESSAGE(formatMeantBy(none).empty(), none);
}

TEST_CASE("states, keys, types, functions and names of GLSL") {
  CHECK(hintForForeign(Foreign::state_word, "GL_LEQUAL") == "write 'less_equal'");
  CHECK(hintForForeign(Foreign::state_word, "gequal") == "write 'greater_equal'");
  CHECK(hintForForeign(Foreign::state_word, "less-equal") == "write 'less_equal'");
  CHECK(hintForForeign(Foreign::pass_key, "inputs") == "slots that are read stand in \"read\"");
  CHECK(hintForForeign(Foreign::texture_key, "format") == "the format is the value of \"texture\"");
  CHECK(hintForForeign(Foreign::value_type, "Float3") == "write \"vec3\"");
  CHECK(hintForForeign(Foreign::expression, "round") == "write 'floor(a + 0.5)'");
  CHECK(hintForForeign(Foreign::shader_name, "saturate") == "GLSL says 'clamp(x, 0.0, 1.0)'");
  // GLSL tells cases apart, and a name that nobody knows has no hint.
  CHECK(hintForForeign(Foreign::shader_name, "Saturate").empty());
  CHECK(hintForForeign(Foreign::pass_key, "read").empty());
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
