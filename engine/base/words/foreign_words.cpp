#include "engine/base/words/foreign_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "engine/base/chars.h"
#include "engine/base/words/foreign_keys.h"
#include "engine/base/words/foreign_shader_names.h"

namespace weft::base {

namespace {

constexpr ForeignWord kGraphKeys[] = {
    {"textures", "textures and buffers stand in \"resources\""},
    {"buffers", "textures and buffers stand in \"resources\""},
    {"images", "textures and buffers stand in \"resources\""},
    {"targets", "textures and buffers stand in \"resources\""},
    {"nodes", "write \"passes\""},
    {"effects", "write \"passes\""},
    {"steps", "write \"passes\""},
    {"variables", "values that are set stand in \"parameters\", computed ones in \"let\""},
    {"uniforms", "values that are set stand in \"parameters\", computed ones in \"let\""},
    {"constants", "computed values stand in \"let\""},
    {"include", "an include stands in \"passes\": { \"include\": \"file.json\" }"},
    {"includes", "an include stands in \"passes\": { \"include\": \"file.json\" }"},
    {"output", "what is shown stands in \"present\""},
    {"screen", "what is shown stands in \"present\""},
    {"backbuffer", "what is shown stands in \"present\""},
};
constexpr ForeignWord kStateWords[] = {
    {"lequal", "write 'less_equal'"},
    {"gequal", "write 'greater_equal'"},
    {"notequal", "write 'not_equal'"},
    {"lessequal", "write 'less_equal'"},
    {"lessorequal", "write 'less_equal'"},
    {"greaterequal", "write 'greater_equal'"},
    {"greaterorequal", "write 'greater_equal'"},
    {"less", "write 'less'"},
    {"greater", "write 'greater'"},
    {"equal", "write 'equal'"},
    {"always", "write 'always'"},
    {"never", "write 'never'"},
    {"<", "write 'less'"},
    {"<=", "write 'less_equal'"},
    {">", "write 'greater'"},
    {">=", "write 'greater_equal'"},
    {"==", "write 'equal'"},
    {"additive", "write 'add'"},
    {"alphablend", "write 'alpha'"},
    {"over", "write 'alpha', or 'premultiplied' where colour is multiplied by alpha already"},
    {"blend", "write 'alpha', or 'premultiplied' where colour is multiplied by alpha already"},
    {"srcalpha", "write 'alpha'"},
    {"modulate", "write 'multiply'"},
    {"opaque", "write 'none'"},
    {"off", "write 'none', or 'always' for a depth test"},
    {"cw", "counter-clockwise triangles are the front; write 'front' or 'back'"},
    {"ccw", "counter-clockwise triangles are the front; write 'front' or 'back'"},
    {"backface", "write 'back'"},
    {"frontface", "write 'front'"},
    {"wireframe", "write 'line'"},
    {"lt", "write 'less'"},
    {"le", "write 'less_equal'"},
    {"lte", "write 'less_equal'"},
    {"gt", "write 'greater'"},
    {"ge", "write 'greater_equal'"},
    {"gte", "write 'greater_equal'"},
    {"ne", "write 'not_equal'"},
    {"!=", "write 'not_equal'"},
    {"disabled", "write 'none', or 'always' for a depth test"},
    {"back", "write 'back'"},
    {"front", "write 'front'"},
    {"one", "write 'add', which is glBlendFunc(GL_ONE, GL_ONE)"},
    {"oneone", "write 'add'"},
    {"oneoneminussrcalpha", "write 'premultiplied'"},
    {"dstcolorzero", "write 'multiply'"},
    {"zerosrccolor", "write 'multiply'"},
    {"noblending", "write 'none'"},
    {"normalblending", "write 'alpha'"},
    {"additiveblending", "write 'add'"},
    {"multiplyblending", "write 'multiply'"},
    {"customblending", "blends are words: 'add', 'alpha', 'premultiplied', 'multiply', 'min', 'max'"},
    {"lessdepth", "depth is reversed, the near plane is 1: write 'greater'"},
    {"lessequaldepth", "depth is reversed, the near plane is 1: write 'greater_equal'"},
    {"alwaysdepth", "write 'always'"},
    {"doubleside", "write 'none'"},
    {"frontside", "write 'back', which culls backs"},
    {"backside", "write 'front', which culls fronts"},
    {"srcalphaoneminussrcalpha", "write 'alpha'"},
    {"premult", "write 'premultiplied'"},
    {"premultipliedalpha", "write 'premultiplied'"},
    {"solid", "write 'fill'"},
};
constexpr const char* kFactors =
    "factors of OpenGL are words here: 'alpha' is src_alpha, one_minus_src_alpha; "
    "'premultiplied' is one, one_minus_src_alpha; 'add' is one, one";
constexpr ForeignWord kStateKeys[] = {
    {"src", kFactors},
    {"dst", kFactors},
    {"source", kFactors},
    {"destination", kFactors},
    {"src_color", kFactors},
    {"dst_color", kFactors},
    {"src_alpha", kFactors},
    {"dst_alpha", kFactors},
    {"srccolor", kFactors},
    {"dstcolor", kFactors},
    {"src_factor", kFactors},
    {"dst_factor", kFactors},
    {"srcfactor", kFactors},
    {"dstfactor", kFactors},
    {"func", kFactors},
    {"factors", kFactors},

    {"transparent", "write \"blend\": \"alpha\""},
    {"blending", "write \"blend\": \"add\""},
    {"blendmode", "write \"blend\": \"add\""},
    {"blendfunc", "write \"blend\": \"add\""},
    {"side", "write \"cull\": \"none\" for both sides, \"back\" for fronts only"},
    {"culling", "write \"cull\": \"back\""},
    {"cullmode", "write \"cull\": \"back\""},
    {"cull_mode", "write \"cull\": \"back\""},
    {"cullface", "write \"cull\": \"back\""},
    {"ztest", "write \"depth_test\": \"greater\": depth is reversed, the near plane is 1"},
    {"zfunc", "write \"depth_test\": \"greater\": depth is reversed, the near plane is 1"},
    {"depthfunc", "write \"depth_test\": \"greater\": depth is reversed, the near plane is 1"},
    {"depth_func", "write \"depth_test\": \"greater\": depth is reversed, the near plane is 1"},
    {"depthcompare", "write \"depth_test\": \"greater\": depth is reversed, the near plane is 1"},
    {"zwrite", "write \"depth_write\": false"},
    {"depthmask", "write \"depth_write\": false"},
    {"wireframe", "write \"polygon\": \"line\""},
    {"fillmode", "write \"polygon\": \"line\""},
    {"polygonoffset", "write \"offset\": [factor, units]"},
    {"colormask", "there is none: write fewer outputs, or combine them in the shader"},
    {"color_mask", "there is none: write fewer outputs, or combine them in the shader"},
    {"stencil", "there is no stencil test: a shader can read 'depth.stencil' and discard"},
    {"clear", "a texture says with what it begins: \"clear\" in \"resources\""},
    {"color_write", "there is none: write fewer outputs, or combine them in the shader"},
    {"depth", "write \"depth_test\": \"greater\": depth is reversed, the near plane is 1"},
    {"depth_compare", "write \"depth_test\": \"greater\": depth is reversed, the near plane is 1"},
    {"depthtest", "write \"depth_test\": \"greater\": depth is reversed, the near plane is 1"},
    {"depth_stencil", "write \"depth_test\": \"greater\", \"depth_write\": false"},
    {"depthwrite", "write \"depth_write\": false"},
    {"depth_mask", "write \"depth_write\": false"},
    {"fill_mode", "write \"polygon\": \"line\""},
    {"depth_bias", "write \"offset\": [factor, units]"},
    {"polygon_offset", "write \"offset\": [factor, units]"},
    {"blend_mode", "write \"blend\": \"add\""},
    {"blend_func", "write \"blend\": \"add\""},
};
constexpr ForeignWord kValueTypes[] = {
    {"float1", "write \"float\""},
    {"number", "write \"float\""},
    {"double", "write \"float\""},
    {"half", "write \"float\""},
    {"scalar", "write \"float\""},
    {"real", "write \"float\""},
    {"float2", "write \"vec2\""},
    {"float3", "write \"vec3\""},
    {"float4", "write \"vec4\""},
    {"point2d", "write \"vec2\""},
    {"color", "write \"vec3\", or \"vec4\" with alpha"},
    {"colour", "write \"vec3\", or \"vec4\" with alpha"},
    {"rgb", "write \"vec3\""},
    {"rgba", "write \"vec4\""},
    {"boolean", "write \"bool\""},
    {"integer", "write \"int\""},
    {"uint", "write \"int\", with \"min\": 0"},
    {"long", "write \"int\""},
    {"enum", "write \"choice\", with \"choices\""},
    {"string", "write \"choice\" for one of some words, \"file\" for a path"},
    {"select", "write \"choice\", with \"choices\""},
    {"path", "write \"file\""},
    {"range", "write \"float\", and the range with \"min\" and \"max\""},
    {"slider", "write \"float\", and the range with \"min\" and \"max\""},
    {"texture", "write \"file\" for the path of one that an import reads"},
};
constexpr ForeignWord kValueKeys[] = {
    {"value", "write \"default\""},
    {"initial", "write \"default\""},
    {"range", "write \"min\" and \"max\""},
    {"minimum", "write \"min\""},
    {"maximum", "write \"max\""},
    {"values", "write \"choices\""},
    {"options", "write \"choices\""},
    {"labels", "write \"choices\""},
    {"name", "write \"label\""},
    {"title", "write \"label\""},
    {"description", "write \"doc\""},
    {"tooltip", "write \"doc\""},
};
constexpr ForeignWord kSampling[] = {
    {"repeat", "write 'wrap'"},
    {"tile", "write 'wrap'"},
    {"point", "write 'nearest'"},
    {"bilinear", "write 'linear'"},
    {"trilinear", "write 'linear': levels are filtered the same way"},
    {"clamp_to_edge", "write 'clamp'"},
    {"clamp_to_border", "write 'border', or 'border(0, 0, 0, 1)' with its colour"},
    {"mirrored_repeat", "write 'mirror'"},
    {"mirror_repeat", "write 'mirror'"},
    {"mirrored", "write 'mirror'"},
    {"edge", "write 'clamp'"},
    {"linearfilter", "write 'linear'"},
    {"nearestfilter", "write 'nearest'"},
    {"linearmipmaplinearfilter", "write 'linear': levels are filtered the same way"},
    {"linearmipmapnearestfilter", "write 'linear': levels are filtered the same way"},
    {"repeatwrapping", "write 'wrap'"},
    {"clamptoedgewrapping", "write 'clamp'"},
    {"mirroredrepeatwrapping", "write 'mirror'"},
    {"shadow", "write 'compare'"},
    {"comparison", "write 'compare'"},
    {"uav", "write 'image'"},
    {"rwtexture", "write 'image'"},
    {"texture", "write 'sampled'"},
    {"srv", "write 'sampled'"},
    {"ssbo", "write 'storage'"},
    {"ubo", "write 'uniform'"},
};
constexpr ForeignWord kExpressions[] = {
    {"round", "write 'floor(a + 0.5)'"},
    {"clamp", "write 'min(max(a, low), high)'"},
    {"saturate", "write 'min(max(a, 0), 1)'"},
    {"int", "write 'floor(a)'"},
    {"trunc", "write 'floor(a)', or 'ceil(a)' below zero"},
    {"sqrt", "there is none: compute it in the shader"},
    {"pow", "there is none: 'a * a', or compute it in the shader"},
    {"exp2", "there is none: compute it in the shader, or give a table by '?:'"},
    {"exp", "there is none: compute it in the shader"},
    {"log", "there is none: compute it in the shader; 'log2ceil(a)' gives whole levels"},
    {"sin", "there is none: compute it in the shader"},
    {"cos", "there is none: compute it in the shader"},
    {"tan", "there is none: compute it in the shader"},
    {"asin", "there is none: compute it in the shader"},
    {"acos", "there is none: compute it in the shader"},
    {"atan", "there is none: compute it in the shader"},
    {"atan2", "there is none: compute it in the shader"},
    {"dot", "there is none: compute it in the shader"},
    {"random", "there is none: compute it in the shader"},
    {"rand", "there is none: compute it in the shader"},
    {"smoothstep", "there is none: compute it in the shader"},
    {"fract", "write 'a - floor(a)'"},
    {"frac", "write 'a - floor(a)'"},
    {"sign", "write 'a > 0 ? 1 : a < 0 ? -1 : 0'"},
    {"log2", "write 'log2ceil(a)' for whole levels"},
    {"mod", "write 'a % b'"},
    {"lerp", "write 'a + (b - a) * t'"},
    {"mix", "write 'a + (b - a) * t'"},
    {"step", "write 'a < b ? 0 : 1'"},
    {"select", "write 'condition ? a : b'"},
    {"width", "write 'size(name).x'"},
    {"height", "write 'size(name).y'"},
    {"levels", "write 'mips(name)'"},
    {"exists", "write 'has(name)'"},
    {"length", "write 'count(name)'"},
    {"vec2", "write a list: '[a, b]'"},
    {"vec3", "write a list: '[a, b, c]'"},
    {"vec4", "write a list: '[a, b, c, d]'"},
};
// Named as a value, a variable or an import.
constexpr ForeignWord kForeignValues[] = {
    {"time", "a graph knows no time; a shader does: #include \"common/view.glsl\" has 'time'"},
    {"now", "a graph knows no time; a shader does: #include \"common/view.glsl\" has 'time'"},
    {"seconds", "a graph knows no time; a shader does: #include \"common/view.glsl\" has 'time'"},
    {"delta_time", "a graph knows no time; a shader does: #include \"common/view.glsl\" has 'delta_time'"},
    {"frame", "a graph knows no frame; a shader does: #include \"common/view.glsl\" has 'frame'"},
    {"resolution", "write 'screen'"},
    {"viewport", "write 'screen'"},
    {"aspect", "write 'screen.x / screen.y'"},
    {"width", "write 'screen.x', or 'size(name).x' of a texture"},
    {"height", "write 'screen.y', or 'size(name).y' of a texture"},
    {"keyboard", "there is none: make it a parameter"},
    {"camera.position", "a shader has it: #include \"common/view.glsl\" has 'camera_position'"},
    {"camera.view", "a shader has it: #include \"common/view.glsl\" has 'view'"},
    {"camera.projection", "a shader has it: #include \"common/view.glsl\" has 'projection'"},
    {"camera.near", "a shader has the view: #include \"common/view.glsl\""},
    {"camera.far", "depth is reversed and has no far plane: #include \"common/view.glsl\" has the view"},
    {"camera.fov", "a shader has the view: #include \"common/view.glsl\""},
    {"camera.direction", "a shader has the view: #include \"common/view.glsl\""},
    {"webcam", "there is none: \"import\": \"image\" reads a picture or a numbered sequence"},
    {"video", "there is none: \"import\": \"image\" reads a picture or a numbered sequence"},
    {"audio", "there is none: give a picture of the sound to \"import\": \"image\""},
    {"music", "there is none: give a picture of the sound to \"import\": \"image\""},
    {"sound", "there is none: give a picture of the sound to \"import\": \"image\""},
    {"pi", "write 3.14159265"},
};
constexpr ForeignWord kImportTypes[] = {
    {"texture", "write \"import\": \"image\""},
    {"picture", "write \"import\": \"image\""},
    {"bitmap", "write \"import\": \"image\""},
    {"png", "write \"import\": \"image\""},
    {"file", "write \"import\": \"image\", with \"file\""},
    {"sampler", "write \"import\": \"image\""},
    {"skybox", "write \"import\": \"environment\""},
    {"cubemap", "write \"import\": \"environment\""},
    {"lut", "write \"import\": \"cube_lut\""},
};
std::span<const ForeignWord> wordsOf(Foreign where) {
  switch (where) {
    case Foreign::pass_key:
      return foreignPassKeys();
    case Foreign::texture_key:
      return foreignTextureKeys();
    case Foreign::graph_key:
      return kGraphKeys;
    case Foreign::state_word:
      return kStateWords;
    case Foreign::value_type:
      return kValueTypes;
    case Foreign::value_key:
      return kValueKeys;
    case Foreign::sampling:
      return kSampling;
    case Foreign::expression:
      return kExpressions;
    case Foreign::state_key:
      return kStateKeys;
    case Foreign::shader_name:
      return foreignShaderNames();
    case Foreign::value:
      return kForeignValues;
    case Foreign::import_type:
      return kImportTypes;
  }
  return {};
}

}  // namespace

std::string hintForForeign(Foreign where, std::string_view word) {
  std::string wanted =
      where == Foreign::shader_name ? std::string(word) : lowered(word);  // GLSL tells cases apart
  if (where == Foreign::value_type)
    wanted.resize(std::min(wanted.find('('), wanted.size()));  // "Range(0, 1)"
  if (where == Foreign::state_word) {
    for (const std::string_view prefix :
         {"gl_", "vk_compare_op_", "vk_", "d3d11_comparison_", "d3d12_comparison_func_", "comparison_",
          "compare_", "mtlcomparefunction", "comparefunction"})
      if (wanted.starts_with(prefix)) wanted.erase(0, prefix.size());
    std::erase_if(wanted, [](char c) { return c == '_' || c == '-' || c == ' '; });
  }
  for (const ForeignWord& known : wordsOf(where))
    if (known.theirs == wanted) return std::string(known.hint);
  return {};
}

}  // namespace weft::base
