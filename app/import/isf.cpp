// An ISF file: its shaders, translated in place to GLSL 4.5, and what Weft puts before them; then its graph. Declared in import.h.
#include "app/import/isf.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/graph/language/expr.h"
#include "engine/graph/language/names.h"
#include "engine/text/chars.h"
#include "import_glsl.h"

namespace weft::importing {

namespace {

using text::Code;
using InputType = IsfInput::Type;

// The slot of what the shader draws.
constexpr const char* kIsfOutput = "isf_FragColor";

struct IsfShader {
  std::vector<ConvertedText> texts;
  std::string fragment, vertex;  // paths below shaders/; `vertex` is empty without one
  // Images that the shader reads, by their names in the file, and those of them that it passes to functions other than those
  // of ISF, so that they must always be there.
  std::set<std::string, std::less<>> read, needed;
  bool usesDate = false;
};

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

constexpr std::array<std::string_view, 5> kSizeFunctions{"floor", "ceil", "min", "max", "abs"};
const Json kClear = {0, 0, 0, 0};

class IsfGraphWriter {
 public:
  IsfGraphWriter(const IsfHeader& header, IsfNames& names, const IsfShader& shader,
                 const ConvertOptions& options, text::Diagnostics& diagnostics)
      : header_(header),
        names_(names),
        shader_(shader),
        options_(options),
        diagnostics_(diagnostics),
        picture_(names.fresh("picture")) {}

  std::string run() {
    for (const IsfInput& input : header_.inputs) addInput(input);
    if (shader_.usesDate) {
      parameters_["date"] = {{"default", {2000.0, 1.0, 1.0, 0.0}}, {"label", "Date of the first frame"}};
      uniforms_["date"] = "$date";
    }
    for (const IsfImported& imported : header_.imported) addImported(imported);
    findTargets();
    addPasses();
    Json graph = {{"name", options_.name}};
    std::string about = header_.description;
    if (!header_.credit.empty()) about += fmt::format("{}({})", about.empty() ? "" : " ", header_.credit);
    if (!about.empty()) graph["description"] = about;
    if (!parameters_.empty()) graph["parameters"] = parameters_;
    if (!lets_.empty()) graph["let"] = lets_;
    graph.update({{"resources", resources_}, {"passes", passes_}, {"present", picture_}});
    return graphText(graph);
  }

  // Whether a pass shows the last target, which is of another kind than the picture.
  bool showsLast() const { return shown_; }

 private:
  struct Target {
    IsfPass size;  // as the first pass that names it says
    bool persistent = false, floats = false, cleared = false;
    bool written = false;  // by a pass before the one that is looked at
  };

  void addInput(const IsfInput& input) {
    const std::string& name = names_.of(input.name);
    if (input.type == InputType::image) return addImage(input);
    Json parameter = Json::object();
    std::string value = "$" + name, label = input.label;
    if (input.type == InputType::boolean || input.type == InputType::event)
      parameter["default"] = !input.initial.empty() && input.initial[0] != 0;
    else if (const std::string let = addChoices(input, parameter); !let.empty())
      value = "$" + let;
    else
      addNumbers(input, parameter);
    if (input.type == InputType::event)
      label = (label.empty() ? input.name : label) + " (an event: true for one frame)";
    if (!label.empty()) parameter["label"] = label;
    parameters_[name] = parameter;
    uniforms_[name] = value;
    values_[input.name] = value;
  }

  // The default must lie in the range: ISF does not ask for it.
  static void addNumbers(const IsfInput& input, Json& parameter) {
    const bool real = input.type != InputType::integer, color = input.type == InputType::color;
    const std::size_t count = input.type == InputType::point ? 2 : color ? 4 : 1;
    std::vector<double> low = input.min, high = input.max;
    if (low.empty() && high.empty() && !real) low = high = input.values;
    if (low.empty() && high.empty() && color) low = {0}, high = {1};
    double min = low.empty() ? -HUGE_VAL : std::ranges::min(low);
    double max = high.empty() ? HUGE_VAL : std::ranges::max(high);
    if (!real) min = std::floor(min), max = std::floor(max);
    std::vector<double> initial = input.initial;
    if (initial.empty()) initial.assign(count, min <= max ? std::clamp(0.0, min, max) : 0);
    min = std::min(min, std::ranges::min(initial));
    max = std::max(max, std::ranges::max(initial));
    Json numbers = Json::array();
    for (const double x : initial) numbers.push_back(numberOf(x, real));
    if (count == 1) parameter["type"] = real ? "float" : "int";
    parameter["default"] = count == 1 ? numbers[0] : numbers;
    if (min >= max) return;
    if (std::isfinite(min)) parameter["min"] = numberOf(min, real);
    if (std::isfinite(max)) parameter["max"] = numberOf(max, real);
  }

  // A word for each label, and the number that it means. Returns the name of the value, or "" where the input stays a number.
  std::string addChoices(const IsfInput& input, Json& parameter) {
    constexpr std::array<std::string_view, 4> kTaken{"true", "false", "screen", "device"};
    const double wanted = !input.initial.empty() ? input.initial[0]
                          : input.values.empty() ? 0
                                                 : input.values[0];
    const auto found = std::ranges::find(input.values, wanted);
    // Weft's expressions have at most 200 operators.
    const std::size_t count = input.labels.size();
    if (count < 2 || count > 60 || found == input.values.end()) return {};
    std::set<std::string, std::less<>> seen;
    Json words = Json::array();
    std::string value;
    for (std::size_t i = 0; i < count; ++i) {
      std::string word = identifierOf(input.labels[i]);
      if (graph::isReservedWord(word) || contains(kTaken, word)) word += '_';
      word = freshName(seen, word);  // "Soft light" and "Soft-light" are one word
      if (word.size() > 60) return {};
      words.push_back(word);
      value += i + 1 == count
                   ? fmt::format("{}", input.values[i])
                   : fmt::format("${} == {} ? {} : ", names_.of(input.name), word, input.values[i]);
    }
    parameter["default"] = words[static_cast<std::size_t>(found - input.values.begin())];
    parameter["choices"] = words;
    const std::string let = names_.fresh(names_.of(input.name) + "_value");
    lets_[let] = value;
    return let;
  }

  void addImage(const IsfInput& input) {
    const std::string& name = names_.of(input.name);
    std::string file;
    for (const auto& [which, path] : options_.images)
      if (which == input.name) file = path;
    const std::string& label = input.label.empty() ? input.name : input.label;
    parameters_[name] = {{"type", "file"}, {"default", file}, {"label", label + ": a picture"}};
    resources_[name] = {{"import", "image"}, {"file", "$" + name}};
    if (!shader_.needed.contains(input.name)) return;
    // A function takes it, so that something must be there.
    if (nothing_.empty()) {
      nothing_ = names_.fresh("no_picture");
      resources_[nothing_] = {{"texture", "rgba8"}, {"size", 1}, {"clear", kClear}};
    }
    const std::string chosen = names_.fresh(name + "_or_none");
    resources_[chosen] = Json::array({name, nothing_});
    chosen_[input.name] = chosen;
  }

  void addImported(const IsfImported& imported) {
    std::string path = imported.path.text;
    if (!path.starts_with('/') && !options_.sourceFolder.empty()) path = options_.sourceFolder + "/" + path;
    if (path.starts_with('$')) path = "./" + path;
    resources_[names_.of(imported.name)] = {{"import", "image"}, {"file", path}};
  }

  Json textureOf(bool floats, Json size, bool cleared) const {
    Json texture = {{"texture", floats ? "rgba32f" : "rgba8"}, {"size", std::move(size)}};
    if (cleared || !shader_.vertex.empty()) texture["clear"] = kClear;
    return texture;
  }

  void findTargets() {
    // What nothing has written when it must be there is cleared.
    for (const IsfPass& pass : header_.passes) {
      if (pass.target.text.empty()) continue;
      Target& target = targets_.try_emplace(pass.target.text, Target{.size = pass}).first->second;
      target.persistent |= pass.persistent;
      target.floats |= pass.floats;
    }
    std::set<std::string_view> written;
    for (const IsfPass& pass : header_.passes) {
      for (auto& [name, target] : targets_)
        target.cleared |= shader_.needed.contains(name) && !target.persistent && !written.contains(name);
      written.insert(pass.target.text);
    }
    const IsfPass& last = header_.passes.back();
    for (const auto& [name, target] : targets_) {
      Json texture = textureOf(target.floats, sizeOf(target.size), target.cleared);
      if (target.persistent && shader_.read.contains(name)) texture["history"] = 1;
      resources_[names_.of(name)] = texture;
      if (name == last.target.text) shown_ = target.floats || last.isScaled() || target.size.isScaled();
    }
    if (!last.target.text.empty() && !shown_)
      picture_ = names_.of(last.target.text);
    else
      resources_[picture_] = textureOf(false, "screen", false);
  }

  // The text for the name behind a '$' in a size.
  std::string variableOf(std::string_view name) const {
    if (name == "WIDTH") return "screen.x";
    if (name == "HEIGHT") return "screen.y";
    const auto value = values_.find(name);
    if (value == values_.end()) return {};
    const InputType type = std::ranges::find(header_.inputs, name, &IsfInput::name)->type;
    return type != InputType::point && type != InputType::color ? value->second : std::string();
  }

  // The size of a pass as an expression of Weft: "floor($WIDTH/4.0)" becomes "floor(screen.x/4.0)". `otherwise` after W222.
  std::string sizeOf(const PlacedText& size, const char* otherwise) {
    const auto wrong = [&](const std::string& message, std::uint32_t column = 1) {
      text::Place place = size.place;
      place.column += column - 1;
      refuse(diagnostics_, text::Code::sizeNotMapped, place, message,
             "write numbers, $WIDTH, $HEIGHT, $input, + - * / % ( ), floor, ceil, min, max, abs");
      return otherwise;
    };
    std::string out;
    const std::vector<glsl::Token> tokens = glsl::splitTokens(size.text);
    for (std::size_t i = 0; i < tokens.size(); ++i) {
      const glsl::Token& token = tokens[i];
      const std::string name = text::lowered(token.text);
      if (token.kind == glsl::TokenKind::number) {  // Weft has digits on both sides of a point
        out += (name.front() == '.' ? "0" : "") + name + (name.back() == '.' ? "0" : "");
      } else if (contains(kSizeFunctions, name)) {
        out += name;
      } else if (token.is("$")) {
        const std::string variable = i + 1 < tokens.size() ? variableOf(tokens[++i].text) : "";
        if (variable.empty()) return wrong("no number that a size can use is behind the '$'", token.column);
        out += variable;
      } else if (name.size() == 1 && std::string_view("+-*/%(),").find(name) != std::string::npos) {
        out += token.is(",") ? ", " : name;
      } else {
        return wrong(fmt::format("unexpected '{}' in a size", token.text), token.column);
      }
    }
    text::Diagnostics said;
    if (out.empty() && size.text.empty()) return otherwise;
    if (graph::Expr::parse(out, size.place, said)) return out;
    return wrong(said.empty() ? "the size is no expression" : said.items()[0].message);
  }

  Json sizeOf(const IsfPass& pass) {
    if (!pass.isScaled()) return "screen";
    return Json::array({sizeOf(pass.width, "screen.x"), sizeOf(pass.height, "screen.y")});
  }

  Json readsOf() const {
    Json reads = Json::object();
    const auto add = [&](const std::string& name, const std::string& from) {
      if (shader_.read.contains(name)) reads[names_.of(name)] = from;
    };
    for (const IsfInput& input : header_.inputs) {
      if (input.type != InputType::image) continue;
      const auto chosen = chosen_.find(input.name);
      add(input.name,
          chosen == chosen_.end() ? names_.of(input.name) + " as linear ?" : chosen->second + " as linear");
    }
    for (const IsfImported& imported : header_.imported)
      add(imported.name, names_.of(imported.name) + " as linear");
    for (const auto& [name, target] : targets_)
      if (target.written || target.cleared || target.persistent)
        add(name, names_.of(name) + (target.written || target.cleared ? "" : "@-1") + " as linear");
    return reads;
  }

  void addPasses() {
    std::set<std::string, std::less<>> used;
    std::string first;
    for (std::size_t i = 0; i < header_.passes.size(); ++i) {
      const PlacedText& drawn = header_.passes[i].target;
      if (drawn.text.empty() && i + 1 < header_.passes.size()) continue;  // the last pass draws the picture
      const std::string target = drawn.text.empty() ? picture_ : names_.of(drawn.text);
      const std::string name = freshName(used, "draw_" + target);
      Json pass = {{"name", name}};
      if (!first.empty())
        pass["like"] = first;
      else if (shader_.vertex.empty())
        pass.update({{"type", "fullscreen"}, {"shader", shader_.fragment}});
      else
        pass.update({{"type", "draw"},
                     {"geometry", "quad"},
                     {"instances", 1},
                     {"shader", {{"vertex", shader_.vertex}, {"fragment", shader_.fragment}}}});
      if (Json reads = readsOf(); !reads.empty()) pass["read"] = std::move(reads);
      pass["write"] = {{kIsfOutput, target}};
      pass["defines"] = {{"PASSINDEX", i}};
      if (first.empty() && !uniforms_.empty()) pass["parameters"] = uniforms_;
      if (first.empty()) first = name;
      passes_.push_back(pass);
      if (!drawn.text.empty()) targets_.find(drawn.text)->second.written = true;
    }
    if (!shown_) return;
    passes_.push_back({{"name", freshName(used, "show")},
                       {"type", "fullscreen"},
                       {"shader", options_.name + "/show.frag.glsl"},
                       {"read", {{"source", names_.of(header_.passes.back().target.text) + " as linear"}}},
                       {"write", {{"result", picture_}}}});
  }

  const IsfHeader& header_;
  IsfNames& names_;
  const IsfShader& shader_;
  const ConvertOptions& options_;
  text::Diagnostics& diagnostics_;
  std::string picture_, nothing_;
  Json passes_ = Json::array();
  Json parameters_ = Json::object(), lets_ = Json::object(), resources_ = Json::object(),
       uniforms_ = Json::object();
  std::map<std::string, Target, std::less<>> targets_;
  std::map<std::string, std::string, std::less<>> values_, chosen_;  // by input: in expressions; of images
  bool shown_ = false;
};

}  // namespace

std::optional<Converted> convertIsf(const IsfSource& source, const ConvertOptions& options,
                                    text::Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.errorCount();
  const auto header =
      readIsfHeader(source.fragment, std::make_shared<const std::string>(source.fragmentFile), diagnostics);
  if (!header) return std::nullopt;
  std::vector<std::string> images;
  for (const IsfInput& input : header->inputs)
    if (input.type == IsfInput::Type::image) images.push_back(input.name);
  if (!checkImageNames(options, images, diagnostics)) return std::nullopt;
  IsfNames names(*header);
  auto shader = ShaderTranslator(*header, names, diagnostics).run(source, options.name);
  if (!shader) return std::nullopt;
  IsfGraphWriter writer(*header, names, *shader, options, diagnostics);
  Converted out{.graph = options.name + ".json"};
  out.texts.push_back({out.graph, writer.run()});
  if (diagnostics.errorCount() > errors) return std::nullopt;
  std::ranges::move(shader->texts, std::back_inserter(out.texts));
  if (writer.showsLast())
    out.texts.push_back({fmt::format("shaders/{}/show.frag.glsl", options.name), templates::isf_show});
  return out;
}

}  // namespace weft::importing
