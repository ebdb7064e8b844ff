#include "engine/base/words/glsl_words.h"

#include <algorithm>
#include <optional>

namespace weft::base {

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

bool isGlslFunction(std::string_view word) {
  constexpr std::string_view kFunctions[] = {"abs",
                                             "acos",
                                             "acosh",
                                             "all",
                                             "any",
                                             "asin",
                                             "asinh",
                                             "atan",
                                             "atanh",
                                             "atomicAdd",
                                             "atomicCompSwap",
                                             "atomicExchange",
                                             "atomicMax",
                                             "atomicMin",
                                             "barrier",
                                             "bitCount",
                                             "bitfieldExtract",
                                             "bitfieldInsert",
                                             "bitfieldReverse",
                                             "ceil",
                                             "clamp",
                                             "cos",
                                             "cosh",
                                             "cross",
                                             "dFdx",
                                             "dFdxCoarse",
                                             "dFdxFine",
                                             "dFdy",
                                             "dFdyCoarse",
                                             "dFdyFine",
                                             "degrees",
                                             "determinant",
                                             "distance",
                                             "dot",
                                             "equal",
                                             "exp",
                                             "exp2",
                                             "faceforward",
                                             "findLSB",
                                             "findMSB",
                                             "floatBitsToInt",
                                             "floatBitsToUint",
                                             "floor",
                                             "fma",
                                             "fract",
                                             "frexp",
                                             "fwidth",
                                             "fwidthFine",
                                             "greaterThan",
                                             "greaterThanEqual",
                                             "groupMemoryBarrier",
                                             "imageAtomicAdd",
                                             "imageAtomicExchange",
                                             "imageAtomicMax",
                                             "imageAtomicMin",
                                             "imageLoad",
                                             "imageSize",
                                             "imageStore",
                                             "intBitsToFloat",
                                             "interpolateAtCentroid",
                                             "inverse",
                                             "inversesqrt",
                                             "isinf",
                                             "isnan",
                                             "ldexp",
                                             "length",
                                             "lessThan",
                                             "lessThanEqual",
                                             "log",
                                             "log2",
                                             "matrixCompMult",
                                             "max",
                                             "memoryBarrier",
                                             "memoryBarrierShared",
                                             "min",
                                             "mix",
                                             "mod",
                                             "modf",
                                             "normalize",
                                             "not",
                                             "notEqual",
                                             "outerProduct",
                                             "packHalf2x16",
                                             "packUnorm2x16",
                                             "packUnorm4x8",
                                             "pow",
                                             "radians",
                                             "reflect",
                                             "refract",
                                             "round",
                                             "roundEven",
                                             "sign",
                                             "sin",
                                             "sinh",
                                             "smoothstep",
                                             "sqrt",
                                             "step",
                                             "tan",
                                             "tanh",
                                             "texelFetch",
                                             "texture",
                                             "textureGather",
                                             "textureGrad",
                                             "textureLod",
                                             "textureLodOffset",
                                             "textureOffset",
                                             "textureProj",
                                             "textureQueryLevels",
                                             "textureQueryLod",
                                             "textureSize",
                                             "transpose",
                                             "trunc",
                                             "uintBitsToFloat",
                                             "unpackHalf2x16",
                                             "unpackUnorm2x16",
                                             "unpackUnorm4x8"};
  return std::ranges::find(kFunctions, word) != std::end(kFunctions);
}

}  // namespace weft::base
