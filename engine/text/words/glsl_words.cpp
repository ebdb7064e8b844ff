#include "engine/text/words/glsl_words.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace weft::text {

bool isGlslWord(std::string_view word) {
  constexpr std::string_view kWords[] = {
      "attribute", "const",    "uniform",   "varying",   "buffer",        "shared",
      "coherent",  "volatile", "restrict",  "readonly",  "writeonly",     "atomic_uint",
      "layout",    "centroid", "flat",      "smooth",    "noperspective", "patch",
      "sample",    "break",    "continue",  "do",        "for",           "while",
      "switch",    "case",     "default",   "if",        "else",          "subroutine",
      "in",        "out",      "inout",     "float",     "double",        "int",
      "void",      "bool",     "true",      "false",     "invariant",     "precise",
      "discard",   "return",   "uint",      "lowp",      "mediump",       "highp",
      "precision", "struct",   "common",    "partition", "active",        "asm",
      "class",     "union",    "enum",      "typedef",   "template",      "this",
      "resource",  "goto",     "inline",    "noinline",  "public",        "static",
      "extern",    "external", "interface", "long",      "short",         "half",
      "fixed",     "unsigned", "superp",    "input",     "output",        "filter",
      "sizeof",    "cast",     "namespace", "using",     "sampler3DRect", "main"};
  if (std::ranges::find(kWords, word) != std::end(kWords)) return true;
  const auto rest = [&](std::string_view prefix) {
    return word.starts_with(prefix) ? std::optional(word.substr(prefix.size())) : std::nullopt;
  };
  const auto isDigits = [](std::string_view text) { return text == "2" || text == "3" || text == "4"; };
  for (const std::string_view prefix : {"vec", "ivec", "uvec", "bvec", "dvec", "hvec", "fvec"})
    if (const auto tail = rest(prefix); tail && isDigits(*tail)) return true;
  for (const std::string_view prefix : {"mat", "dmat"})
    if (const auto tail = rest(prefix))
      if (isDigits(*tail) || (tail->size() == 3 && (*tail)[1] == 'x' && isDigits(tail->substr(0, 1)) &&
                              isDigits(tail->substr(2))))
        return true;
  for (const std::string_view prefix : {"sampler", "isampler", "usampler", "image", "iimage", "uimage"})
    if (const auto tail = rest(prefix); tail && !tail->empty())
      for (const std::string_view shape : {"1D", "2D", "3D", "Cube", "Buffer"})
        if (tail->starts_with(shape)) return true;
  return word.starts_with("gl_");
}

std::span<const std::string_view> glslFunctions() {
  static const std::vector<std::string_view> kFunctions = [] {
    constexpr std::string_view kAll =
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
        "unpackSnorm2x16 unpackSnorm4x8 unpackUnorm2x16 unpackUnorm4x8 usubBorrow";
    std::vector<std::string_view> words;
    for (std::size_t at = 0; at < kAll.size();) {
      const std::size_t end = std::min(kAll.find(' ', at), kAll.size());
      words.push_back(kAll.substr(at, end - at));
      at = end + 1;
    }
    return words;
  }();
  return kFunctions;
}

bool isGlslFunction(std::string_view word) {
  return std::ranges::binary_search(glslFunctions(), word);
}

}  // namespace weft::text
