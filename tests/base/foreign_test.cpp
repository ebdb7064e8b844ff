// Words of other engines and APIs, and what Weft and GLSL call the same thing.
#include <doctest/doctest.h>

#include <string>
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
      {"RGBAFormat", "rgba8"},
      {"THREE.RedFormat", "r8"},
      {"HalfFloatType", "rgba16f"},
      {"FloatType", "rgba32f"},
      {"DepthStencilFormat", "depth24_stencil8"},
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

TEST_CASE("keys of states and of parameters, blends and tests as other programs write them") {
  const std::pair<const char*, const char*> kBlends[] = {
      {"GL_ONE", "write 'add', which is glBlendFunc(GL_ONE, GL_ONE)"},
      {"One One", "write 'add'"},
      {"SrcAlpha OneMinusSrcAlpha", "write 'alpha'"},
      {"One OneMinusSrcAlpha", "write 'premultiplied'"},
      {"DstColor Zero", "write 'multiply'"},
      {"AdditiveBlending", "write 'add'"},
      {"NormalBlending", "write 'alpha'"},
      {"NoBlending", "write 'none'"},
      {"LessEqualDepth", "depth is reversed, the near plane is 1: write 'greater_equal'"},
      {"DoubleSide", "write 'none'"},
  };
  for (const auto& [theirs, hint] : kBlends)
    CHECK_MESSAGE(hintForForeign(Foreign::state_word, theirs) == hint, theirs);
  for (const char* key : {"transparent", "side", "ZTest", "ZWrite", "depthFunc", "colorMask", "stencil"})
    CHECK_MESSAGE(!hintForForeign(Foreign::state_key, key).empty(), key);
  for (const char* key : {"value", "range", "options", "description"})
    CHECK_MESSAGE(!hintForForeign(Foreign::value_key, key).empty(), key);
  for (const char* key : {"fragmentShader", "renderToScreen"})
    CHECK_MESSAGE(!hintForForeign(Foreign::pass_key, key).empty(), key);
  for (const char* word : {"LinearFilter", "RepeatWrapping", "LinearMipmapLinearFilter"})
    CHECK_MESSAGE(!hintForForeign(Foreign::sampling, word).empty(), word);
  CHECK(hintForForeign(Foreign::value_type, "Range(0, 1)") ==
        "write \"float\", and the range with \"min\" and \"max\"");
  CHECK(hintForForeign(Foreign::value, "width") == "write 'screen.x', or 'size(name).x' of a texture");
}

TEST_CASE("names in shaders of other programs, and what their hints name") {
  struct Row {
    const char *name, *says;
  };
  constexpr Row kRows[] = {
      // Shadertoy
      {"iTime", "'time'"},
      {"iTimeDelta", "'delta_time'"},
      {"iFrame", "'frame'"},
      {"iFrameRate", "1.0 / delta_time"},
      {"iResolution", "'viewport'"},
      {"iMouse", "\"mouse\": \"@mouse\""},
      {"iMouse", "'shadertoyMouse()'"},
      {"iDate", "parameter"},
      {"iSampleRate", "sound"},
      {"iChannel0", "uniform sampler2D"},
      {"iChannel3", "uniform sampler2D"},
      {"iChannelResolution", "textureSize"},
      {"iChannelTime", "'time'"},
      {"iGlobalTime", "'time'"},
      // The Book of Shaders, GLSL Sandbox
      {"u_time", "'time'"},
      {"u_resolution", "'viewport'"},
      {"u_mouse", "'mouse_state[0].position'"},

      {"backbuffer", "\"history\""},
      // ISF
      {"TIME", "'time'"},
      {"TIMEDELTA", "'delta_time'"},
      {"FRAMEINDEX", "'frame'"},
      {"RENDERSIZE", "'viewport'"},
      {"PASSINDEX", "\"defines\""},
      {"DATE", "parameter"},
      {"isf_FragNormCoord", "'in vec2 uv;'"},
      {"IMG_PIXEL", "texelFetch"},
      {"IMG_NORM_PIXEL", "texture("},
      {"IMG_THIS_PIXEL", "texelFetch"},
      {"IMG_THIS_NORM_PIXEL", "texture("},
      {"IMG_SIZE", "textureSize"},
      // three.js
      {"vUv", "'in vec2 uv;'"},
      {"tDiffuse", "uniform sampler2D"},
      {"cameraPosition", "'eye'"},
      {"viewMatrix", "'view'"},
      {"projectionMatrix", "'projection'"},
      {"uTime", "'time'"},
      {"uMouse", "@mouse"},
      {"texture2DLodEXT", "textureLod"},
      // Unity
      {"_Time", "'time'"},
      {"unity_DeltaTime", "'delta_time'"},
      {"_ScreenParams", "'viewport'"},
      {"_MainTex", "uniform sampler2D"},
      {"_MainTex_TexelSize", "textureSize"},
      {"_WorldSpaceCameraPos", "'eye'"},
      {"_CameraDepthTexture", "depth"},
      {"UNITY_MATRIX_VP", "'view_projection'"},
      {"SAMPLE_TEXTURE2D", "texture("},
      {"texCUBE", "texture("},
      {"saturate", "clamp"},
      // Godot
      {"UV", "'in vec2 uv;'"},
      {"SCREEN_UV", "'in vec2 uv;'"},
      {"COLOR", "out vec4"},
      {"FRAGCOORD", "gl_FragCoord"},
      {"TEXTURE", "uniform sampler2D"},
      {"TEXTURE_PIXEL_SIZE", "textureSize"},
      {"SCREEN_PIXEL_SIZE", "1.0 / viewport"},
      {"VIEWPORT_SIZE", "'viewport'"},
      {"SCREEN_TEXTURE", "uniform sampler2D"},
      {"INV_PROJECTION_MATRIX", "'inverse_view_projection'"},
      // Bonzomatic
      {"fGlobalTime", "'time'"},
      {"fFrameTime", "'delta_time'"},
      {"v2Resolution", "'viewport'"},
      {"texFFT", "sound"},
      {"texPreviousFrame", "\"history\""},
      {"texNoise", "uniform sampler2D"},
      {"out_color", "out vec4"},
  };
  for (const auto& [name, says] : kRows) {
    const std::string hint = hintForForeign(Foreign::shader_name, name);
    CHECK_MESSAGE(hint.find(says) != std::string::npos, name, ": ", hint);
  }
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
