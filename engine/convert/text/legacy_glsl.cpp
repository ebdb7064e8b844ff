#include "engine/convert/text/legacy_glsl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace weft::convert {

using base::Code;

namespace {

// Words of GLSL 4.5 that GLSL 1.20 and GLSL ES 1.00 leave to the author.
constexpr std::array<std::string_view, 20> kNewWords{
    "sample",   "buffer",    "shared",     "patch",    "precise",       "coherent", "restrict",
    "readonly", "writeonly", "subroutine", "centroid", "smooth",        "resource", "flat",
    "filter",   "partition", "active",     "common",   "noperspective", "uint"};

struct Renamed {
  std::string_view from, to;
};
constexpr std::array<Renamed, 13> kRenamedFunctions{{{"texture2D", "texture"},
                                                     {"texture2DProj", "textureProj"},
                                                     {"texture2DLod", "textureLod"},
                                                     {"texture2DProjLod", "textureProjLod"},
                                                     {"texture2DGrad", "textureGrad"},
                                                     {"texture2DLodEXT", "textureLod"},
                                                     {"texture2DProjLodEXT", "textureProjLod"},
                                                     {"texture2DGradEXT", "textureGrad"},
                                                     {"texture2DGradARB", "textureGrad"},
                                                     {"texture3D", "texture"},
                                                     {"textureCube", "texture"},
                                                     {"textureCubeLod", "textureLod"},
                                                     {"textureCubeLodEXT", "textureLod"}}};
constexpr std::array<std::string_view, 14> kGone{"texture2DRect",
                                                 "sampler2DRect",
                                                 "texture2DRectProj",
                                                 "texture1D",
                                                 "ftransform",
                                                 "gl_Vertex",
                                                 "gl_TexCoord",
                                                 "gl_Color",
                                                 "gl_FrontColor",
                                                 "gl_MultiTexCoord0",
                                                 "gl_ModelViewProjectionMatrix",
                                                 "gl_FragDataEXT",
                                                 "gl_ModelViewMatrix",
                                                 "gl_Normal"};

}  // namespace

bool isNewWord(std::string_view word) {
  return std::ranges::find(kNewWords, word) != kNewWords.end();
}

void modernize(GlslText& text, Stage stage, std::string_view output, const base::Place& file,
               base::Diagnostics& diagnostics) {
  const auto& tokens = text.tokens();
  const auto placeOf = [&](const glsl::Token& token) {
    return base::Place{file.file, token.line, token.column};
  };
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const glsl::Token& token = tokens[i];
    if (text.isDirective(i)) {
      const std::string_view name = text.directiveOf(i);
      if (name == "version" || name == "extension" || name == "line") {
        if (token.first) text.blankDirective(i);
        continue;
      }
      if (name == "include" && token.first) {
        auto& d = diagnostics.error(Code::glslNotMapped, placeOf(token), "the shader includes another file");
        d.expected = "a shader that is one file";
        d.hint = "put the included text in the place of the line, and import again";
        continue;
      }
    }
    if (!text.isName(i)) continue;
    const auto function = std::ranges::find(kRenamedFunctions, token.text, &Renamed::from);
    if (function != kRenamedFunctions.end()) {
      text.replace(i, std::string(function->to));
    } else if (token.is("varying")) {
      text.replace(i, stage == Stage::vertex ? "out" : "in");
    } else if (stage == Stage::fragment && token.is("gl_FragColor")) {
      text.replace(i, std::string(output));
    } else if (stage == Stage::fragment && token.is("gl_FragData")) {
      const bool first =
          i + 3 < tokens.size() && tokens[i + 1].is("[") && tokens[i + 2].is("0") && tokens[i + 3].is("]");
      if (first) {
        text.replaceRange(text.offsetOf(i), text.offsetOf(i + 3) + 1, std::string(output));
      } else {
        auto& d = diagnostics.error(Code::glslNotMapped, placeOf(token),
                                    "the shader writes several pictures at once");
        d.expected = "gl_FragColor, or gl_FragData[0]";
        d.found = i + 2 < tokens.size() ? fmt::format("gl_FragData[{}]", tokens[i + 2].text) : "gl_FragData";
        d.hint = "make a pass of each picture";
      }
    } else if (std::ranges::find(kGone, token.text) != kGone.end() ||
               (token.is("attribute") && !text.isDirective(i))) {
      auto& d = diagnostics.error(Code::glslNotMapped, placeOf(token),
                                  fmt::format("'{}' has no counterpart in GLSL 4.5", token.text));
      d.expected = token.text.starts_with("texture2DRect") || token.is("sampler2DRect")
                       ? "IMG_PIXEL(image, pixel), or texture2D with coordinates from 0 to 1"
                       : "GLSL that uses no fixed-function names";
      d.found = std::string(token.text);
      d.hint = "write it in other words in the foreign file, and import again";
    } else if (isNewWord(token.text) && !token.is("uint")) {
      // 'flat' and 'smooth' are what they say where they qualify a variable.
      const bool qualifies = i + 1 < tokens.size() && (tokens[i + 1].is("in") || tokens[i + 1].is("out") ||
                                                       tokens[i + 1].is("varying"));
      if (!qualifies) text.replace(i, std::string(token.text) + "_");
    }
  }
}

void renameTaken(GlslText& text, std::span<const std::string> taken) {
  for (const std::string& name : taken)
    if (text.declaredOutside().contains(name)) text.rename(name, name + "_");
}

}  // namespace weft::convert
