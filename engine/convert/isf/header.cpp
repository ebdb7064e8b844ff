#include "engine/convert/isf/header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "engine/base/chars.h"
#include "engine/base/json/dom.h"
#include "engine/base/json/fields.h"
#include "engine/base/nearest.h"

namespace weft::convert {

namespace {

using base::Code;
using base::Diagnostics;
using base::JsonFields;
using base::JsonValue;
using base::Place;
using JsonType = JsonValue::Type;

constexpr std::size_t kMostPasses = 64;

// Of the GLSL of any player. Other words, such as `sample`, are names in some, and are renamed.
constexpr std::array<std::string_view, 45> kWordsOfGlsl{
    "attribute", "const", "uniform", "varying",   "break", "continue",  "do",        "for",         "while",
    "if",        "else",  "in",      "out",       "inout", "float",     "int",       "void",        "bool",
    "true",      "false", "lowp",    "mediump",   "highp", "precision", "discard",   "return",      "struct",
    "vec2",      "vec3",  "vec4",    "ivec2",     "ivec3", "ivec4",     "bvec2",     "bvec3",       "bvec4",
    "mat2",      "mat3",  "mat4",    "sampler2D", "main",  "invariant", "sampler3D", "samplerCube", "uint"};

struct Comment {
  std::size_t begin = 0, end = 0;  // of what stands between its marks
};

// The first comment of /* */, where nothing but spaces and comments of // stands before it.
std::optional<Comment> firstComment(std::string_view text) {
  std::size_t at = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  while (at < text.size() && (base::isSpace(text[at]) || text.substr(at, 2) == "//"))
    at = base::isSpace(text[at]) ? at + 1 : std::min(text.find('\n', at), text.size());
  if (text.substr(at, 2) != "/*") return std::nullopt;
  const std::size_t end = text.find("*/", at + 2);
  if (end == std::string_view::npos) return std::nullopt;
  return Comment{at + 2, end};
}

class HeaderReader {
 public:
  HeaderReader(std::shared_ptr<const std::string> file, Diagnostics& diagnostics)
      : file_(std::move(file)), diagnostics_(diagnostics) {}

  std::optional<IsfHeader> run(std::string_view text) {
    const auto comment = firstComment(text);
    if (!comment) {
      auto& d = diagnostics_.error(Code::notIsf, {file_, 1, 1}, "the file has no ISF header");
      d.expected = "a comment /*{ … }*/ with a JSON object, behind nothing but comments of //";
      d.hint = "an ISF file begins with it; see https://docs.isf.video";
      return std::nullopt;
    }
    // Blanks for all that stands before, so that places are those of the file.
    std::string json(text.substr(0, comment->begin));
    for (char& c : json) c = c == '\n' ? '\n' : ' ';
    json += text.substr(comment->begin, comment->end - comment->begin);
    const std::size_t errors = diagnostics_.errorCount();
    const base::PointerScope pointers(*file_, json, diagnostics_);
    const auto root = base::parseJson(json, file_, diagnostics_);
    if (!root) return std::nullopt;
    if (!root->is(JsonType::object)) {
      auto& d = diagnostics_.error(Code::notIsf, root->place, "the first comment is no ISF header");
      d.expected = "an object";
      d.found = base::describe(*root);
      d.hint = "write the header as /*{ … }*/";
      return std::nullopt;
    }
    readTop(*root);
    if (diagnostics_.errorCount() > errors) return std::nullopt;
    if (out_.passes.empty()) out_.passes.emplace_back().place = root->place;
    return std::move(out_);
  }

 private:
  static std::string textOf(const JsonValue& object, std::string_view key) {
    const JsonValue* value = object.find(key);
    return value && value->is(JsonType::string) ? value->text : std::string();
  }

  // ISF files write true, 1 and "true".
  bool flagOf(const JsonValue& object, std::string_view key) {
    const JsonValue* value = object.find(key);
    if (!value) return false;
    if (value->is(JsonType::boolean)) return value->flag;
    if (value->is(JsonType::number)) return value->number != 0;
    if (value->is(JsonType::string))
      return value->text == "true" || value->text == "1" || value->text == "YES";
    base::expectType(*value, key, JsonType::boolean, diagnostics_);
    return false;
  }

  const JsonValue* listOf(const JsonValue& object, std::string_view key) {
    const JsonValue* value = object.find(key);
    if (!value || value->is(JsonType::null)) return nullptr;
    return base::expectType(*value, key, JsonType::array, diagnostics_) ? value : nullptr;
  }

  // The keys of ISF are in capitals; a key that is known but for that says nothing to players. False where nothing works without it.
  bool checkKeys(const JsonValue& object, std::initializer_list<std::string_view> needed,
                 std::initializer_list<std::string_view> known) {
    bool good = true;
    for (const base::JsonMember& member : object.members) {
      std::string capitals = member.key;
      for (char& c : capitals) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
      if (capitals == member.key || object.find(capitals)) continue;
      const std::string hint = fmt::format("write \"{}\": the keys of ISF are in capitals", capitals);
      if (std::ranges::find(needed, std::string_view(capitals)) != needed.end()) {
        diagnostics_.error(Code::unknownKey, member.place, fmt::format("unknown key \"{}\"", member.key))
            .hint = hint;
        good = false;
      } else if (std::ranges::find(known, std::string_view(capitals)) != known.end()) {
        diagnostics_
            .warning(Code::isfNotMapped, member.place,
                     fmt::format("the key \"{}\" is none of ISF, and is left out", member.key))
            .hint = hint;
      }
    }
    return good;
  }

  void readTop(const JsonValue& root) {
    if (!checkKeys(root, {"INPUTS"}, {"DESCRIPTION", "CREDIT", "PASSES", "PERSISTENT_BUFFERS", "IMPORTED"}))
      return;
    out_.description = textOf(root, "DESCRIPTION");
    out_.credit = textOf(root, "CREDIT");
    if (const JsonValue* inputs = listOf(root, "INPUTS"))
      for (const JsonValue& input : inputs->items) readInput(input);
    if (const JsonValue* passes = listOf(root, "PASSES")) {
      if (passes->items.size() > kMostPasses) {
        auto& d = diagnostics_.error(Code::isfNotMapped, passes->place, "the file has too many passes");
        d.expected = fmt::format("at most {}", kMostPasses);
        d.found = fmt::format("{}", passes->items.size());
        d.hint = "split the effect into several files";
        return;
      }
      for (const JsonValue& pass : passes->items) readPass(pass);
    }
    if (const JsonValue* buffers = root.find("PERSISTENT_BUFFERS")) readBuffers(*buffers);
    if (const JsonValue* imported = root.find("IMPORTED")) readImported(*imported);
  }

  bool checkName(const JsonValue& at, std::string_view name, std::string_view what) {
    const bool good = !name.empty() && base::isIdentStart(name[0]) &&
                      std::ranges::all_of(name, base::isIdentChar) && name.size() <= 64 &&
                      !name.starts_with("gl_") && name.find("__") == name.npos;
    if (!good) {
      auto& d =
          diagnostics_.error(Code::notAName, at.place, fmt::format("\"{}\" cannot name {}", name, what));
      d.expected =
          "letters, digits and '_', not beginning with a digit: a variable of the shader has this name";
      d.hint = "give it another name, here and in the shader";
      return false;
    }
    if (std::ranges::find(kWordsOfGlsl, name) != kWordsOfGlsl.end()) {
      auto& d =
          diagnostics_.error(Code::notAName, at.place, fmt::format("\"{}\" cannot name {}", name, what));
      d.expected = "no word of GLSL: no player can declare a variable of this name";
      d.hint = "give it another name, here and in the shader";
      return false;
    }
    const auto [before, fresh] = names_.emplace(name, at.place);
    if (!fresh) {
      diagnostics_.error(Code::duplicateName, at.place, fmt::format("two things have the name '{}'", name))
          .hint =
          fmt::format("rename one; the first stands at {}:{}", before->second.line, before->second.column);
      return false;
    }
    return true;
  }

  // A number, a boolean, or a list of numbers.
  std::vector<double> numbersOf(const JsonValue& object, std::string_view key, std::size_t count) {
    const JsonValue* value = object.find(key);
    std::vector<double> numbers;
    if (!value || value->is(JsonType::null)) return numbers;
    if (value->is(JsonType::boolean)) numbers.push_back(value->flag ? 1 : 0);
    if (value->is(JsonType::number)) numbers.push_back(value->number);
    if (value->is(JsonType::array))
      for (const JsonValue& item : value->items)
        if (item.is(JsonType::number)) numbers.push_back(item.number);
    if (count == 4 && numbers.size() == 3) numbers.push_back(1);  // an opaque colour
    const bool all = std::ranges::all_of(numbers, [](double x) { return std::abs(x) <= 3e38; });
    if (numbers.size() == count && all) return numbers;
    auto& d = diagnostics_.error(Code::wrongType, value->place, fmt::format("{} has the wrong type", key));
    d.expected = count == 1 ? "a number or a boolean" : fmt::format("a list of {} numbers", count);
    d.found = value->is(JsonType::array) ? fmt::format("a list with {} numbers", numbers.size())
                                         : base::describe(*value);
    d.hint = "write a value that fits the TYPE of the input";
    return {};
  }

  void readInput(const JsonValue& value) {
    if (!base::expectType(value, "an input", JsonType::object, diagnostics_)) return;
    if (!checkKeys(value, {"NAME", "TYPE"}, {"LABEL", "DEFAULT", "MIN", "MAX", "VALUES", "LABELS"})) return;
    JsonFields fields(value, "an input", Code::outOfRange, diagnostics_);
    fields.require({"NAME", "TYPE"});
    const JsonValue* name = value.find("NAME");
    const auto type = fields.text("TYPE");
    if (!name || !type) return;
    if (!base::expectType(*name, "NAME", JsonType::string, diagnostics_)) return;
    IsfInput input{.name = name->text, .place = name->place};
    using T = IsfInput::Type;
    static constexpr std::array<std::pair<std::string_view, T>, 7> kTypes{{{"bool", T::boolean},
                                                                           {"event", T::event},
                                                                           {"long", T::integer},
                                                                           {"float", T::number},
                                                                           {"point2D", T::point},
                                                                           {"color", T::color},
                                                                           {"image", T::image}}};
    const auto found =
        std::ranges::find(kTypes, std::string_view(*type), [](const auto& each) { return each.first; });
    if (found == kTypes.end()) return refuseType(value, *type);
    if (!checkName(*name, input.name, "an input")) return;
    input.type = found->second;
    input.label = textOf(value, "LABEL");
    readRange(value, input);
    out_.inputs.push_back(std::move(input));
  }

  void refuseType(const JsonValue& input, const std::string& type) {
    const Place& place = input.find("TYPE")->place;
    static constexpr std::array<std::string_view, 6> kOther{"audio",   "audioFFT", "cube",
                                                            "point3D", "text",     "audioFloatHistogram"};
    if (std::ranges::find(kOther, std::string_view(type)) != kOther.end()) {
      auto& d =
          diagnostics_.error(Code::isfNotMapped, place,
                             fmt::format("an input of the type \"{}\" has no counterpart in Weft", type));
      d.expected = "bool, event, long, float, point2D, color or image";
      d.hint = type.starts_with("audio") ? "make it an image, and give a picture of the sound to it"
                                         : "take the input out of the file and of the shader";
      return;
    }
    auto& d = diagnostics_.error(Code::unknownWord, place, fmt::format("unknown type of input \"{}\"", type));
    d.expected = "bool, event, long, float, point2D, color or image";
    const std::array<std::string, 7> known{"bool", "event", "long", "float", "point2D", "color", "image"};
    if (const std::string near = base::nearestName(type, known); !near.empty())
      d.hint = fmt::format("did you mean \"{}\"?", near);
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
    for (double x : input.initial)
      if (x != std::floor(x) || std::abs(x) > 2147483647.0) {
        auto& d = diagnostics_.error(Code::outOfRange, value.find("DEFAULT")->place,
                                     fmt::format("the default of '{}' is no whole number", input.name));
        d.expected = "a whole number of 32 bits";
        d.found = fmt::format("{}", x);
        d.hint = "a long is a whole number; for a fraction the TYPE is float";
      }
    if (const JsonValue* values = listOf(value, "VALUES"))
      for (const JsonValue& each : values->items) {
        if (!base::expectType(each, "one of VALUES", JsonType::number, diagnostics_)) return;
        if (each.number != std::floor(each.number) || std::abs(each.number) > 2147483647.0) {
          auto& d = diagnostics_.error(Code::outOfRange, each.place,
                                       fmt::format("a value of '{}' is no whole number", input.name));
          d.expected = "a whole number of 32 bits";
          d.found = base::describe(each);
          d.hint = "a long is a whole number; for a fraction the TYPE is float";
          return;
        }
        input.values.push_back(each.number);
      }
    if (const JsonValue* labels = listOf(value, "LABELS"))
      for (const JsonValue& each : labels->items)
        input.labels.push_back(each.is(JsonType::string)   ? each.text
                               : each.is(JsonType::number) ? fmt::format("{}", each.number)
                                                           : std::string());
    if (input.labels.size() != input.values.size()) input.labels.clear();
  }

  void readSize(const JsonValue& value, std::string_view key, std::string& text, Place& place) {
    const JsonValue* size = value.find(key);
    if (!size || size->is(JsonType::null)) return;
    place = size->place;
    if (size->is(JsonType::number))
      text = fmt::format("{}", size->number);
    else if (base::expectType(*size, key, JsonType::string, diagnostics_)) {
      text = size->text;
      place = size->textPlace();
    }
  }

  void readPass(const JsonValue& value) {
    if (!base::expectType(value, "a pass", JsonType::object, diagnostics_)) return;
    checkKeys(value, {}, {"TARGET", "PERSISTENT", "FLOAT", "WIDTH", "HEIGHT"});
    IsfPass pass{.place = value.place};
    if (const JsonValue* target = value.find("TARGET");
        target && !target->is(JsonType::null) &&
        base::expectType(*target, "TARGET", JsonType::string, diagnostics_)) {
      pass.target = target->text;
      pass.place = target->place;
      const bool again =
          std::ranges::any_of(out_.passes, [&](const IsfPass& p) { return p.target == pass.target; });
      if (!pass.target.empty() && !again) checkName(*target, pass.target, "a target");
    }
    pass.persistent = flagOf(value, "PERSISTENT");
    pass.floats = flagOf(value, "FLOAT");
    readSize(value, "WIDTH", pass.width, pass.widthPlace);
    readSize(value, "HEIGHT", pass.height, pass.heightPlace);
    out_.passes.push_back(std::move(pass));
  }

  // Version 1: a list of names, or an object of sizes by name.
  void readBuffers(const JsonValue& buffers) {
    const auto mark = [&](const std::string& name, const JsonValue* sizes, const Place& place) {
      bool found = false;
      for (IsfPass& pass : out_.passes)
        if (pass.target == name) {
          pass.persistent = found = true;
          if (!sizes) continue;
          checkKeys(*sizes, {}, {"FLOAT", "WIDTH", "HEIGHT"});
          pass.floats |= flagOf(*sizes, "FLOAT");
          readSize(*sizes, "WIDTH", pass.width, pass.widthPlace);
          readSize(*sizes, "HEIGHT", pass.height, pass.heightPlace);
        }
      if (found) return;
      diagnostics_
          .warning(Code::isfNotMapped, place,
                   fmt::format("no pass draws into the persistent buffer '{}'", name))
          .hint = "it is left out";
    };
    if (buffers.is(JsonType::array)) {
      for (const JsonValue& name : buffers.items)
        if (base::expectType(name, "a name in PERSISTENT_BUFFERS", JsonType::string, diagnostics_))
          mark(name.text, nullptr, name.place);
    } else if (base::expectType(buffers, "PERSISTENT_BUFFERS", JsonType::object, diagnostics_)) {
      for (const base::JsonMember& member : buffers.members)
        mark(member.key, member.value.is(JsonType::object) ? &member.value : nullptr, member.place);
    }
  }

  void readImported(const JsonValue& imported) {
    const auto add = [&](const std::string& name, const JsonValue& value, const JsonValue& at) {
      if (!base::expectType(value, "an imported picture", JsonType::object, diagnostics_)) return;
      if (!checkKeys(value, {"NAME", "PATH"}, {})) return;
      const JsonValue* path = value.find("PATH");
      if (!path || !path->is(JsonType::string)) {
        auto& d =
            diagnostics_.error(path ? Code::isfNotMapped : Code::missingKey, path ? path->place : value.place,
                               fmt::format("the imported picture '{}' has no PATH of one file", name));
        d.expected = "\"PATH\": \"picture.png\"";
        if (path) d.found = base::describe(*path);
        d.hint = "a cube map has no counterpart; name one picture";
        return;
      }
      if (checkName(at, name, "an imported picture"))
        out_.imported.push_back({name, path->text, path->textPlace()});
    };
    if (imported.is(JsonType::array)) {
      for (const JsonValue& each : imported.items) add(textOf(each, "NAME"), each, each);
    } else if (base::expectType(imported, "IMPORTED", JsonType::object, diagnostics_)) {
      for (const base::JsonMember& member : imported.members) add(member.key, member.value, member.value);
    }
  }

  std::shared_ptr<const std::string> file_;
  Diagnostics& diagnostics_;
  IsfHeader out_;
  std::map<std::string, Place, std::less<>> names_;
};

}  // namespace

bool looksLikeIsf(std::string_view text) {
  const auto comment = firstComment(text);
  if (!comment) return false;
  std::size_t at = comment->begin;
  while (at < comment->end && base::isSpace(text[at])) ++at;
  return at < comment->end && text[at] == '{';
}

std::optional<IsfHeader> readIsfHeader(std::string_view text, const std::shared_ptr<const std::string>& file,
                                       Diagnostics& diagnostics) {
  return HeaderReader(file, diagnostics).run(text);
}

}  // namespace weft::convert
