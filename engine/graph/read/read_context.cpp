#include "engine/graph/read/read_context.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "engine/graph/language/names.h"
#include "engine/graph/read/ref_parse.h"
#include "engine/text/nearest.h"
#include "engine/text/words/glsl_words.h"

namespace weft::graph {

using text::Code;
using Type = JsonValue::Type;

namespace {

std::string quoted(std::string_view key) {
  return fmt::format("\"{}\"", key);
}

// Why a shader cannot have the name; "" when it can.
const char* whyNoShaderName(std::string_view name, const Named& named) {
  if (!named.inShader) return "";
  if (text::isGlslWord(name)) return "it is a word of GLSL";
  if (named.isDefine && text::isGlslFunction(name)) return "it would hide a function of GLSL";
  if (named.isDefine && name.starts_with("HAS_")) return "HAS_… says which slots and parameters a pass has";
  return (!named.underscores && name.find("__") != std::string_view::npos) ||
                 (named.isDefine && name.starts_with("GL_"))
             ? "GLSL keeps names with GL_ at the front or __ inside for itself"
             : "";
}

}  // namespace

std::string foundText(const JsonValue& value) {
  return value.is(Type::array) ? fmt::format("an array of {}", value.items.size()) : describe(value);
}

text::Diagnostic& ReadContext::error(Code code, const Place& place, std::string message) {
  auto& d = goesOn() ? diagnostics_.error(code, place, std::move(message)) : unkept_;
  d.pass = pass;
  d.resource = resource;
  return d;
}

void ReadContext::adopt(const text::Diagnostics& said) {
  if (!goesOn()) return;
  for (text::Diagnostic d : said.items()) {
    d.pass = pass;
    d.resource = resource;
    diagnostics_.add(std::move(d));
  }
}

text::Diagnostic& ReadContext::wrongType(const JsonValue& value, std::string_view what,
                                         std::string expected) {
  auto& d = error(Code::wrongType, value, fmt::format("{} has the wrong type", what));
  d.expected = std::move(expected);
  d.found = foundText(value);
  return d;
}

bool ReadContext::expect(const JsonValue& value, Type type, std::string_view what, std::string hint) {
  if (value.is(type)) return true;
  wrongType(value, what, nameOf(type)).hint = std::move(hint);
  return false;
}

bool ReadContext::checkName(std::string_view name, const Place& place, const Named& named) {
  if (name.size() > text::kMaxNameBytes) {
    auto& d = error(Code::limitExceeded, place, fmt::format("the name of {} is too long", named.noun));
    d.expected = fmt::format("at most {} bytes", text::kMaxNameBytes);
    d.found = fmt::format("{} bytes", name.size());
    return false;
  }
  const bool ident = isIdent(name), reserved = isReservedWord(name);
  const std::string why = ident && !reserved ? whyNoShaderName(name, named) : "";
  if (ident && !reserved && why.empty()) return true;
  auto& d = error(Code::notAName, place,
                  fmt::format("\"{}\" cannot name {}{}{}", name, named.noun, why.empty() ? "" : ": ", why));
  if (!ident) {
    d.expected = "letters, digits and '_', not beginning with a digit";
    std::string good(name);
    for (char& c : good)
      if (!isIdentChar(c)) c = '_';
    if (!good.empty() && !isIdentStart(good[0])) good.insert(good.begin(), '_');
    if (isIdent(good)) d.hint = fmt::format("write '{}'", good);
  } else if (reserved) {
    d.expected = fmt::format("a word that is not reserved; reserved are {}", fmt::join(kReservedWords, ", "));
    d.hint = fmt::format("choose another, such as 'my_{}'", name);
  } else {
    d.expected = "a name that nothing else has in the shader";
    d.hint = "choose another here and in the shader";
  }
  return false;
}

bool ReadContext::checkFresh(Seen& seen, const std::string& name, const Place& place, std::string_view what) {
  const auto [before, fresh] = seen.try_emplace(name, place);
  if (!fresh)
    error(Code::duplicateName, place, fmt::format("{} '{}' is declared twice", what, name)).hint =
        fmt::format("rename one; the first stands at {}:{}", before->second.line, before->second.column);
  return fresh;
}

std::string ReadContext::text(const JsonValue& object, std::string_view key) {
  const JsonValue* value = object.find(key);
  return value && expect(*value, Type::string, quoted(key)) ? value->text : std::string();
}

bool ReadContext::flag(const JsonValue& object, std::string_view key) {
  const JsonValue* value = object.find(key);
  return value && expect(*value, Type::boolean, quoted(key)) && value->flag;
}

std::optional<double> ReadContext::number(const JsonValue& object, std::string_view key) {
  const JsonValue* value = object.find(key);
  return value && expect(*value, Type::number, quoted(key)) ? std::optional(value->number) : std::nullopt;
}

std::optional<std::string> ReadContext::word(const JsonValue& object, std::string_view key,
                                             std::span<const std::string_view> words) {
  const JsonValue* value = object.find(key);
  if (!value || !expect(*value, Type::string, quoted(key))) return std::nullopt;
  if (std::ranges::find(words, value->text) != words.end()) return value->text;
  auto& d = error(Code::unknownWord, *value, fmt::format("unknown word \"{}\" for \"{}\"", value->text, key));
  d.expected = fmt::format("{}", fmt::join(words, ", "));
  if (key == "type")  // of a parameter
    d.hint = text::hintForForeign(text::Foreign::value_type, value->text);
  const std::string nearest =
      text::nearestName(value->text, std::vector<std::string>(words.begin(), words.end()));
  if (!d.hint.empty() || nearest.empty()) return std::nullopt;
  d.hint = fmt::format("did you mean \"{}\"?", nearest);
  return nearest;  // read as what is meant, so that nothing else is reported because of it
}

Expr ReadContext::expr(const JsonValue& object, std::string_view key) {
  const JsonValue* value = object.find(key);
  return value ? exprOf(*value, quoted(key)) : Expr();
}

std::optional<RefDesc> ReadContext::ref(const JsonValue& object, std::string_view key) {
  const JsonValue* value = object.find(key);
  return value ? refOf(*value, quoted(key)) : std::nullopt;
}

const std::vector<JsonMember>& ReadContext::members(const JsonValue& object, std::string_view key) {
  static const std::vector<JsonMember> none;
  const JsonValue* value = object.find(key);
  return value && expect(*value, Type::object, quoted(key)) ? value->members : none;
}

Expr ReadContext::exprOf(const JsonValue& value, std::string_view what) {
  if (value.is(Type::number)) return Expr::constant(Value::number(value.number), value.place);
  if (value.is(Type::boolean)) return Expr::constant(Value::boolean(value.flag), value.place);
  if (value.is(Type::string)) {
    text::Diagnostics said;
    std::optional<Expr> parsed = Expr::parse(value.text, value.textPlace(), said);
    adopt(said);
    return parsed.value_or(Expr());
  }
  if (!value.is(Type::array) || value.items.empty() || value.items.size() > 4)
    return wrongType(value, what,
                     "a number, a boolean, a list of 1 to 4 numbers, or an expression in a string"),
           Expr();
  std::vector<Expr> items;
  for (const JsonValue& item : value.items) {
    if (item.is(Type::array) || item.is(Type::object) || item.is(Type::null))
      wrongType(item, fmt::format("an item of {}", what), "a number or an expression");
    else if (Expr one = exprOf(item, what); one.present())
      items.push_back(std::move(one));
  }
  return items.size() == value.items.size() ? Expr::listOf(std::move(items), value.place) : Expr();
}

std::optional<RefDesc> ReadContext::refOf(const JsonValue& value, std::string_view what) {
  const bool one = value.is(Type::array) && value.items.size() == 1 && value.items[0].is(Type::string);
  if (!expect(value, Type::string, what,
              one ? fmt::format("write \"{}\", without brackets", value.items[0].text) : ""))
    return std::nullopt;
  text::Diagnostics said;
  std::optional<RefDesc> parsed = parseRef(value.text, value.textPlace(), said);
  adopt(said);
  return parsed;
}

std::vector<const JsonValue*> ReadContext::strings(const JsonValue* value, std::string_view what) {
  std::vector<const JsonValue*> out;
  if (!value) return out;
  if (value->is(Type::string)) return {value};
  if (!value->is(Type::array)) wrongType(*value, what, "a string or an array of strings");
  for (const JsonValue& item : value->items)
    if (expect(item, Type::string, fmt::format("an item of {}", what))) out.push_back(&item);
  return out;
}

}  // namespace weft::graph
