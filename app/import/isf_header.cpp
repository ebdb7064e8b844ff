// The JSON header of an ISF file, with places in the file. Declared in isf.h.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/import/isf.h"
#include "app/import/text.h"
#include "engine/base/chars.h"
#include "engine/base/json/dom.h"
#include "engine/base/json/fields.h"
#include "engine/base/nearest.h"
#include "engine/base/words/glsl_words.h"

namespace weft::convert {

namespace {

using base::Code;
using base::Diagnostics;
using base::JsonValue;
using base::Place;
using JsonType = JsonValue::Type;

constexpr std::size_t kMaxPasses = 64;

// Of the GLSL of any player. Other words, such as `sample`, are names in some, and are renamed.
constexpr std::array<std::string_view, 45> kWordsOfGlsl{
    "attribute", "const", "uniform", "varying",   "break", "continue",  "do",        "for",         "while",
    "if",        "else",  "in",      "out",       "inout", "float",     "int",       "void",        "bool",
    "true",      "false", "lowp",    "mediump",   "highp", "precision", "discard",   "return",      "struct",
    "vec2",      "vec3",  "vec4",    "ivec2",     "ivec3", "ivec4",     "bvec2",     "bvec3",       "bvec4",
    "mat2",      "mat3",  "mat4",    "sampler2D", "main",  "invariant", "sampler3D", "samplerCube", "uint"};
// In the order of IsfInput::Type.
const std::array<std::string, 7> kTypes{"bool", "event", "long", "float", "point2D", "color", "image"};
constexpr const char* kTypesText = "bool, event, long, float, point2D, color or image";

// Words of graph files, and what the translated shader declares by itself.
constexpr std::array<std::string_view, 25> kKept{
    "mip",       "layer",  "face",       "stencil",          "x",     "y",        "z",
    "w",         "View",   "time",       "delta_time",       "frame", "uv",       "TIME",
    "TIMEDELTA", "DATE",   "FRAMEINDEX", "RENDERSIZE",       "date",  "viewport", "PASSINDEX",
    "main",      "screen", "Parameters", "isf_FragNormCoord"};

struct Comment {
  std::size_t begin = 0, end = 0;  // of what is between its marks
};

// The first comment of /* */, where nothing but spaces and comments of // is before it.
std::optional<Comment> firstComment(std::string_view text) {
  std::size_t at = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  while (at < text.size() && (base::isSpace(text[at]) || text.substr(at, 2) == "//"))
    at = base::isSpace(text[at]) ? at + 1 : std::min(text.find('\n', at), text.size());
  if (text.substr(at, 2) != "/*") return std::nullopt;
  const std::size_t end = text.find("*/", at + 2);
  return end == std::string_view::npos ? std::nullopt : std::optional(Comment{at + 2, end});
}

class HeaderReader {
 public:
  explicit HeaderReader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  IsfHeader readTop(const JsonValue& root) {
    if (!checkKeys(root, {"INPUTS"}, {"DESCRIPTION", "CREDIT", "PASSES", "PERSISTENT_BUFFERS", "IMPORTED"}))
      return {};
    out_.description = textOf(root, "DESCRIPTION");
    out_.credit = textOf(root, "CREDIT");
    for (const JsonValue& input : listOf(root, "INPUTS")) readInput(input);
    const std::span<const JsonValue> passes = listOf(root, "PASSES");
    if (passes.size() > kMaxPasses)
      fail(Code::isfNotMapped, root.find("PASSES")->place, "the file has too many passes",
           fmt::format("split the effect into several files of at most {}", kMaxPasses));
    else
      for (const JsonValue& pass : passes) readPass(pass);
    if (const JsonValue* buffers = root.find("PERSISTENT_BUFFERS")) readBuffers(*buffers);
    if (const JsonValue* imported = root.find("IMPORTED")) readImported(*imported);
    if (out_.passes.empty()) out_.passes.emplace_back().place = root.place;
    return std::move(out_);
  }

 private:
  void fail(Code code, const Place& place, std::string message, std::string hint) {
    refuse(diagnostics_, code, place, std::move(message), std::move(hint));
  }

  bool expect(const JsonValue& value, std::string_view name, JsonType type) {
    return base::expectType(value, name, type, diagnostics_);
  }

  static bool isSet(const JsonValue* value) { return value && !value->is(JsonType::null); }

  static std::string textOf(const JsonValue& object, std::string_view key) {
    const JsonValue* value = object.find(key);
    return value && value->is(JsonType::string) ? value->text : std::string();
  }

  // ISF files write true, 1 and "true".
  bool flagOf(const JsonValue& object, std::string_view key) {
    const JsonValue* value = object.find(key);
    if (!value) return false;
    if (value->is(JsonType::number)) return value->number != 0;
    if (value->is(JsonType::string))
      return value->text == "true" || value->text == "1" || value->text == "YES";
    return expect(*value, key, JsonType::boolean) && value->flag;
  }

  std::span<const JsonValue> listOf(const JsonValue& object, std::string_view key) {
    const JsonValue* value = object.find(key);
    if (!isSet(value) || !expect(*value, key, JsonType::array)) return {};
    return value->items;
  }

  // The keys of ISF are in capitals; a key that is known but for that says nothing to players. False where nothing works without
  // it.
  bool checkKeys(const JsonValue& object, std::initializer_list<std::string_view> needed,
                 std::initializer_list<std::string_view> known) {
    bool good = true;
    for (const base::JsonMember& member : object.members) {
      std::string capitals = member.key;
      for (char& c : capitals) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
      const bool must = contains(needed, capitals);
      if (capitals == member.key || object.find(capitals) || !(must || contains(known, capitals))) continue;
      const std::string hint = fmt::format("write \"{}\": the keys of ISF are in capitals", capitals);
      if (must)
        fail(Code::unknownKey, member.place, fmt::format("unknown key \"{}\"", member.key), hint);
      else
        diagnostics_
            .warning(Code::isfNotMapped, member.place,
                     fmt::format("the key \"{}\" is not one of ISF, and is ignored", member.key))
            .hint = hint;
      good = good && !must;
    }
    return good;
  }

  bool checkName(const JsonValue& at, std::string_view name, std::string_view what) {
    const bool word = contains(kWordsOfGlsl, name);
    const bool good = !name.empty() && base::isIdentStart(name[0]) && !word && name.size() <= 64 &&
                      std::ranges::all_of(name, base::isIdentChar) && !name.starts_with("gl_") &&
                      name.find("__") == name.npos;
    if (!good) {
      fail(Code::notAName, at.place, fmt::format("\"{}\" cannot name {}", name, what),
           word ? "no player can declare a variable with the name of this word of GLSL: give it another "
                  "name, here and in the shader"
                : "use letters, digits and '_', not beginning with a digit, here and in the shader");
      return false;
    }
    const auto [before, fresh] = places_.emplace(name, at.place);
    if (!fresh)
      fail(Code::duplicateName, at.place, fmt::format("two things have the name '{}'", name),
           fmt::format("rename one; the first is at {}:{}", before->second.line, before->second.column));
    return fresh;
  }

  // A number, a boolean, or a list of numbers.
  std::vector<double> numbersOf(const JsonValue& object, std::string_view key, std::size_t count) {
    const JsonValue* value = object.find(key);
    std::vector<double> numbers;
    if (!isSet(value)) return numbers;
    if (value->is(JsonType::boolean)) numbers.push_back(value->flag ? 1 : 0);
    if (value->is(JsonType::number)) numbers.push_back(value->number);
    if (value->is(JsonType::array))
      for (const JsonValue& item : value->items)
        if (item.is(JsonType::number)) numbers.push_back(item.number);
    if (count == 4 && numbers.size() == 3) numbers.push_back(1);  // an opaque colour
    const bool all = std::ranges::all_of(numbers, [](double x) { return std::abs(x) <= 3e38; });
    if (numbers.size() == count && all) return numbers;
    fail(Code::wrongType, value->place, fmt::format("{} has the wrong type", key),
         count == 1 ? "write a number or a boolean" : fmt::format("write a list of {} numbers", count));
    return {};
  }

  void checkWhole(double x, const Place& place, const std::string& what) {
    if (x != std::floor(x) || std::abs(x) > 2147483647.0)
      fail(Code::outOfRange, place, what + " is no whole number",
           "a long is a whole number of 32 bits; for a fraction the TYPE is float");
  }

  void readInput(const JsonValue& value) {
    if (!expect(value, "an input", JsonType::object)) return;
    if (!checkKeys(value, {"NAME", "TYPE"}, {"LABEL", "DEFAULT", "MIN", "MAX", "VALUES", "LABELS"})) return;
    base::JsonFields fields(value, "an input", Code::outOfRange, diagnostics_);
    fields.require({"NAME", "TYPE"});
    const JsonValue* name = value.find("NAME");
    const auto type = fields.text("TYPE");
    if (!name || !type || !expect(*name, "NAME", JsonType::string)) return;
    const auto found = std::ranges::find(kTypes, *type);
    if (found == kTypes.end()) return refuseType(value.find("TYPE")->place, *type);
    if (!checkName(*name, name->text, "an input")) return;
    IsfInput input{.name = name->text,
                   .type = static_cast<IsfInput::Type>(found - kTypes.begin()),
                   .place = name->place,
                   .label = textOf(value, "LABEL")};
    readRange(value, input);
    out_.inputs.push_back(std::move(input));
  }

  void refuseType(const Place& place, const std::string& type) {
    static constexpr std::array<std::string_view, 6> kOther{"audio",   "audioFFT", "cube",
                                                            "point3D", "text",     "audioFloatHistogram"};
    if (contains(kOther, type))
      fail(Code::isfNotMapped, place,
           fmt::format("an input of the type \"{}\" has no counterpart in Weft", type),
           type.starts_with("audio") ? "make it an image, and give a picture of the sound to it"
                                     : "remove the input from the file and from the shader");
    else
      fail(Code::unknownWord, place, fmt::format("unknown type of input \"{}\"", type),
           base::nearestHint(type, kTypes));
  }

  void readRange(const JsonValue& value, IsfInput& input) {
    using T = IsfInput::Type;
    if (input.type == T::image) return;
    const std::size_t count = input.type == T::point ? 2 : input.type == T::color ? 4 : 1;
    input.initial = numbersOf(value, "DEFAULT", count);
    if (input.type == T::event || input.type == T::boolean) return;
    input.min = numbersOf(value, "MIN", count);
    input.max = numbersOf(value, "MAX", count);
    if (input.type != T::integer) return;
    for (const double x : input.initial)
      checkWhole(x, value.find("DEFAULT")->place, fmt::format("the default of '{}'", input.name));
    for (const JsonValue& each : listOf(value, "VALUES")) {
      if (!expect(each, "one of VALUES", JsonType::number)) return;
      checkWhole(each.number, each.place, fmt::format("a value of '{}'", input.name));
      input.values.push_back(each.number);
    }
    for (const JsonValue& each : listOf(value, "LABELS"))
      input.labels.push_back(each.is(JsonType::number) ? fmt::format("{}", each.number) : each.text);
    if (input.labels.size() != input.values.size()) input.labels.clear();
  }

  void readSize(const JsonValue& value, std::string_view key, std::string& text, Place& place) {
    const JsonValue* size = value.find(key);
    if (!isSet(size)) return;
    place = size->is(JsonType::string) ? size->textPlace() : size->place;
    if (size->is(JsonType::number))
      text = fmt::format("{}", size->number);
    else if (expect(*size, key, JsonType::string))
      text = size->text;
  }

  void readStorage(const JsonValue& value, IsfPass& pass) {
    pass.floats |= flagOf(value, "FLOAT");
    readSize(value, "WIDTH", pass.width, pass.widthPlace);
    readSize(value, "HEIGHT", pass.height, pass.heightPlace);
  }

  void readPass(const JsonValue& value) {
    if (!expect(value, "a pass", JsonType::object)) return;
    checkKeys(value, {}, {"TARGET", "PERSISTENT", "FLOAT", "WIDTH", "HEIGHT"});
    IsfPass pass{.place = value.place};
    const JsonValue* target = value.find("TARGET");
    if (isSet(target) && expect(*target, "TARGET", JsonType::string)) {
      pass.target = target->text;
      pass.place = target->place;
      const bool again = std::ranges::find(out_.passes, pass.target, &IsfPass::target) != out_.passes.end();
      if (!pass.target.empty() && !again) checkName(*target, pass.target, "a target");
    }
    pass.persistent = flagOf(value, "PERSISTENT");
    readStorage(value, pass);
    out_.passes.push_back(std::move(pass));
  }

  // Version 1: a list of names, or an object of sizes by name.
  void readBuffers(const JsonValue& buffers) {
    const auto mark = [&](const std::string& name, const JsonValue* sizes, const Place& place) {
      bool found = false;
      for (IsfPass& pass : out_.passes) {
        if (pass.target != name) continue;
        pass.persistent = found = true;
        if (sizes && checkKeys(*sizes, {}, {"FLOAT", "WIDTH", "HEIGHT"})) readStorage(*sizes, pass);
      }
      if (!found)
        diagnostics_
            .warning(Code::isfNotMapped, place,
                     fmt::format("no pass draws into the persistent buffer '{}'", name))
            .hint = "it is left out";
    };
    if (buffers.is(JsonType::array)) {
      for (const JsonValue& name : buffers.items)
        if (expect(name, "a name in PERSISTENT_BUFFERS", JsonType::string))
          mark(name.text, nullptr, name.place);
    } else if (expect(buffers, "PERSISTENT_BUFFERS", JsonType::object)) {
      for (const base::JsonMember& member : buffers.members)
        mark(member.key, member.value.is(JsonType::object) ? &member.value : nullptr, member.place);
    }
  }

  void readImported(const JsonValue& imported) {
    const auto add = [&](const std::string& name, const JsonValue& value) {
      if (!expect(value, "an imported picture", JsonType::object)) return;
      if (!checkKeys(value, {"NAME", "PATH"}, {})) return;
      const JsonValue* path = value.find("PATH");
      if (!path || !path->is(JsonType::string))
        fail(path ? Code::isfNotMapped : Code::missingKey, path ? path->place : value.place,
             fmt::format("the imported picture '{}' has no PATH of one file", name),
             "a cube map has no counterpart; name one picture: \"PATH\": \"picture.png\"");
      else if (checkName(value, name, "an imported picture"))
        out_.imported.push_back({name, path->text, path->textPlace()});
    };
    if (imported.is(JsonType::array)) {
      for (const JsonValue& each : imported.items) add(textOf(each, "NAME"), each);
    } else if (expect(imported, "IMPORTED", JsonType::object)) {
      for (const base::JsonMember& member : imported.members) add(member.key, member.value);
    }
  }

  Diagnostics& diagnostics_;
  IsfHeader out_;
  std::map<std::string, Place, std::less<>> places_;  // of names
};

}  // namespace

bool looksLikeIsf(std::string_view text) {
  const auto comment = firstComment(text);
  if (!comment) return false;
  const std::size_t at = text.find_first_not_of(" \t\r\n", comment->begin);
  return at < comment->end && text[at] == '{';
}

std::optional<IsfHeader> readIsfHeader(std::string_view text, const std::shared_ptr<const std::string>& file,
                                       Diagnostics& diagnostics) {
  const auto comment = firstComment(text);
  if (!comment) {
    refuse(diagnostics, Code::notIsf, {file, 1, 1}, "the file has no ISF header",
           "begin it with a comment /*{ … }*/ that holds a JSON object; see https://docs.isf.video");
    return std::nullopt;
  }
  // Blanks for all that is before, so that places are those of the file.
  std::string json(text.substr(0, comment->end));
  for (std::size_t i = 0; i < comment->begin; ++i)
    if (json[i] != '\n') json[i] = ' ';
  const std::size_t errors = diagnostics.errorCount();
  const base::PointerScope pointers(*file, json, diagnostics);
  const auto root = base::parseJson(json, file, diagnostics);
  if (!root) return std::nullopt;
  if (!root->is(JsonType::object)) {
    refuse(diagnostics, Code::notIsf, root->place, "the first comment is no ISF header",
           "write the header as /*{ … }*/");
    return std::nullopt;
  }
  IsfHeader header = HeaderReader(diagnostics).readTop(*root);
  return diagnostics.errorCount() > errors ? std::nullopt : std::optional(std::move(header));
}

IsfNames::IsfNames(const IsfHeader& header) {
  const auto add = [&](const std::string& name) {
    if (!names_.contains(name))
      names_[name] = fresh(contains(kKept, name) || base::isGlslWord(name) ? name + "_" : name);
  };
  for (const IsfInput& input : header.inputs) add(input.name);
  for (const IsfImported& imported : header.imported) add(imported.name);
  for (const IsfPass& pass : header.passes)
    if (!pass.target.empty()) add(pass.target);
}

std::string IsfNames::fresh(std::string_view wanted) {
  std::string name;  // GLSL keeps names with two underscores in a row
  for (const char c : wanted)
    if (c != '_' || !name.ends_with('_')) name += c;
  return freshName(used_, name);
}

}  // namespace weft::convert
