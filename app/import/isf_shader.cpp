// The shaders of an ISF file: its text, translated in place to GLSL 4.5, and what Weft puts before it. Declared in isf.h.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/import/isf.h"
#include "app/import/text.h"
#include "import_glsl.h"

namespace weft::convert {

namespace {

using base::Code;

// Words of GLSL 4.5 that GLSL 1.20 and GLSL ES 1.00 leave to the author.
constexpr std::array<std::string_view, 19> kNewWords{
    "sample",   "buffer",    "shared",     "patch",    "precise",      "coherent", "restrict",
    "readonly", "writeonly", "subroutine", "centroid", "smooth",       "resource", "flat",
    "filter",   "partition", "active",     "common",   "noperspective"};
constexpr std::pair<std::string_view, std::string_view> kRenamed[] = {
    {"texture2D", "texture"},
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
    {"textureCubeLodEXT", "textureLod"},
    {"vv_FragNormCoord", "isf_FragNormCoord"},
    {"vv_vertShaderInit", "isf_vertShaderInit"}};
constexpr std::array<std::string_view, 15> kGone{"texture2DRect",
                                                 "sampler2DRect",
                                                 "texture2DRectProj",
                                                 "texture1D",
                                                 "ftransform",
                                                 "gl_Vertex",
                                                 "gl_TexCoord",
                                                 "gl_Color",
                                                 "gl_FrontColor",
                                                 "attribute",
                                                 "gl_Normal",
                                                 "gl_MultiTexCoord0",
                                                 "gl_ModelViewProjectionMatrix",
                                                 "gl_FragDataEXT",
                                                 "gl_ModelViewMatrix"};

constexpr std::array<std::string_view, 5> kImageFunctions{"IMG_PIXEL", "IMG_NORM_PIXEL", "IMG_THIS_PIXEL",
                                                          "IMG_THIS_NORM_PIXEL", "IMG_SIZE"};
constexpr std::array<std::string_view, 6> kVariables{"TIME", "RENDERSIZE", "PASSINDEX",
                                                     "DATE", "TIMEDELTA",  "FRAMEINDEX"};

// What players declare beside an image: its name between '_' and the suffix, and what that is here. A whole picture is one texture
// that stands upright. The last two are of the fragment stage.
struct ImageFact {
  std::string_view suffix, text;  // {0} is the image
  bool varying = false;
};
constexpr std::array<ImageFact, 5> kImageFacts{{
    {"_imgSize", "IMG_SIZE({0})"},
    {"_imgRect", "vec4(0.0, 0.0, 1.0, 1.0)"},
    {"_flip", "false"},
    {"_normTexCoord", "isf_FragNormCoord", true},
    {"_texCoord", "(isf_FragNormCoord * RENDERSIZE / IMG_SIZE({0}))", true},
}};

// In the order of IsfInput::Type.
constexpr const char* kGlslTypes[] = {"bool", "bool", "int", "float", "vec2", "vec4"};

class ShaderTranslator {
 public:
  ShaderTranslator(const IsfHeader& header, const IsfNames& names, base::Diagnostics& diagnostics)
      : header_(header), names_(names), diagnostics_(diagnostics) {
    for (const IsfInput& input : header.inputs)
      if (input.type == IsfInput::Type::image) images_.push_back(input.name);
    for (const IsfImported& imported : header.imported) images_.push_back(imported.name);
    for (const IsfPass& pass : header.passes)
      if (!pass.target.empty() && !contains(images_, pass.target)) images_.push_back(pass.target);
  }

  std::optional<IsfShader> run(const IsfSource& source, const std::string& name) {
    const std::size_t errors = diagnostics_.errorCount();
    const std::string fragment = translate(source.fragment, source.fragmentFile, false);
    const std::string vertex = source.hasVertex ? translate(source.vertex, source.vertexFile, true) : "";
    if (diagnostics_.errorCount() > errors) return std::nullopt;
    const auto add = [&](const std::string& ending, std::string text) {
      out_.texts.push_back({fmt::format("shaders/{}/{}", name, ending), std::move(text)});
      return name + "/" + ending;
    };
    add("isf.glsl", prelude(name));
    const char* place =
        source.hasVertex ? "in vec2 isf_FragNormCoord;" : "in vec2 uv;\nvec2 isf_FragNormCoord = uv;";
    out_.fragment =
        add(name + ".frag.glsl", fillTemplate(glsl::isf_fragment, {{"@NAME@", name}, {"@PLACE@", place}}));
    add(name + ".fs.glsl", fragment);
    if (source.hasVertex) {
      out_.vertex = add(name + ".vert.glsl", fillTemplate(glsl::isf_vertex, {{"@NAME@", name}}));
      add(name + ".vs.glsl", vertex);
    }
    return std::move(out_);
  }

 private:
  void fail(const Token& token, std::string message, std::string hint) {
    refuse(diagnostics_, Code::glslNotMapped, {file_, token.line, token.column}, std::move(message),
           std::move(hint));
  }

  std::string translate(std::string_view original, const std::string& fileName, bool isVertex) {
    file_ = std::make_shared<const std::string>(fileName);
    if (original.find('\0') != original.npos) {
      fail({.line = 1, .column = 1}, "the shader has a zero byte",
           "save the file as plain text (UTF-8, not UTF-16)");
      return {};
    }
    GlslText text(original);
    findImages(text);
    text.blankVersions();
    bool hasMain = false;
    for (std::size_t i = 0; i < text.tokens().size(); ++i) {
      if (text.directiveOf(i) == "include" && text.tokens()[i].first)
        fail(text.tokens()[i], "the shader includes another file",
             "put the included text in the place of the line, and import again");
      if (!text.isName(i)) continue;
      hasMain = hasMain || text.tokens()[i].is("main");
      if (!translateFact(text, i, isVertex)) modernize(text, i, isVertex);
    }
    if (!hasMain)
      refuse(diagnostics_, Code::notIsf, {file_, 1, 1}, "the file has no function main",
             "write void main() { … } behind the header: an ISF file is a whole shader");
    static constexpr std::array<std::string_view, 7> kTaken{"uv",    "viewport",   "time",       "delta_time",
                                                            "frame", "Parameters", "isf_Nothing"};
    text.renameTaken(kTaken);
    for (const auto& [from, to] : names_.all())
      if (from != to) text.rename(from, to);
    dropDeclarations(text);
    return text.changed();
  }

  // Which images the shader reads, and whether as an argument of a function or of `texture`.
  void findImages(const GlslText& text) {
    const auto& tokens = text.tokens();
    for (std::size_t i = 0; i < tokens.size(); ++i) {
      if (!text.isName(i)) continue;
      out_.usesDate |= tokens[i].is("DATE");
      if (!contains(images_, tokens[i].text)) continue;
      out_.read.emplace(tokens[i].text);
      const bool opened = i >= 2 && tokens[i - 1].is("(");
      // A variable of that name, such as `vec4 lastRow = IMG_PIXEL(lastRow, …)`, is not the image.
      const bool direct = opened && tokens[i - 2].text.starts_with("texture");
      const bool argument = i >= 1 && (tokens[i - 1].is("(") || tokens[i - 1].is(",")) &&
                            i + 1 < tokens.size() && (tokens[i + 1].is(",") || tokens[i + 1].is(")"));
      if ((direct || argument) && !(opened && contains(kImageFunctions, tokens[i - 2].text)))
        out_.needed.emplace(tokens[i].text);
    }
  }

  // The image and the fact that a name such as _inputImage_imgSize means.
  std::pair<const std::string*, const ImageFact*> factOf(std::string_view name) const {
    if (!name.starts_with('_')) return {};
    for (const ImageFact& fact : kImageFacts)
      if (name.ends_with(fact.suffix)) {
        const auto image = std::ranges::find(images_, name.substr(1, name.size() - 1 - fact.suffix.size()));
        if (image != images_.end()) return {&*image, &fact};
      }
    return {};
  }

  bool translateFact(GlslText& text, std::size_t i, bool isVertex) {
    const Token& token = text.tokens()[i];
    const auto [image, fact] = factOf(token.text);
    if (!image) return false;
    if (fact->varying && isVertex) {
      fail(token, fmt::format("the vertex shader uses '{}'", token.text),
           "only the fragment shader has it: work it out from isf_FragNormCoord");
    } else {
      out_.read.insert(*image);
      text.replace(i, fmt::format(fmt::runtime(fact->text), names_.of(*image)));
    }
    return true;
  }

  // Older GLSL as GLSL 4.5.
  void modernize(GlslText& text, std::size_t i, bool isVertex) {
    const auto& tokens = text.tokens();
    const Token& token = tokens[i];
    const auto next = [&](std::size_t ahead) {
      return i + ahead < tokens.size() ? tokens[i + ahead].text : std::string_view();
    };
    for (const auto& [from, to] : kRenamed)
      if (token.is(from)) return text.replace(i, std::string(to));
    if (token.is("varying")) return text.replace(i, isVertex ? "out" : "in");
    if (token.is("gl_FragColor") && !isVertex) return text.replace(i, std::string(kIsfOutput));
    if (token.is("gl_FragData") && !isVertex) {
      if (next(1) == "[" && next(2) == "0" && next(3) == "]")
        return text.replaceRange(i, i + 3, std::string(kIsfOutput));
      return fail(token, "the shader writes several pictures at once",
                  "write gl_FragColor, or gl_FragData[0], and make a pass of each picture");
    }
    if (contains(kGone, token.text) && !(token.is("attribute") && !text.directiveOf(i).empty()))
      return fail(token, fmt::format("'{}' has no counterpart in GLSL 4.5", token.text),
                  token.text.find("2DRect") != token.text.npos
                      ? "write IMG_PIXEL(image, pixel), or texture2D with coordinates from 0 to 1"
                      : "write it without fixed-function names, and import again");
    // 'flat' and 'smooth' mean what they say where they qualify a variable.
    const bool qualifies = next(1) == "in" || next(1) == "out" || next(1) == "varying";
    if (contains(kNewWords, token.text) && !qualifies) text.replace(i, std::string(token.text) + "_");
  }

  // Some files declare again what ISF declares for them.
  void dropDeclarations(GlslText& text) {
    const auto& tokens = text.tokens();
    for (std::size_t i = 0; i + 3 < tokens.size(); ++i) {
      if (!tokens[i].is("uniform") || !text.directiveOf(i).empty()) continue;
      std::size_t end = i + 1;
      while (end < tokens.size() && !tokens[end].is(";") && !tokens[end].is("{")) ++end;
      if (end >= tokens.size() || tokens[end].is("{")) continue;
      bool known = true;
      for (std::size_t at = i + 2; at < end; ++at) {
        const Token& next = tokens[at + 1];
        if (!text.isName(at) || !(next.is(",") || next.is(";") || next.is("[") || next.is("="))) continue;
        const std::string name(tokens[at].text);
        if (names_.all().contains(name) || factOf(name).first || contains(kVariables, name)) continue;
        known = false;
        fail(tokens[at], fmt::format("the shader has a uniform '{}' that is no input", name),
             "add it to INPUTS of the header");
      }
      if (known) text.replaceRange(i, end, "");
    }
  }

  std::string prelude(const std::string& name) const {
    std::string members;
    for (const IsfInput& input : header_.inputs)
      if (input.type != IsfInput::Type::image)
        members += fmt::format("  {} {};\n", kGlslTypes[static_cast<std::size_t>(input.type)],
                               names_.of(input.name));
    if (out_.usesDate) members += "  vec4 date;\n";
    if (!members.empty()) members = "layout(std140) uniform Parameters {\n" + members + "};\n";
    // Year, month, day, and seconds of the day: `date` at the first frame.
    if (out_.usesDate) members += "vec4 DATE = date + vec4(0.0, 0.0, 0.0, time);\n";
    std::string slots;
    for (const std::string& image : images_) {
      if (!out_.read.contains(image)) continue;
      const std::string& slot = names_.of(image);
      slots += out_.needed.contains(image) ? fmt::format("uniform sampler2D {};\n", slot)
                                           : fmt::format(
                                                 "#ifdef {0}\nuniform sampler2D {1};\n#else\n"
                                                 "const isf_Nothing {1} = isf_Nothing(0);\n#endif\n",
                                                 presenceDefineOf(slot), slot);
    }
    return fillTemplate(glsl::isf, {{"@NAME@", name}, {"@PARAMETERS@\n", members}, {"@SLOTS@\n", slots}});
  }

  const IsfHeader& header_;
  const IsfNames& names_;
  base::Diagnostics& diagnostics_;
  std::shared_ptr<const std::string> file_;  // that is being translated
  std::vector<std::string> images_;
  IsfShader out_;
};

}  // namespace

std::optional<IsfShader> translateIsfShader(const IsfSource& source, const ConvertOptions& options,
                                            const IsfHeader& header, const IsfNames& names,
                                            base::Diagnostics& diagnostics) {
  return ShaderTranslator(header, names, diagnostics).run(source, options.name);
}

}  // namespace weft::convert
