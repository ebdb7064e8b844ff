// The shaders of an ISF file: its text, translated in place to GLSL 4.5, and what Weft puts before it. Declared in isf.h.
#include <fmt/format.h>

#include "app/import/isf.h"
#include "import_glsl.h"

namespace weft::importing {

namespace {

using text::Code;

constexpr std::array<std::string_view, 8> kGone{"attribute", "texture2DRect", "sampler2DRect", "ftransform",
                                                "gl_Vertex", "gl_Normal",     "gl_TexCoord",   "gl_Color"};

// What a name of older GLSL or of ISF 1 is today; "" where it is the same. "texture2DLodEXT" is "textureLod".
std::string newNameOf(std::string_view name) {
  if (name == "vv_FragNormCoord" || name == "vv_vertShaderInit") return "isf_" + std::string(name.substr(3));
  for (const std::string_view old : {"texture2D", "texture3D", "textureCube"}) {
    if (!name.starts_with(old)) continue;
    name.remove_prefix(old.size());
    if (name.ends_with("EXT") || name.ends_with("ARB")) name.remove_suffix(3);
    constexpr std::array<std::string_view, 5> kKinds{"", "Proj", "Lod", "ProjLod", "Grad"};
    if (contains(kKinds, name)) return "texture" + std::string(name);
  }
  return {};
}

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
  ShaderTranslator(const IsfHeader& header, const IsfNames& names, text::Diagnostics& diagnostics)
      : header_(header), names_(names), diagnostics_(diagnostics) {
    for (const IsfInput& input : header.inputs)
      if (input.type == IsfInput::Type::image) images_.push_back(input.name);
    for (const IsfImported& imported : header.imported) images_.push_back(imported.name);
    for (const IsfPass& pass : header.passes)
      if (!pass.target.text.empty() && !contains(images_, pass.target.text))
        images_.push_back(pass.target.text);
  }

  std::optional<IsfShader> run(const IsfSource& source, const std::string& name) {
    const std::size_t errors = diagnostics_.errorCount();
    const std::string fragment = translate(source.fragment, source.fragmentFile, false);
    const std::string vertex = source.vertex ? translate(*source.vertex, source.vertexFile, true) : "";
    if (diagnostics_.errorCount() > errors) return std::nullopt;
    const auto add = [&](const std::string& ending, std::string text) {
      out_.texts.push_back({fmt::format("shaders/{}/{}", name, ending), std::move(text)});
      return name + "/" + ending;
    };
    add("isf.glsl", prelude(name));
    const char* place =
        source.vertex ? "in vec2 isf_FragNormCoord;" : "in vec2 uv;\nvec2 isf_FragNormCoord = uv;";
    out_.fragment = add(name + ".frag.glsl",
                        fillTemplate(templates::isf_fragment, {{"@NAME@", name}, {"@PLACE@", place}}));
    add(name + ".fs.glsl", fragment);
    if (source.vertex) {
      out_.vertex = add(name + ".vert.glsl", fillTemplate(templates::isf_vertex, {{"@NAME@", name}}));
      add(name + ".vs.glsl", vertex);
    }
    return std::move(out_);
  }

 private:
  void fail(const glsl::Token& token, std::string message, std::string hint) {
    refuse(diagnostics_, Code::glslNotMapped, {file_, token.line, token.column}, std::move(message),
           std::move(hint));
  }

  std::string translate(std::string_view original, const std::string& fileName, bool isVertex) {
    file_ = std::make_shared<const std::string>(fileName);
    if (original.find('\0') != original.npos) {
      fail({.line = 1, .column = 1}, "the shader has a zero byte", "save the file as UTF-8");
      return {};
    }
    GlslText text(original);
    const auto& tokens = text.tokens();
    bool hasMain = false;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
      if (tokens[i].is("include") && i > 0 && tokens[i - 1].is("#"))
        fail(tokens[i], "the shader includes another file", "put the text in its place");
      if (!text.isName(i)) continue;
      hasMain = hasMain || tokens[i].is("main");
      out_.usesDate |= tokens[i].is("DATE");
      if (contains(images_, tokens[i].text)) noteImage(text, i);
      if (!translateFact(text, i, isVertex)) modernize(text, i, isVertex);
    }
    if (!hasMain)
      refuse(diagnostics_, Code::notIsf, {file_, 1, 1}, "the file has no function main",
             "write void main() { … } behind the header");
    text.renameTaken({"uv", "viewport", "time", "delta_time", "frame", "Parameters", "isf_Nothing"});
    for (const auto& [from, to] : names_.all())
      if (from != to) text.rename(from, to);
    dropDeclarations(text);
    return text.changed();
  }

  // Which images the shader reads, and whether as an argument of a function or of `texture`.
  void noteImage(const GlslText& text, std::size_t i) {
    const auto textAt = [&](std::size_t at) {
      return at < text.tokens().size() ? text.tokens()[at].text : std::string_view();
    };
    const std::string_view name = textAt(i), before = textAt(i - 1), behind = textAt(i + 1);
    const std::string_view function = before == "(" ? textAt(i - 2) : std::string_view();
    out_.read.emplace(name);
    // A variable of that name, such as `vec4 lastRow = IMG_PIXEL(lastRow, …)`, is not the image.
    const bool argument = (before == "(" || before == ",") && (behind == "," || behind == ")");
    if ((function.starts_with("texture") || argument) && !contains(kImageFunctions, function))
      out_.needed.emplace(name);
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
    const glsl::Token& token = text.tokens()[i];
    const auto [image, fact] = factOf(token.text);
    if (!image) return false;
    if (fact->varying && isVertex) {
      fail(token, fmt::format("the vertex shader uses '{}'", token.text),
           "only the fragment shader has it: work it out from isf_FragNormCoord");
    } else {
      out_.read.insert(*image);
      text.replace(i, i, fmt::format(fmt::runtime(fact->text), names_.of(*image)));
    }
    return true;
  }

  // Older GLSL as GLSL 4.5.
  void modernize(GlslText& text, std::size_t i, bool isVertex) {
    const auto& tokens = text.tokens();
    const glsl::Token& token = tokens[i];
    const auto next = [&](std::size_t ahead) {
      return i + ahead < tokens.size() ? tokens[i + ahead].text : std::string_view();
    };
    if (const std::string name = newNameOf(token.text); !name.empty()) return text.replace(i, i, name);
    if (token.is("varying")) return text.replace(i, i, isVertex ? "out" : "in");
    if (token.is("gl_FragColor") && !isVertex) return text.replace(i, i, kIsfOutput);
    if (token.is("gl_FragData") && !isVertex) {
      if (next(1) == "[" && next(2) == "0" && next(3) == "]") return text.replace(i, i + 3, kIsfOutput);
      return fail(token, "the shader writes several pictures at once", "make a pass of each picture");
    }
    if (contains(kGone, token.text))
      return fail(token, fmt::format("'{}' has no counterpart in GLSL 4.5", token.text),
                  "write it without fixed functions");
    // 'flat' and 'smooth' mean what they say where they qualify a variable.
    const bool qualifies = next(1) == "in" || next(1) == "out" || next(1) == "varying";
    if (contains(kNewWords, token.text) && !qualifies) text.replace(i, i, std::string(token.text) + "_");
  }

  // Some files declare again what ISF declares for them.
  void dropDeclarations(GlslText& text) {
    const auto& tokens = text.tokens();
    for (std::size_t i = 0; i + 3 < tokens.size(); ++i) {
      if (!tokens[i].is("uniform")) continue;
      std::size_t end = i + 1;
      while (end < tokens.size() && !tokens[end].is(";") && !tokens[end].is("{")) ++end;
      if (end >= tokens.size() || tokens[end].is("{")) continue;
      bool known = true;
      for (std::size_t at = i + 2; at < end; ++at) {
        if (!text.isName(at) || std::string_view(",;[=").find(tokens[at + 1].text) == std::string_view::npos)
          continue;
        const std::string_view name = tokens[at].text;
        if (names_.all().contains(name) || factOf(name).first || contains(kVariables, name)) continue;
        known = false;
        fail(tokens[at], fmt::format("the shader has a uniform '{}' that is no input", name),
             "add it to INPUTS of the header");
      }
      if (known) text.replace(i, end, "");
    }
  }

  std::string prelude(const std::string& name) const {
    std::string members;
    for (const IsfInput& input : header_.inputs)
      if (input.type != IsfInput::Type::image)
        members += fmt::format("  {} {};\n", kGlslTypes[static_cast<std::size_t>(input.type)],
                               names_.of(input.name));
    if (out_.usesDate) members += "  vec4 date;\n";
    std::string parameters = parameterBlockOf(members);
    // Year, month, day, and seconds of the day: `date` at the first frame.
    if (out_.usesDate) parameters += "vec4 DATE = date + vec4(0.0, 0.0, 0.0, time);\n";
    std::string slots;
    for (const std::string& image : images_)
      if (out_.read.contains(image))
        slots += fmt::format(
            fmt::runtime(out_.needed.contains(image) ? "uniform sampler2D {0};\n"
                                                     : "#ifdef {1}\nuniform sampler2D {0};\n#else\n"
                                                       "const isf_Nothing {0} = isf_Nothing(0);\n#endif\n"),
            names_.of(image), presenceDefineOf(names_.of(image)));
    return fillTemplate(templates::isf,
                        {{"@NAME@", name}, {"@PARAMETERS@\n", parameters}, {"@SLOTS@\n", slots}});
  }

  const IsfHeader& header_;
  const IsfNames& names_;
  text::Diagnostics& diagnostics_;
  std::shared_ptr<const std::string> file_;  // that is being translated
  std::vector<std::string> images_;
  IsfShader out_;
};

}  // namespace

std::optional<IsfShader> translateIsfShader(const IsfSource& source, const ConvertOptions& options,
                                            const IsfHeader& header, const IsfNames& names,
                                            text::Diagnostics& diagnostics) {
  return ShaderTranslator(header, names, diagnostics).run(source, options.name);
}

}  // namespace weft::importing
