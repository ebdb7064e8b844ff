#include "engine/convert/isf/shader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/base/chars.h"
#include "engine/convert/text/glsl_text.h"
#include "engine/convert/text/legacy_glsl.h"

namespace weft::convert {

namespace {

constexpr std::array<std::string_view, 5> kImageFunctions{"IMG_PIXEL", "IMG_NORM_PIXEL", "IMG_THIS_PIXEL",
                                                          "IMG_THIS_NORM_PIXEL", "IMG_SIZE"};

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

const char* glslTypeOf(IsfInput::Type type) {
  using T = IsfInput::Type;
  switch (type) {
    case T::boolean:
    case T::event:
      return "bool";
    case T::integer:
      return "int";
    case T::number:
      return "float";
    case T::point:
      return "vec2";
    case T::color:
      return "vec4";
    case T::image:
      break;
  }
  return "sampler2D";
}

class ShaderTranslator {
 public:
  ShaderTranslator(const IsfSource& source, const ConvertOptions& options, const IsfHeader& header,
                   const IsfNames& names, base::Diagnostics& diagnostics)
      : source_(source), options_(options), header_(header), names_(names), diagnostics_(diagnostics) {
    for (const IsfInput& input : header.inputs)
      if (input.type == IsfInput::Type::image) images_.push_back(input.name);
    for (const IsfImported& imported : header.imported) images_.push_back(imported.name);
    for (const IsfPass& pass : header.passes)
      if (!pass.target.empty() && std::ranges::find(images_, pass.target) == images_.end())
        images_.push_back(pass.target);
  }

  std::optional<IsfShader> run() {
    const std::size_t errors = diagnostics_.errorCount();
    const std::string folder = options_.name + "/";
    const std::string fragment = translate(source_.fragment, source_.fragmentFile, Stage::fragment);
    const std::string vertex =
        source_.hasVertex ? translate(source_.vertex, source_.vertexFile, Stage::vertex) : "";
    if (diagnostics_.errorCount() > errors) return std::nullopt;
    out_.fragment = folder + options_.name + ".frag.glsl";
    const std::string own = options_.name + ".fs.glsl", ownVertex = options_.name + ".vs.glsl";
    add(folder + "isf.glsl", prelude());
    add(out_.fragment, fmt::format("// What {} draws. The lines of {} are those of the ISF file.\n"
                                   "{}out vec4 {};\n"
                                   "#include \"isf.glsl\"\n"
                                   "#include \"{}\"\n",
                                   options_.name, own,
                                   source_.hasVertex ? "in vec2 isf_FragNormCoord;\n"
                                                     : "in vec2 uv;\nvec2 isf_FragNormCoord = uv;\n",
                                   kIsfOutput, own));
    add(folder + own, fragment);
    if (source_.hasVertex) {
      out_.vertex = folder + options_.name + ".vert.glsl";
      add(out_.vertex, fmt::format("// Where {} draws. The lines of {} are those of the ISF file.\n"
                                   "out vec2 isf_FragNormCoord;\n"
                                   "void isf_vertShaderInit() {{\n"
                                   "  isf_FragNormCoord = vec2(gl_VertexID & 1, gl_VertexID >> 1);\n"
                                   "  gl_Position = vec4(isf_FragNormCoord * 2.0 - 1.0, 0.0, 1.0);\n"
                                   "}}\n"
                                   "#include \"isf.glsl\"\n"
                                   "#include \"{}\"\n",
                                   options_.name, ownVertex, ownVertex));
      add(folder + ownVertex, vertex);
    }
    return std::move(out_);
  }

 private:
  void add(const std::string& path, std::string text) {
    out_.texts.push_back({"shaders/" + path, std::move(text)});
  }

  std::string translate(std::string_view original, const std::string& fileName, Stage stage) {
    const auto file = std::make_shared<const std::string>(fileName);
    if (const std::size_t zero = original.find('\0'); zero != original.npos) {
      diagnostics_.error(base::Code::glslNotMapped, {file, 1, 1}, "a zero byte stands in the shader").hint =
          "save the file as plain text (UTF-8, not UTF-16)";
      return {};
    }
    GlslText text(original);
    if (!text.mentions("main")) {
      auto& d = diagnostics_.error(base::Code::notIsf, {file, 1, 1}, "the file has no function main");
      d.expected = "void main() { … } behind the header";
      d.hint = "an ISF file is a whole shader";
    }
    note(text);
    nameFacts(text, stage, file);
    modernize(text, stage, kIsfOutput, {file, 0, 0}, diagnostics_);
    static const std::array<std::string, 7> kTaken{"uv",    "viewport",   "time",       "delta_time",
                                                   "frame", "Parameters", "isf_Nothing"};
    renameTaken(text, kTaken);
    for (const auto& [from, to] : names_.all())
      if (from != to) text.rename(from, to);
    // Version 1.
    text.rename("vv_FragNormCoord", "isf_FragNormCoord");
    text.rename("vv_vertShaderInit", "isf_vertShaderInit");
    dropDeclarations(text, file);
    return text.changed();
  }

  // The image and the fact that a name such as _inputImage_imgSize stands for.
  std::pair<const std::string*, const ImageFact*> factOf(std::string_view name) const {
    if (!name.starts_with('_')) return {};
    for (const ImageFact& fact : kImageFacts)
      if (name.ends_with(fact.suffix)) {
        const auto image = std::ranges::find(images_, name.substr(1, name.size() - 1 - fact.suffix.size()));
        if (image != images_.end()) return {&*image, &fact};
      }
    return {};
  }

  void nameFacts(GlslText& text, Stage stage, const std::shared_ptr<const std::string>& file) {
    for (std::size_t i = 0; i < text.tokens().size(); ++i) {
      const glsl::Token& token = text.tokens()[i];
      usesSamplers_ |= token.text.starts_with("VVSAMPLER_2DBY");
      const auto [image, fact] = factOf(token.text);
      if (!image || !text.isName(i)) continue;
      if (fact->varying && stage == Stage::vertex) {
        auto& d = diagnostics_.error(base::Code::glslNotMapped, {file, token.line, token.column},
                                     fmt::format("the vertex shader uses '{}'", token.text));
        d.expected = "it only in the fragment shader";
        d.hint = "work it out from isf_FragNormCoord";
        continue;
      }
      out_.read.insert(*image);
      text.replace(i, fmt::format(fmt::runtime(fact->text), names_.of(*image)));
    }
  }

  // Some files declare again what ISF declares for them.
  void dropDeclarations(GlslText& text, const std::shared_ptr<const std::string>& file) {
    const auto& tokens = text.tokens();
    for (std::size_t i = 0; i + 3 < tokens.size(); ++i) {
      if (!tokens[i].is("uniform") || text.isDirective(i)) continue;
      std::size_t end = i + 1;
      while (end < tokens.size() && !tokens[end].is(";") && !tokens[end].is("{")) ++end;
      if (end >= tokens.size() || tokens[end].is("{")) continue;
      bool known = true;
      for (std::size_t at = i + 2; at < end; ++at) {
        const auto& next = tokens[at + 1];
        if (!text.isName(at) || !(next.is(",") || next.is(";") || next.is("[") || next.is("="))) continue;
        const std::string name(tokens[at].text);
        if (isDeclared(name)) continue;
        known = false;
        auto& d = diagnostics_.error(base::Code::glslNotMapped, {file, tokens[at].line, tokens[at].column},
                                     fmt::format("the shader has a uniform '{}' that is no input", name));
        d.expected = "uniforms only as INPUTS of the header";
        d.hint = "add it to INPUTS";
      }
      if (known) text.replaceRange(text.offsetOf(i), text.offsetOf(end) + 1, "");
    }
  }

  // Whether the prelude declares it: an input, or a variable of ISF.
  bool isDeclared(const std::string& name) const {
    return names_.all().contains(name) || factOf(name).first || name == "TIME" || name == "RENDERSIZE" ||
           name == "PASSINDEX" || name == "DATE" || name == "TIMEDELTA" || name == "FRAMEINDEX";
  }

  void note(const GlslText& text) {
    const auto& tokens = text.tokens();
    for (std::size_t i = 0; i < tokens.size(); ++i) {
      if (!text.isName(i)) continue;
      out_.usesDate |= tokens[i].is("DATE");
      const auto image = std::ranges::find(images_, tokens[i].text);
      if (image == images_.end()) continue;
      out_.read.insert(*image);
      const bool plain = i >= 2 && tokens[i - 1].is("(") &&
                         std::ranges::find(kImageFunctions, tokens[i - 2].text) != kImageFunctions.end();
      // A variable of that name, such as `vec4 lastRow = IMG_PIXEL(lastRow, …)`, is not the image.
      const bool direct = i >= 2 && tokens[i - 1].is("(") && tokens[i - 2].text.starts_with("texture");
      const bool argument = i >= 1 && (tokens[i - 1].is("(") || tokens[i - 1].is(",")) &&
                            i + 1 < tokens.size() && (tokens[i + 1].is(",") || tokens[i + 1].is(")"));
      if (!plain && (direct || argument)) out_.needed.insert(*image);
    }
  }

  std::string prelude() const {
    std::string text = fmt::format(
        "// What ISF gives every shader, for {}. The slots are the images, the parameters the inputs of the "
        "file.\n"
        "layout(std140) uniform View {{\n"
        "  vec2 viewport;\n"
        "  uint frame;\n"
        "  float time;\n"
        "  float delta_time;\n"
        "}};\n",
        options_.name);
    std::string members;
    for (const IsfInput& input : header_.inputs)
      if (input.type != IsfInput::Type::image)
        members += fmt::format("  {} {};\n", glslTypeOf(input.type), names_.of(input.name));
    if (out_.usesDate) members += "  vec4 date;\n";
    if (!members.empty()) text += "layout(std140) uniform Parameters {\n" + members + "};\n";
    text +=
        "vec2 RENDERSIZE = viewport;\n"
        "float TIME = time;\n"
        "float TIMEDELTA = delta_time;\n"
        "int FRAMEINDEX = int(frame);\n";
    if (out_.usesDate)
      text +=
          "// Year, month, day, and seconds of the day: `date` at the first frame.\n"
          "vec4 DATE = date + vec4(0.0, 0.0, 0.0, time);\n";
    text += "\n// Pictures have their first row at the bottom.\n" + imageFunctions("sampler2D");
    if (usesSamplers_)
      text +=
          "vec4 VVSAMPLER_2DBYPIXEL(sampler2D image, vec4 rect, vec2 size, bool flip, vec2 pixel) {\n"
          "  vec2 place = pixel / size * rect.zw;\n"
          "  return texture(image, rect.xy + (flip ? vec2(place.x, rect.w - place.y) : place));\n"
          "}\n"
          "vec4 VVSAMPLER_2DBYNORM(sampler2D image, vec4 rect, vec2 size, bool flip, vec2 place) {\n"
          "  return VVSAMPLER_2DBYPIXEL(image, rect, size, flip, place * size);\n"
          "}\n";
    std::string absent;
    for (const std::string& image : images_) {
      if (!out_.read.contains(image)) continue;
      const std::string& name = names_.of(image);
      if (out_.needed.contains(image))
        absent += fmt::format("uniform sampler2D {};\n", name);
      else
        absent += fmt::format(
            "#ifdef {}\nuniform sampler2D {};\n#else\nconst isf_Nothing {} = isf_Nothing(0);\n#endif\n",
            presenceDefineOf(name), name, name);
    }
    if (absent.empty()) return text;
    return text +
           "\n// What has no picture yet is black and transparent.\n"
           "struct isf_Nothing { int nothing; };\n"
           "vec4 IMG_NORM_PIXEL(isf_Nothing image, vec2 place) { return vec4(0.0); }\n"
           "vec4 IMG_PIXEL(isf_Nothing image, vec2 pixel) { return vec4(0.0); }\n"
           "vec4 IMG_THIS_PIXEL(isf_Nothing image) { return vec4(0.0); }\n"
           "vec4 IMG_THIS_NORM_PIXEL(isf_Nothing image) { return vec4(0.0); }\n"
           "vec2 IMG_SIZE(isf_Nothing image) { return viewport; }\n\n" +
           absent;
  }

  static std::string imageFunctions(std::string_view type) {
    return fmt::format(
        "vec4 IMG_NORM_PIXEL({0} image, vec2 place) {{ return texture(image, place); }}\n"
        "vec4 IMG_PIXEL({0} image, vec2 pixel) {{ return texture(image, pixel / vec2(textureSize(image, "
        "0))); }}\n"
        "vec4 IMG_THIS_PIXEL({0} image) {{ return texture(image, isf_FragNormCoord); }}\n"
        "vec4 IMG_THIS_NORM_PIXEL({0} image) {{ return texture(image, isf_FragNormCoord); }}\n"
        "vec2 IMG_SIZE({0} image) {{ return vec2(textureSize(image, 0)); }}\n",
        type);
  }

  const IsfSource& source_;
  const ConvertOptions& options_;
  const IsfHeader& header_;
  const IsfNames& names_;
  base::Diagnostics& diagnostics_;
  std::vector<std::string> images_;
  bool usesSamplers_ = false;
  IsfShader out_;
};

}  // namespace

std::optional<IsfShader> translateIsfShader(const IsfSource& source, const ConvertOptions& options,
                                            const IsfHeader& header, const IsfNames& names,
                                            base::Diagnostics& diagnostics) {
  return ShaderTranslator(source, options, header, names, diagnostics).run();
}

}  // namespace weft::convert
