// The JSON header of an ISF file, with places in the file. Declared in isf.h.
#include <fmt/format.h>

#include <cmath>

#include "app/import/isf.h"
#include "engine/graph/language/names.h"
#include "engine/text/chars.h"
#include "engine/text/json/fields.h"
#include "engine/text/nearest.h"
#include "engine/text/words/glsl_words.h"

namespace weft::importing {

namespace {

using text::Code;
using text::Diagnostics;
using text::JsonValue;
using text::Place;
using InputType = IsfInput::Type;
using JsonType = JsonValue::Type;

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

}  // namespace

std::optional<IsfHeader> readIsfHeader(std::string_view text, const std::shared_ptr<const std::string>& file,
                                       Diagnostics& diagnostics) {
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
  const auto root = text::parseJson(json, file, diagnostics);
  if (!root) return std::nullopt;
  if (!root->is(JsonType::object)) {
    refuse(diagnostics, Code::notIsf, root->place, "the first comment is no ISF header",
           "write the header as /*{ … }*/");
    return std::nullopt;
  }
  IsfHeader header = HeaderReader(diagnostics).read(*root);
  return diagnostics.errorCount() > errors ? std::nullopt : std::optional(std::move(header));
}

IsfNames::IsfNames(const IsfHeader& header) {
  const auto add = [&](const std::string& name) {
    const bool kept = graph::isReservedWord(name) || contains(kDeclared, name) || text::isGlslWord(name);
    if (!name.empty() && !names_.contains(name)) names_[name] = fresh(kept ? name + "_" : name);
  };
  for (const IsfInput& input : header.inputs) add(input.name);
  for (const IsfImported& imported : header.imported) add(imported.name);
  for (const IsfPass& pass : header.passes) add(pass.target.text);
}

std::string IsfNames::fresh(std::string_view wanted) {
  std::string name;  // GLSL keeps names with two underscores in a row
  for (const char c : wanted)
    if (c != '_' || !name.ends_with('_')) name += c;
  return freshName(used_, name);
}

}  // namespace weft::importing
