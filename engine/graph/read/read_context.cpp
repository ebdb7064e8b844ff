#include "engine/graph/read/read_context.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/graph/language/names.h"
#include "engine/graph/read/ref_parse.h"
#include "engine/text/words/words.h"

namespace weft::graph {

using text::Code;
using Type = JsonValue::Type;

namespace {

// Why a shader cannot have the name; "" when it can.
const char* whyNoShaderName(std::string_view name, const Named& named) {
  if (!named.inShader) return "";
  if (text::isGlslWord(name)) return ": it is a word of GLSL";
  if (!named.underscores && name.find("__") != std::string_view::npos) return ": GLSL keeps names with __";
  if (!named.isDefine) return "";
  if (text::isGlslFunction(name)) return ": it would hide a function of GLSL";
  if (name.starts_with("GL_")) return ": GLSL keeps names with GL_";
  return name.starts_with("HAS_") ? ": HAS_… says which slots and parameters a pass has" : "";
}

}  // namespace

std::string foundText(const JsonValue& value) {
  return value.is(Type::array) ? fmt::format("an array of {}", value.items.size()) : describe(value);
}

text::Diagnostic& ReadContext::error(text::Diagnostic said, const Place& place) {
  said.pass = pass;
  said.resource = resource;
  return goesOn() ? diagnostics_.add(text::Severity::error, std::move(said), place) : unkept_ = said;
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
  return error(say::wrongType, value, what, expected, foundText(value));
}

bool ReadContext::expect(const JsonValue& value, Type type, std::string_view what, std::string hint) {
  if (value.is(type)) return true;
  wrongType(value, what, nameOf(type)).hint = std::move(hint);
  return false;
}

bool ReadContext::checkName(std::string_view name, const Place& place, const Named& named) {
  if (name.size() > text::kMaxNameBytes) {
    error(say::nameTooLong, place, name, named.noun, text::kMaxNameBytes, name.size());
    return false;
  }
  const std::string_view why = whyNoShaderName(name, named);
  if (isIdent(name) && !isReservedWord(name) && why.empty()) return true;
  error(say::cannotName, place, name, named.noun, why, text::kMaxNameBytes, fmt::join(kReservedWords, ", "),
        !why.empty() ? "choose another here and in the shader"
        : named.ofFile && name.find('.') != std::string_view::npos
            ? "only an overlay, a file that \"extends\" this one, changes what an include has"
            : "");
  return false;
}

bool ReadContext::checkFresh(Seen& seen, const std::string& name, const Place& place, std::string_view what) {
  const auto [before, fresh] = seen.try_emplace(name, place);
  if (!fresh) error(say::declaredTwice, place, what, name, before->second.line, before->second.column);
  return fresh;
}

Expr ReadContext::expr(const JsonValue& object, std::string_view key) {
  const JsonValue* value = valueIn(object, key);
  return value ? exprOf(*value) : Expr();
}

std::optional<RefDesc> ReadContext::ref(const JsonValue& object, std::string_view key) {
  const JsonValue* value = valueIn(object, key);
  return value ? refOf(*value) : std::nullopt;
}

Expr ReadContext::exprOf(const JsonValue& value) {
  if (value.is(Type::number)) return Expr::constant(Value::number(value.number), value.place);
  if (value.is(Type::boolean)) return Expr::constant(Value::boolean(value.flag), value.place);
  if (value.is(Type::string)) return parsed(value, Expr::parse).value_or(Expr());
  std::vector<Expr> items;
  for (const JsonValue& item : value.items)
    if (Expr one = exprOf(item); one.present()) items.push_back(std::move(one));
  return items.empty() || items.size() < value.items.size() ? Expr()
                                                            : Expr::listOf(std::move(items), value.place);
}

std::optional<RefDesc> ReadContext::refOf(const JsonValue& value, bool alternative) {
  if (!value.is(Type::string)) return std::nullopt;
  std::optional<RefDesc> ref = parsed(value, parseRef);
  if (!ref || alternative || !ref->condition.present()) return ref;
  error(say::ifOutsideList, ref->condition.place(), value.text, ref->name, ref->condition.text());
  ref->condition = Expr();
  return ref;
}

const JsonValue* valueIn(const JsonValue& object, std::string_view key) {
  const JsonValue* value = object.find(key);
  return value && !value->is(Type::absent) ? value : nullptr;
}

std::string textIn(const JsonValue& object, std::string_view key) {
  const JsonValue* value = valueIn(object, key);
  return value ? value->text : std::string();
}

const std::vector<JsonMember>& membersIn(const JsonValue& object, std::string_view key) {
  static const std::vector<JsonMember> none;
  const JsonValue* value = valueIn(object, key);
  return value ? value->members : none;
}

std::span<const JsonValue> stringsOf(const JsonValue& value) {
  return value.is(Type::string) ? std::span(&value, 1) : std::span(value.items);
}

}  // namespace weft::graph
