#include "engine/text/words/words.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <unordered_map>
#include <vector>

#include "engine/text/chars.h"
#include "engine/text/files/file.h"
#include "engine/text/nearest.h"

namespace weft::text {

namespace {

const nlohmann::ordered_json& foreignTable() {
  static const auto table = [] {
    std::ifstream file(dataFolder() + "/engine/text/words/foreign.json");
    auto json = nlohmann::ordered_json::parse(file, nullptr, false);
    return json.is_object() ? json : nlohmann::ordered_json::object();
  }();
  return table;
}

// By kind and their word, "pass_key/inputs". In the file, what is to be written comes first, and then all words that mean it. Of
// a key of ours that is meant, hints follow, "" where its name alone says all, and then the words.
const ForeignWord& findForeign(const std::string& word) {
  static const auto table = [] {
    std::unordered_map<std::string, ForeignWord> all;
    for (const auto& [group, rows] : foreignTable().items())
      for (const auto& [ours, words] : rows.items()) {
        const bool plain = words.is_array();
        const nlohmann::ordered_json hints = plain ? nlohmann::ordered_json{{ours, words}} : words;
        for (const auto& [hint, list] : hints.items())
          for (const auto& theirs : list)
            all.emplace(
                group + "/" + theirs.get<std::string>(),
                ForeignWord{hint.empty() ? "write \"" + ours + '"' : hint, plain ? "" : ours, hint.empty()});
      }
    return all;
  }();
  static const ForeignWord none;
  const auto found = table.find(word);
  return found == table.end() ? none : found->second;
}

}  // namespace

const ForeignWord& findForeignWord(std::string_view kind, std::string_view word) {
  std::string wanted = kind == "shader_name" ? std::string(word) : lowered(word);  // GLSL tells cases apart
  if (kind == "value_type") wanted.resize(std::min(wanted.find('('), wanted.size()));  // "Range(0, 1)"
  if (kind == "state_word" || kind == "format") {
    for (const std::string_view prefix :
         {"gl_", "vk_format_", "vk_compare_op_", "vk_", "dxgi_format_", "d3d11_comparison_",
          "d3d12_comparison_func_", "comparison_", "compare_", "mtlcomparefunction", "comparefunction",
          "mtlpixelformat", "pixelformat.", "format_", "pf_", "three."})
      if (wanted.starts_with(prefix)) wanted.erase(0, prefix.size());
    std::erase_if(wanted, [](char c) { return c == '_' || c == '-' || c == ' '; });
  }
  return findForeign(std::string(kind) + "/" + wanted);
}

std::string hintOrNearest(std::string_view kind, std::string_view word, std::span<const std::string> known) {
  std::string theirs = hintForForeign(kind, word);
  return theirs.empty() ? nearestHint(word, known) : theirs;
}

std::string hintForSpelling(std::string_view value) {
  constexpr std::size_t kLongest = 80;  // a longer text is no slip of this kind
  const auto patterns = foreignTable().find("value_pattern");
  if (value.size() > kLongest || patterns == foreignTable().end()) return {};
  for (const auto& [hint, all] : patterns->items())
    for (const auto& pattern : all)
      if (std::cmatch found; std::regex_match(value.data(), value.data() + value.size(), found,
                                              std::regex(pattern.get<std::string>())))
        return found.format(hint);
  return {};
}

namespace {

std::vector<std::string_view> wordsOf(std::string_view all) {
  std::vector<std::string_view> words;
  while (!all.empty()) words.push_back(takeWord(all));
  return words;
}

}  // namespace

bool isGlslWord(std::string_view word) {
  static const std::vector<std::string_view> kWords = wordsOf(
      "attribute const uniform varying buffer shared coherent volatile restrict readonly writeonly "
      "atomic_uint layout centroid flat smooth noperspective patch sample break continue do for while "
      "switch case default if else subroutine in out inout float double int void bool true false "
      "invariant precise discard return uint lowp mediump highp precision struct common partition active "
      "asm class union enum typedef template this resource goto inline noinline public static extern "
      "external interface long short half fixed unsigned superp input output filter sizeof cast namespace "
      "using sampler3DRect main "
      "vec2 vec3 vec4 ivec2 ivec3 ivec4 uvec2 uvec3 uvec4 bvec2 bvec3 bvec4 dvec2 dvec3 dvec4 hvec2 hvec3 "
      "hvec4 fvec2 fvec3 fvec4 mat2 mat3 mat4 mat2x2 mat2x3 mat2x4 mat3x2 mat3x3 mat3x4 mat4x2 mat4x3 "
      "mat4x4 dmat2 dmat3 dmat4 dmat2x2 dmat2x3 dmat2x4 dmat3x2 dmat3x3 dmat3x4 dmat4x2 dmat4x3 dmat4x4");
  if (std::ranges::find(kWords, word) != kWords.end()) return true;
  if (word.starts_with("gl_")) return true;
  if (word.starts_with("is") || word.starts_with("ii") || word.starts_with('u')) word.remove_prefix(1);
  for (const std::string prefix : {"sampler", "image"})
    for (const char* shape : {"1D", "2D", "3D", "Cube", "Buffer"})
      if (word.starts_with(prefix + shape)) return true;
  return false;
}

std::span<const std::string_view> glslFunctions() {
  static const std::vector<std::string_view> kFunctions = wordsOf(
      "abs acos acosh all any asin asinh atan atanh atomicAdd atomicAnd atomicCompSwap atomicExchange "
      "atomicMax atomicMin atomicOr atomicXor barrier bitCount bitfieldExtract bitfieldInsert "
      "bitfieldReverse ceil clamp cos cosh cross dFdx dFdxCoarse dFdxFine dFdy dFdyCoarse dFdyFine degrees "
      "determinant distance dot equal exp exp2 faceforward findLSB findMSB floatBitsToInt floatBitsToUint "
      "floor fma fract frexp fwidth fwidthCoarse fwidthFine greaterThan greaterThanEqual "
      "groupMemoryBarrier imageAtomicAdd imageAtomicAnd imageAtomicCompSwap imageAtomicExchange "
      "imageAtomicMax imageAtomicMin imageAtomicOr imageAtomicXor imageLoad imageSamples imageSize "
      "imageStore imulExtended intBitsToFloat interpolateAtCentroid interpolateAtOffset "
      "interpolateAtSample inverse inversesqrt isinf isnan ldexp length lessThan lessThanEqual log log2 "
      "matrixCompMult max memoryBarrier memoryBarrierAtomicCounter memoryBarrierBuffer memoryBarrierImage "
      "memoryBarrierShared min mix mod modf normalize not notEqual outerProduct packDouble2x32 "
      "packHalf2x16 packSnorm2x16 packSnorm4x8 packUnorm2x16 packUnorm4x8 pow radians reflect refract "
      "round roundEven sign sin sinh smoothstep sqrt step tan tanh texelFetch texelFetchOffset texture "
      "textureGather textureGatherOffset textureGatherOffsets textureGrad textureGradOffset textureLod "
      "textureLodOffset textureOffset textureProj textureProjGrad textureProjGradOffset textureProjLod "
      "textureProjLodOffset textureProjOffset textureQueryLevels textureQueryLod textureSamples "
      "textureSize transpose trunc uaddCarry uintBitsToFloat umulExtended unpackDouble2x32 unpackHalf2x16 "
      "unpackSnorm2x16 unpackSnorm4x8 unpackUnorm2x16 unpackUnorm4x8 usubBorrow");
  return kFunctions;
}

bool isGlslFunction(std::string_view word) {
  return std::ranges::binary_search(glslFunctions(), word);
}

}  // namespace weft::text
