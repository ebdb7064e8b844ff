#include "engine/graph/read/read_context.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "engine/base/files/text_file.h"
#include "engine/base/nearest.h"
#include "engine/base/words/glsl_words.h"
#include "engine/graph/language/names.h"
#include "engine/graph/read/ref_parse.h"

namespace weft::graph {

using base::Code;

base::Diagnostic& ReadContext::errorAt(Code code, const Place& place, std::string message) {
  auto& d = goesOn() ? diagnostics_.error(code, place, std::move(message)) : unkept_;
  d.pass = pass;
  d.resource = resource;
  return d;
}

base::Diagnostic& ReadContext::error(Code code, const JsonValue& value, std::string message) {
  return errorAt(code, value.place, std::move(message));
}

void ReadContext::adopt(const base::Diagnostics& said) {
  if (said.empty() || !goesOn()) return;
  for (base::Diagnostic d : said.items()) {
    d.pass = pass;
    d.resource = resource;
    diagnostics_.add(std::move(d));
  }
}

bool ReadContext::expect(const JsonValue& value, JsonValue::Type type, std::string_view what,
                         std::string hint) {
  if (value.is(type)) return true;
  auto& d = error(Code::wrongType, value, fmt::format("{} has the wrong type", what));
  d.expected = nameOf(type);
  d.found = describe(value);
  d.hint = std::move(hint);
  return false;
}

void ReadContext::checkKeys(const JsonValue& object, std::span<const KeySpec> keys, std::string_view what,
                            std::optional<base::Foreign> foreign) {
  std::vector<std::string> known, meant;
  for (const KeySpec& spec : keys) known.emplace_back(spec.key);
  for (const JsonMember& member : object.members) {
    if (std::find(known.begin(), known.end(), member.key) != known.end()) continue;
    if (!goesOn()) return;
    auto& d =
        errorAt(Code::unknownKey, member.place, fmt::format("unknown key \"{}\" in {}", member.key, what));
    const bool ofState = foreign == base::Foreign::pass_key &&
                         std::ranges::find(kStateKeys, member.key, &KeySpec::key) != kStateKeys.end();
    // A word of another program first: "groups" is no slip of "group".
    const base::ForeignWord theirs =
        foreign && !ofState ? base::findForeignWord(*foreign, member.key) : base::ForeignWord();
    const std::string nearest = base::nearestName(member.key, known);
    d.hint = ofState                ? fmt::format("it belongs into \"state\": {{ \"{}\": … }}", member.key)
             : !theirs.hint.empty() ? theirs.hint
             : nearest.empty()      ? fmt::format("known: {}", fmt::join(known, ", "))
                                    : fmt::format("did you mean \"{}\"?", nearest);
    meant.push_back(nearest);
    meant.push_back(theirs.key);  // "width" stands for "size"
  }
  for (const KeySpec& spec : keys) {
    if (!spec.required || object.find(spec.key) ||
        std::find(meant.begin(), meant.end(), spec.key) != meant.end())
      continue;
    auto& d = error(Code::missingKey, object, fmt::format("{} lacks the key \"{}\"", what, spec.key));
    d.hint = fmt::format("\"{}\": {}", spec.key, spec.doc);
  }
}

bool ReadContext::checkName(std::string_view name, const Place& place, std::string_view what) {
  const bool tooLong = name.size() > base::kMostNameBytes;
  if (isIdent(name) && !isReservedWord(name) && !tooLong) return true;
  if (tooLong && goesOn()) {
    auto& d = errorAt(Code::limitExceeded, place, fmt::format("the name of {} is too long", what));
    d.expected = fmt::format("at most {} bytes", base::kMostNameBytes);
    d.found = fmt::format("{} bytes", name.size());
    return false;
  }
  auto& d = errorAt(Code::notAName, place, fmt::format("\"{}\" cannot name {}", name, what));
  if (isReservedWord(name)) {
    d.expected = fmt::format("a word that is not reserved; reserved are {}", fmt::join(kReservedWords, ", "));
    d.hint = fmt::format("choose another, such as 'my_{}'", name);
  } else {
    d.expected = "letters, digits and '_', not beginning with a digit";
    if (name.empty() || std::ranges::any_of(name, [](char c) { return c < ' ' || c > '~'; })) return false;
    std::string good(name);
    for (char& c : good)
      if (!isIdentChar(c)) c = '_';
    if (!isIdentStart(good[0])) good.insert(good.begin(), '_');
    if (isIdent(good) && !isReservedWord(good)) d.hint = fmt::format("write '{}'", good);
  }
  return false;
}

bool ReadContext::checkShaderName(std::string_view name, const Place& place, std::string_view what) {
  if (!checkName(name, place, what)) return false;
  const bool define = what == "a define";
  // HAS_A__B of a parameter is a warning of drivers, and importers keep the names of parameters.
  const bool reserved = (what != "a parameter" && name.find("__") != std::string_view::npos) ||
                        (define && (name.starts_with("GL_") || name.starts_with("HAS_")));
  const bool function = define && base::isGlslFunction(name);
  if (!base::isGlslWord(name) && !reserved && !function) return true;
  auto& d = errorAt(Code::notAName, place,
                    fmt::format("\"{}\" cannot name {}: {}", name, what,
                                function    ? "it would hide a function of GLSL"
                                : !reserved ? "it is a word of GLSL"
                                : name.starts_with("HAS_")
                                    ? "HAS_… says which slots and parameters a pass has"
                                    : "GLSL keeps names with GL_ at the front or __ inside for itself"));
  if (reserved || function) {
    d.expected = define ? "a name that nothing else has in the shader" : "a name that the shader can declare";
    d.hint = "choose another here and in the shader";
    if (function) d.hint += fmt::format(", such as 'use_{}'", name);
    return false;
  }
  d.expected = "a name that the shader can declare";
  d.hint = fmt::format("choose another here and in the shader, such as 'my_{}'",
                       name.starts_with("gl_") ? name.substr(3) : name);
  return false;
}

bool ReadContext::checkFresh(Seen& seen, const std::string& name, const Place& place, std::string_view what) {
  const auto [before, fresh] = seen.try_emplace(name, place);
  if (fresh) return true;
  auto& d = errorAt(Code::duplicateName, place, fmt::format("{} '{}' is declared twice", what, name));
  d.hint = fmt::format("rename one; the first stands at {}:{}", before->second.line, before->second.column);
  return false;
}

std::string ReadContext::text(const JsonValue* value, std::string_view what) {
  return value && expect(*value, JsonValue::Type::string, what) ? value->text : std::string();
}

bool ReadContext::flag(const JsonValue* value, std::string_view what) {
  return value && expect(*value, JsonValue::Type::boolean, what) && value->flag;
}

std::optional<double> ReadContext::number(const JsonValue* value, std::string_view what) {
  if (!value || !expect(*value, JsonValue::Type::number, what)) return std::nullopt;
  return value->number;
}

std::optional<std::string> ReadContext::word(const JsonValue* value, std::span<const std::string_view> words,
                                             std::string_view what) {
  if (!value || !expect(*value, JsonValue::Type::string, what)) return std::nullopt;
  if (std::find(words.begin(), words.end(), value->text) != words.end()) return value->text;
  auto& d = error(Code::unknownWord, *value, fmt::format("unknown word \"{}\" for {}", value->text, what));
  d.expected = fmt::format("{}", fmt::join(words, ", "));
  if (std::ranges::find(words, "vec4") != words.end())  // types of parameters
    d.hint = base::hintForForeign(base::Foreign::value_type, value->text);
  for (const auto& [theirs, ours] :
       {std::pair("every_frame", "always"), std::pair("each_frame", "always"),
        std::pair("per_frame", "always"), std::pair("realtime", "always"), std::pair("changed", "on_change"),
        std::pair("on_demand", "on_change"), std::pair("static", "once"), std::pair("init", "once")})
    if (value->text == theirs && std::ranges::find(words, ours) != words.end())
      d.hint = fmt::format("write \"{}\"", ours);
  if (!d.hint.empty()) return std::nullopt;
  const std::vector<std::string> known(words.begin(), words.end());
  const std::string nearest = base::nearestName(value->text, known);
  if (nearest.empty()) return std::nullopt;
  d.hint = fmt::format("did you mean \"{}\"?", nearest);
  return nearest;  // read as what is meant, so that nothing else is reported because of it
}

Expr ReadContext::expr(const JsonValue* value, std::string_view what) {
  if (!value) return {};
  const auto wrong = [&](std::string expected) {
    auto& d = error(Code::wrongType, *value, fmt::format("{} has the wrong type", what));
    d.expected = std::move(expected);
    d.found = value->is(JsonValue::Type::array) ? fmt::format("an array of {}", value->items.size())
                                                : describe(*value);
    return Expr();
  };
  switch (value->type) {
    case JsonValue::Type::number:
      return Expr::constant(Value::number(value->number), value->place);
    case JsonValue::Type::boolean:
      return Expr::constant(Value::boolean(value->flag), value->place);
    case JsonValue::Type::string: {
      base::Diagnostics said;
      std::optional<Expr> parsed = Expr::parse(value->text, value->textPlace(), said);
      adopt(said);
      return parsed ? *std::move(parsed) : Expr();
    }
    case JsonValue::Type::array: {
      if (value->items.empty() || value->items.size() > 4)
        return wrong("a number, a list of 1 to 4 numbers, or an expression");
      std::vector<Expr> items;
      for (const JsonValue& item : value->items) {
        if (item.is(JsonValue::Type::array) || item.is(JsonValue::Type::object) ||
            item.is(JsonValue::Type::null)) {
          auto& d = error(Code::wrongType, item, fmt::format("an item of {} has the wrong type", what));
          d.expected = "a number or an expression";
          d.found = describe(item);
          continue;
        }
        if (Expr one = expr(&item, what); one.present()) items.push_back(std::move(one));
      }
      return items.size() == value->items.size() ? Expr::listOf(std::move(items), value->place) : Expr();
    }
    default:
      return wrong("a number, a boolean, a list, or an expression in a string");
  }
}

std::optional<RefDesc> ReadContext::ref(const JsonValue* value, std::string_view what) {
  if (!value) return std::nullopt;
  const bool one = value->is(JsonValue::Type::array) && value->items.size() == 1 &&
                   value->items[0].is(JsonValue::Type::string);
  if (!expect(*value, JsonValue::Type::string, what,
              one ? fmt::format("write \"{}\", without brackets", value->items[0].text) : ""))
    return std::nullopt;
  base::Diagnostics said;
  std::optional<RefDesc> parsed = parseRef(value->text, value->textPlace(), said);
  adopt(said);
  return parsed;
}

std::vector<const JsonValue*> ReadContext::strings(const JsonValue* value, std::string_view what) {
  std::vector<const JsonValue*> out;
  if (!value) return out;
  if (value->is(JsonValue::Type::string)) return {value};
  if (!value->is(JsonValue::Type::array)) {
    auto& d = error(Code::wrongType, *value, fmt::format("{} has the wrong type", what));
    d.expected = "a string or an array of strings";
    d.found = describe(*value);
    return out;
  }
  for (const JsonValue& item : value->items)
    if (expect(item, JsonValue::Type::string, fmt::format("an item of {}", what))) out.push_back(&item);
  return out;
}

}  // namespace weft::graph
