// An ISF file: its JSON header with places in the file, its shaders, translated in place to GLSL 4.5 with what Weft puts before them, and
// its graph. Declared in import.h.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <set>

#include "engine/graph/language/expr.h"
#include "engine/graph/language/names.h"
#include "engine/text/chars.h"
#include "engine/text/json/fields.h"
#include "engine/text/nearest.h"
#include "engine/text/words/words.h"
#include "import_glsl.h"
#include "importers/import.h"
#include "importers/text.h"

namespace weft::importing {

namespace {

using text::Code;
using text::Diagnostics;
using text::JsonValue;
using text::Place;
using JsonType = JsonValue::Type;

struct IsfInput {
  enum class Type : std::uint8_t { boolean, event, integer, number, point, color, image };
  std::string name;  // as the shader knows it
  Type type = Type::number;
  std::string label;
  std::vector<double> initial, min, max;  // as many numbers as the type has; empty: not said
  std::vector<double> values;             // of an integer
  std::vector<std::string> labels;        // as many as values, or none
};

struct IsfPass {
  PlacedText target;  // "": the picture
  bool persistent = false, floats = false;
  PlacedText width, height;  // expressions; "": that of the picture
  bool isScaled() const { return !width.text.empty() || !height.text.empty(); }
};

struct IsfImported {
  std::string name;
  PlacedText path;
};

struct IsfHeader {
  std::string description, credit;
  std::vector<IsfInput> inputs;
  std::vector<IsfPass> passes;  // at least one
  std::vector<IsfImported> imported;
};

// Words of GLSL 4.5 that GLSL 1.20 and GLSL ES 1.00 leave to the author.
constexpr std::array<std::string_view, 19> kNewWords{
    "sample",   "buffer",    "shared",     "patch",    "precise",      "coherent", "restrict",
    "readonly", "writeonly", "subroutine", "centroid", "smooth",       "resource", "flat",
    "filter",   "partition", "active",     "common",   "noperspective"};

using InputType = IsfInput::Type;

// In the order of IsfInput::Type.
const std::array<std::string, 7> kTypes{"bool", "event", "long", "float", "point2D", "color", "image"};
constexpr std::array<std::string_view, 6> kOtherTypes{"audio",   "audioFFT", "cube",
                                                      "point3D", "text",     "audioFloatHistogram"};

// What the translated shader declares by itself, and the name of the screen in expressions.
constexpr std::array<std::string_view, 16> kDeclared{
    "View", "time",       "delta_time", "frame",     "uv",         "TIME",   "TIMEDELTA",         "DATE",
    "date", "FRAMEINDEX", "RENDERSIZE", "PASSINDEX", "Parameters", "screen", "isf_FragNormCoord", "viewport"};

// Where the text between the marks of the first comment of /* */ begins and ends, where nothing but spaces and comments of // is
// before it.
std::optional<std::pair<std::size_t, std::size_t>> firstComment(std::string_view text) {
  std::size_t at = text.starts_with(text::kByteOrderMark) ? 3 : 0;
  while (at < text.size() && (text::isSpace(text[at]) || text.substr(at, 2) == "//"))
    at = text::isSpace(text[at]) ? at + 1 : std::min(text.find('\n', at), text.size());
  const std::size_t end = text.substr(at, 2) == "/*" ? text.find("*/", at + 2) : text.npos;
  return end == text.npos ? std::nullopt : std::optional(std::pair(at + 2, end));
}

class HeaderReader {
 public:
  explicit HeaderReader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  IsfHeader read(const JsonValue& root) {
    out_.description = textOf(root, "DESCRIPTION");
    out_.credit = textOf(root, "CREDIT");
    for (const JsonValue& input : listOf(root, "INPUTS")) readInput(input);
    for (const JsonValue& pass : listOf(root, "PASSES")) readPass(pass);
    for (const JsonValue& name : listOf(root, "PERSISTENT_BUFFERS"))  // of version 1
      for (IsfPass& pass : out_.passes)
        if (pass.target.text == name.text) pass.persistent = true;
    if (const JsonValue* imported = root.find("IMPORTED"); imported && imported->is(JsonType::object))
      for (const text::JsonMember& member : imported->members) readImported(member.key, member.value);
    else
      for (const JsonValue& each : listOf(root, "IMPORTED")) readImported(textOf(each, "NAME"), each);
    if (out_.passes.empty()) out_.passes.emplace_back().target.place = root.place;
    return std::move(out_);
  }

 private:
  void fail(Code code, const Place& place, std::string message, std::string hint) {
    refuse(diagnostics_, code, place, std::move(message), std::move(hint));
  }

  bool expect(const JsonValue& value, std::string_view name, JsonType type) {
    return text::expectType(value, name, type, diagnostics_);
  }

  // The member, unless it is null.
  static const JsonValue* valueOf(const JsonValue& object, std::string_view key) {
    const JsonValue* value = object.find(key);
    return value && !value->is(JsonType::null) ? value : nullptr;
  }

  static std::string textOf(const JsonValue& object, std::string_view key) {
    const JsonValue* value = object.find(key);
    return value && value->is(JsonType::string) ? value->text : std::string();
  }

  // ISF files write true, 1 and "true".
  bool flagOf(const JsonValue& object, std::string_view key) {
    const JsonValue* value = valueOf(object, key);
    if (!value) return false;
    if (value->is(JsonType::number)) return value->number != 0;
    if (value->is(JsonType::string)) return value->text == "true" || value->text == "1";
    return expect(*value, key, JsonType::boolean) && value->flag;
  }

  std::span<const JsonValue> listOf(const JsonValue& object, std::string_view key) {
    const JsonValue* value = valueOf(object, key);
    if (!value || !expect(*value, key, JsonType::array)) return {};
    return value->items;
  }

  bool checkName(const Place& place, std::string_view name, std::string_view what) {
    const bool word = text::isGlslWord(name) && !contains(kNewWords, name);
    if (!graph::isIdent(name) || word || name.size() > 64 || name.find("__") != name.npos) {
      fail(Code::notAName, place, fmt::format("\"{}\" cannot name {}", name, what),
           "use letters, digits and '_', not beginning with a digit, and no word of GLSL");
      return false;
    }
    const auto [before, fresh] = places_.emplace(name, place);
    if (!fresh)
      fail(Code::duplicateName, place, fmt::format("two things have the name '{}'", name),
           fmt::format("rename one; the first is at {}:{}", before->second.line, before->second.column));
    return fresh;
  }

  // A number, a boolean, or a list of numbers.
  std::vector<double> numbersOf(const JsonValue& object, std::string_view key, InputType type) {
    const std::size_t count = type == InputType::point ? 2 : type == InputType::color ? 4 : 1;
    const JsonValue* value = valueOf(object, key);
    std::vector<double> numbers;
    if (!value) return numbers;
    if (value->is(JsonType::boolean)) numbers.push_back(value->flag ? 1 : 0);
    if (value->is(JsonType::number)) numbers.push_back(value->number);
    for (const JsonValue& item : value->items)
      if (item.is(JsonType::number)) numbers.push_back(item.number);
    if (count == 4 && numbers.size() == 3) numbers.push_back(1);  // an opaque color
    const bool all = std::ranges::all_of(numbers, [](double x) { return std::abs(x) <= 3e38; });
    if (numbers.size() == count && all) return numbers;
    fail(Code::wrongType, value->place, fmt::format("{} has the wrong type", key),
         count == 1 ? "write a number or a boolean" : fmt::format("write a list of {} numbers", count));
    return {};
  }

  void checkWhole(double x, const Place& place) {
    if (x != std::floor(x) || std::abs(x) > 2147483647.0)
      fail(Code::outOfRange, place, "the value of a long is no whole number of 32 bits",
           "write a whole number, or the TYPE float");
  }

  void readInput(const JsonValue& value) {
    if (!expect(value, "an input", JsonType::object)) return;
    text::JsonFields fields(value, "an input", Code::outOfRange, diagnostics_);
    fields.require({"NAME", "TYPE"});
    const auto name = fields.text("NAME"), type = fields.text("TYPE");
    if (!name || !type) return;
    const Place& place = fields.find("TYPE")->place;
    const auto found = std::ranges::find(kTypes, *type);
    if (contains(kOtherTypes, *type))
      return fail(Code::isfNotMapped, place,
                  fmt::format("an input of the type \"{}\" has no counterpart in Weft", *type),
                  "make it an image, or remove it from the file and from the shader");
    if (found == kTypes.end())
      return fail(Code::unknownWord, place, fmt::format("unknown type of input \"{}\"", *type),
                  text::nearestHint(*type, kTypes));
    if (!checkName(fields.find("NAME")->place, *name, "an input")) return;
    IsfInput input{.name = *name,
                   .type = static_cast<InputType>(found - kTypes.begin()),
                   .label = textOf(value, "LABEL")};
    if (input.type != InputType::image) input.initial = numbersOf(value, "DEFAULT", input.type);
    if (input.type >= InputType::integer && input.type != InputType::image) {
      input.min = numbersOf(value, "MIN", input.type);
      input.max = numbersOf(value, "MAX", input.type);
    }
    if (input.type == InputType::integer) readValues(value, input);
    out_.inputs.push_back(std::move(input));
  }

  void readValues(const JsonValue& value, IsfInput& input) {
    for (const double x : input.initial) checkWhole(x, value.find("DEFAULT")->place);
    for (const JsonValue& each : listOf(value, "VALUES")) {
      if (!expect(each, "one of VALUES", JsonType::number)) return;
      checkWhole(each.number, each.place);
      input.values.push_back(each.number);
    }
    for (const JsonValue& each : listOf(value, "LABELS"))
      input.labels.push_back(each.is(JsonType::number) ? fmt::format("{}", each.number) : each.text);
    if (input.labels.size() != input.values.size()) input.labels.clear();
  }

  PlacedText sizeOf(const JsonValue& pass, std::string_view key) {
    const JsonValue* size = valueOf(pass, key);
    if (size && size->is(JsonType::number)) return {fmt::format("{}", size->number), size->place};
    if (!size || !expect(*size, key, JsonType::string)) return {};
    return {size->text, size->textPlace()};
  }

  void readPass(const JsonValue& value) {
    if (!expect(value, "a pass", JsonType::object)) return;
    IsfPass pass{.target = {"", value.place},
                 .persistent = flagOf(value, "PERSISTENT"),
                 .floats = flagOf(value, "FLOAT"),
                 .width = sizeOf(value, "WIDTH"),
                 .height = sizeOf(value, "HEIGHT")};
    const JsonValue* target = valueOf(value, "TARGET");
    if (target && expect(*target, "TARGET", JsonType::string)) {
      pass.target = {target->text, target->place};
      const bool again = std::ranges::any_of(
          out_.passes, [&](const IsfPass& other) { return other.target.text == target->text; });
      if (!target->text.empty() && !again) checkName(target->place, target->text, "a target");
    }
    out_.passes.push_back(std::move(pass));
  }

  void readImported(const std::string& name, const JsonValue& value) {
    if (!expect(value, "an imported picture", JsonType::object)) return;
    const JsonValue* path = value.find("PATH");
    if (!path || !path->is(JsonType::string))
      fail(Code::isfNotMapped, (path ? *path : value).place,
           fmt::format("the imported picture '{}' has no PATH of one file", name),
           "a cube map has no counterpart; name one picture: \"PATH\": \"picture.png\"");
    else if (checkName(value.place, name, "an imported picture"))
      out_.imported.push_back({name, {path->text, path->textPlace()}});
  }

  Diagnostics& diagnostics_;
  IsfHeader out_;
  std::map<std::string, Place, std::less<>> places_;  // of names
};

// Mistakes of form are W002 to W013 and W220; what Weft has no counterpart for is W221.
std::optional<IsfHeader> readIsfHeader(std::string_view text, text::FileName file, Diagnostics& diagnostics) {
  const auto comment = firstComment(text);
  if (!comment) {
    refuse(diagnostics, Code::notIsf, {file, 1, 1}, "the file has no ISF header",
           "begin it with /*{ … }*/: see https://docs.isf.video");
    return std::nullopt;
  }
  // Blanks for all that is before, so that places are those of the file.
  std::string json(text.substr(0, comment->second));
  std::replace_if(
      json.begin(), json.begin() + static_cast<std::ptrdiff_t>(comment->first),
      [](char c) { return c != '\n'; }, ' ');
  const std::size_t errors = diagnostics.errorCount();
  // Vidvox's own collection has keys that stand twice: the first counts.
  Diagnostics said;
  const auto root = text::parseJson(json, file, said);
  for (text::Diagnostic each : said.items()) {
    if (each.code == Code::duplicateKey) each.severity = text::Severity::warning;
    diagnostics.add(std::move(each));
  }
  if (!root) return std::nullopt;
  if (!root->is(JsonType::object)) {
    refuse(diagnostics, Code::notIsf, root->place, "the first comment is no ISF header",
           "write the header as /*{ … }*/");
    return std::nullopt;
  }
  IsfHeader header = HeaderReader(diagnostics).read(*root);
  return diagnostics.errorCount() > errors ? std::nullopt : std::optional(std::move(header));
}

// What the things of an ISF file are called in the graph and in the shader. Names that Weft or GLSL 4.5 keep for themselves get
// a '_' behind them.
class IsfNames {
 public:
  explicit IsfNames(const IsfHeader& header) {
    const auto add = [&](const std::string& name) {
      const bool kept = graph::isReservedWord(name) || contains(kDeclared, name) || text::isGlslWord(name);
      if (!name.empty() && !names_.contains(name)) names_[name] = fresh(kept ? name + "_" : name);
    };
    for (const IsfInput& input : header.inputs) add(input.name);
    for (const IsfImported& imported : header.imported) add(imported.name);
    for (const IsfPass& pass : header.passes) add(pass.target.text);
  }
  const std::string& of(std::string_view name) const { return names_.find(name)->second; }
  const std::map<std::string, std::string, std::less<>>& all() const { return names_; }
  // A name for something of the graph alone, that nothing else has.
  std::string fresh(std::string_view wanted) {
    std::string name;  // GLSL keeps names with two underscores in a row
    for (const char c : wanted)
      if (c != '_' || !name.ends_with('_')) name += c;
    return freshName(used_, name);
  }

 private:
  std::map<std::string, std::string, std::less<>> names_;
  std::set<std::string, std::less<>> used_;
};

// The slot of what the shader draws.
constexpr const char* kIsfOutput = "isf_FragColor";

struct IsfShader {
  std::vector<ConvertedText> texts;
  std::string fragment, vertex;             // paths below shaders/; `vertex` is empty without one
  std::set<std::string, std::less<>> read;  // images, by their names in the file
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

// A call of pow() with a whole number as exponent; but not in a constant, which takes no functions of ISF's.
bool isWholePower(const std::vector<glsl::Token>& tokens, std::size_t i) {
  if (!tokens[i].is("pow") || i + 1 == tokens.size() || !tokens[i + 1].is("(")) return false;
  std::size_t end = i + 1;
  for (int open = 0; end < tokens.size() && (open += tokens[end].is("(") - tokens[end].is(")")) > 0;) ++end;
  while (i > 0 && !tokens[i].is("const") && !tokens[i].is(";") && !tokens[i].is("}")) --i;
  return end < tokens.size() && tokens[end - 2].is(",") && !tokens[i].is("const") &&
         std::fmod(std::strtod(std::string(tokens[end - 1].text).c_str(), nullptr), 1.0) == 0.0 &&
         tokens[end - 1].kind == glsl::TokenKind::number;
}

constexpr std::array<std::string_view, 6> kVariables{"TIME", "RENDERSIZE", "PASSINDEX",
                                                     "DATE", "TIMEDELTA",  "FRAMEINDEX"};

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
    file_ = fileName;
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
      for (const std::string& image : images_)
        if (tokens[i].is(image) || isBeside(tokens[i].text, image)) out_.read.insert(image);
      modernize(text, i, isVertex);
    }
    if (!hasMain)
      refuse(diagnostics_, Code::notIsf, {file_, 1, 1}, "the file has no function main",
             "write void main() { … } behind the header");
    text.renameTaken({"uv", "viewport", "time", "delta_time", "frame", "Parameters"});
    for (const auto& [from, to] : names_.all())
      if (from != to) text.rename(from, to);
    dropDeclarations(text);
    return text.changed();
  }

  // Of names such as _inputImage_imgSize, which players declare beside an image (glsl/isf_slot.glsl).
  static bool isBeside(std::string_view name, const std::string& image) {
    return name.starts_with("_" + image + "_");
  }

  // Older GLSL as GLSL 4.5.
  void modernize(GlslText& text, std::size_t i, bool isVertex) {
    const auto& tokens = text.tokens();
    const glsl::Token& token = tokens[i];
    const auto next = [&](std::size_t ahead) {
      return i + ahead < tokens.size() ? tokens[i + ahead].text : std::string_view();
    };
    if (const std::string name = newNameOf(token.text); !name.empty()) return text.replace(i, i, name);
    if (isWholePower(tokens, i)) return text.replace(i, i, "isf_pow");
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
        if (names_.all().contains(name) || contains(kVariables, name) ||
            std::ranges::any_of(images_, [&](const std::string& image) { return isBeside(name, image); }))
          continue;
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
        slots += fillTemplate(templates::isf_slot, {{"@IMAGE@", names_.of(image)}, {"@NAME@", image}});
    return fillTemplate(templates::isf,
                        {{"@NAME@", name}, {"@PARAMETERS@\n", parameters}, {"@SLOTS@\n", slots}});
  }

  const IsfHeader& header_;
  const IsfNames& names_;
  text::Diagnostics& diagnostics_;
  text::FileName file_;  // that is being translated
  std::vector<std::string> images_;
  IsfShader out_;
};

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
    graph["resources"] = resources_;
    if (shares_) graph["sets"] = {{"controls", {{"parameters", uniforms_}}}};
    graph.update({{"passes", passes_}, {"present", picture_}});
    return graphText(graph);
  }

  // Whether a pass shows the last target, which is of another kind than the picture.
  bool showsLast() const { return shown_; }

 private:
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
    if (input.type != InputType::point && input.type != InputType::color) values_.emplace(input.name, value);
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
    if (!shader_.read.contains(input.name)) return;
    chosen_[input.name] = names_.fresh(name + "_or_none");
    resources_[chosen_[input.name]] = Json::array({name, nothing()});
  }

  // The resource that is read where there is no picture: transparent black.
  const std::string& nothing() {
    if (nothing_.empty()) nothing_ = names_.fresh("no_picture");
    resources_[nothing_] = {{"texture", "rgba8"}, {"size", "screen"}, {"clear", kClear}};
    return nothing_;
  }

  void addImported(const IsfImported& imported) {
    std::string path = imported.path.text;
    if (!path.starts_with('/') && !options_.sourceFolder.empty()) path = options_.sourceFolder + "/" + path;
    if (path.starts_with('$')) path = "./" + path;
    resources_[names_.of(imported.name)] = {{"import", "image"}, {"file", path}};
  }

  Json textureOf(bool floats, Json size) const {
    Json texture = {{"texture", floats ? "rgba32f" : "rgba8"}, {"size", std::move(size)}};
    if (!shader_.vertex.empty()) texture["clear"] = kClear;
    return texture;
  }

  void findTargets() {
    for (const IsfPass& pass : header_.passes) {
      if (pass.target.text.empty()) continue;
      IsfPass& target = targets_.try_emplace(pass.target.text, pass).first->second;
      target.persistent |= pass.persistent;
      target.floats |= pass.floats;
    }
    const IsfPass& last = header_.passes.back();
    for (const auto& [name, target] : targets_) {
      Json texture = textureOf(target.floats, sizeOf(target));
      if (target.persistent && shader_.read.contains(name)) texture["history"] = 1;
      resources_[names_.of(name)] = texture;
      if (name == last.target.text) shown_ = target.floats || last.isScaled() || target.isScaled();
    }
    if (!last.target.text.empty() && !shown_)
      picture_ = names_.of(last.target.text);
    else
      resources_[picture_] = textureOf(false, "screen");
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
    constexpr std::array<std::string_view, 13> kWords{"floor", "ceil", "min", "max", "abs", "+", "-",
                                                      "*",     "/",    "%",   "(",   ")",   ","};
    std::string out;
    bool variable = false;  // behind a '$'
    for (const glsl::Token& token : glsl::splitTokens(size.text)) {
      const std::string name = text::lowered(token.text);
      const auto value = values_.find(token.text);
      const bool known =
          variable ? value != values_.end()
                   : token.kind == glsl::TokenKind::number || token.is("$") || contains(kWords, name);
      if (!known) return wrong(fmt::format("unexpected '{}' in a size", token.text), token.column - variable);
      if (variable)
        out += value->second;
      else if (token.kind == glsl::TokenKind::number)  // Weft has digits on both sides of a point
        out += (name.front() == '.' ? "0" : "") + name + (name.back() == '.' ? "0" : "");
      else if (!token.is("$"))
        out += name + (token.is(",") ? " " : "");
      variable = !variable && token.is("$");
    }
    text::Diagnostics said;
    if (out.empty() && size.text.empty()) return otherwise;
    const auto expr = graph::Expr::parse(out, size.place, said);
    if (expr && std::ranges::none_of(kWords, [&](auto word) { return expr->says(word); })) return out;
    return wrong(said.empty() ? "a function needs its arguments" : said.items()[0].message);
  }

  Json sizeOf(const IsfPass& pass) {
    if (!pass.isScaled()) return "screen";
    return Json::array({sizeOf(pass.width, "screen.x"), sizeOf(pass.height, "screen.y")});
  }

  Json readsOf() {
    Json reads = Json::object();
    const auto add = [&](const std::string& name, const std::string& from) {
      reads[names_.of(name)] = from + " as linear";
    };
    for (const auto& [name, chosen] : chosen_) add(name, chosen);
    for (const IsfImported& imported : header_.imported)
      if (shader_.read.contains(imported.name)) add(imported.name, names_.of(imported.name));
    for (const auto& [name, target] : targets_)
      if (shader_.read.contains(name))
        add(name, contains(written_, name) ? names_.of(name)
                  : target.persistent      ? names_.of(name) + "@-1"
                                           : nothing());
    return reads;
  }

  void addPasses() {
    std::set<std::string, std::less<>> used;
    shares_ = !uniforms_.empty() && header_.passes.size() > 1;
    for (std::size_t i = 0; i < header_.passes.size(); ++i) {
      const PlacedText& drawn = header_.passes[i].target;
      if (drawn.text.empty() && i + 1 < header_.passes.size()) continue;  // the last pass draws the picture
      const std::string target = drawn.text.empty() ? picture_ : names_.of(drawn.text);
      const std::string name = freshName(used, "draw_" + target);
      Json pass = {{"name", name}};
      if (shader_.vertex.empty())
        pass.update({{"type", "fullscreen"}, {"shader", shader_.fragment}});
      else
        pass.update({{"type", "draw"},
                     {"geometry", "quad"},
                     {"instances", 1},
                     {"shader", {{"vertex", shader_.vertex}, {"fragment", shader_.fragment}}}});
      if (shares_) pass["use"] = "controls";
      if (Json reads = readsOf(); !reads.empty()) pass["read"] = std::move(reads);
      pass["write"] = {{kIsfOutput, target}};
      pass["defines"] = {{"PASSINDEX", i}};
      if (!shares_ && !uniforms_.empty()) pass["parameters"] = uniforms_;
      passes_.push_back(pass);
      written_.insert(drawn.text);
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
  Json passes_ = Json::array(), parameters_ = Json::object(), lets_ = Json::object(),
       resources_ = Json::object(), uniforms_ = Json::object();
  std::map<std::string, IsfPass, std::less<>> targets_;  // as the first pass that names it says
  std::set<std::string, std::less<>> written_;           // by passes before the one that is looked at
  std::map<std::string, std::string, std::less<>> values_{{"WIDTH", "screen.x"},
                                                          {"HEIGHT", "screen.y"}};  // of '$'
  std::map<std::string, std::string, std::less<>> chosen_;                          // of images, by input
  bool shown_ = false, shares_ = false;  // several passes have the parameters
};

}  // namespace

std::optional<Converted> convertIsf(const IsfSource& source, const ConvertOptions& options,
                                    text::Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.errorCount();
  const auto header = readIsfHeader(source.fragment, source.fragmentFile, diagnostics);
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
