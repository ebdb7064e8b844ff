// What the readers of parameters, resources and passes share: diagnostics that know the pass and the resource at hand, and values
// of a tree that fits the schema (checkShape()). What is absent was reported there, or may be: it yields the absent value silently.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>

#include "engine/graph/desc.h"
#include "engine/graph/language/keys.h"
#include "engine/text/diagnostic.h"
#include "engine/text/json/dom.h"
#include "engine/text/json/report.h"
#include "engine/text/limits.h"
#include "engine/text/words/words.h"

namespace weft::graph {

using text::JsonMember;
using text::JsonValue;

// What a name names: "a slot".
struct Named {
  const char* noun;
  bool inShader = false;     // slots, parameters and defines of passes are spelled alike in shaders
  bool isDefine = false;     // it hides functions, too
  bool underscores = false;  // "__" may be in it, as importers keep the names of parameters
  bool ofFile = false;       // an overlay may change one of an included file
};

class ReadContext {
 public:
  explicit ReadContext(text::Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  std::string pass, resource;  // set while one is read

  text::Diagnostic& error(text::Diagnostic said, const Place& place);
  template <class... Args>
  text::Diagnostic& error(text::Saying<Args...> what, const Place& place, Args&&... args) {
    return error(text::diagnosticOf(what.sentence, fmt::make_format_args(args...)), place);
  }
  template <class... Args>
  text::Diagnostic& error(text::Saying<Args...> what, const JsonValue& value, Args&&... args) {
    return error(text::diagnosticOf(what.sentence, fmt::make_format_args(args...)), value.place);
  }
  // Code::wrongType. `what` has the wrong type.
  text::Diagnostic& wrongType(const JsonValue& value, std::string_view what, std::string expected);
  // False, with Code::wrongType, when `value` is something else. `what` names it: "\"passes\"".
  bool expect(const JsonValue& value, JsonValue::Type type, std::string_view what, std::string hint = {});

  // Code::notAName unless `name` is an identifier without reserved words, and, of what shaders name too, no word of GLSL.
  bool checkName(std::string_view name, const Place& place, const Named& named);
  // Code::duplicateName when `name` was already registered in `seen`.
  using Seen = std::unordered_map<std::string, Place>;
  bool checkFresh(Seen& seen, const std::string& name, const Place& place, std::string_view what);

  // The value of a key, or of a value: a number, a boolean, a list of 1 to 4, or an expression. Absent for what is absent.
  Expr expr(const JsonValue& object, std::string_view key);
  Expr exprOf(const JsonValue& value);
  std::optional<RefDesc> ref(const JsonValue& object, std::string_view key);
  // Code::badReference for an `if` where none may stand.
  std::optional<RefDesc> refOf(const JsonValue& value, bool alternative = false);

  // What `parse` makes of a string. Parsers know no pass: what they say gets it here.
  template <class Parse>
  auto parsed(const JsonValue& value, Parse&& parse) {
    text::Diagnostics said;
    auto made = parse(value.text, value.textPlace(), said);
    adopt(said);
    return made;
  }

  // False once there are enough errors: further ones are not kept.
  bool goesOn() const { return !enoughErrors(diagnostics_); }

 private:
  void adopt(const text::Diagnostics& said);

  text::Diagnostics& diagnostics_;
  text::Diagnostic unkept_;
};

// "an array of 3", "the number 7".
std::string foundText(const JsonValue& value);

// The value of a key; null when it is not there or does not fit.
const JsonValue* valueIn(const JsonValue& object, std::string_view key);
// Its text, its members or its strings (one, or those of a list); empty when it is not there.
std::string textIn(const JsonValue& object, std::string_view key);
const std::vector<JsonMember>& membersIn(const JsonValue& object, std::string_view key);
std::span<const JsonValue> stringsOf(const JsonValue& value);

// The parts of a file that fits the schema. What cannot be used is reported, and nothing comes back.
std::optional<ParameterDesc> readParameter(ReadContext& context, const JsonMember& member);
// A number, a boolean, a word or path, a list of two to four numbers; nothing, without a report, for anything else.
std::optional<Value> valueOf(const JsonValue& value);
std::optional<ResourceDesc> readResource(ReadContext& context, const JsonMember& member);
// Puts what a set holds in front of what a pass stanza has. Calls both(member) for each member of the stanza whose key the set has,
// too, and which is not a group, such as slots: it stays as it is.
void addSet(JsonValue& stanza, const JsonValue& set, const std::function<void(const JsonMember&)>& both);
// Whether a key of passes holds members that sets and passes share: slots, parameters, defines, state.
bool isGroup(std::string_view key);
// With what it uses of `sets`, those of its file. Include stanzas come back with include->graph still null.
std::optional<PassDesc> readPass(ReadContext& context, const JsonValue& value, const JsonValue& sets);

// Trees of JSON against the schema of graphs (keys.h). What is one slip away from a key or a word is reported and then read as
// that, so that nothing else is said of what is missing because of it.

// Of one file, before it is laid over others: reports keys that are one slip away from another, or another program's word for
// it, and renames them. `preset`: the file is laid over a graph although it extends none.
void mendKeys(text::JsonValue& root, bool preset, text::Diagnostics& diagnostics);
// Of a whole graph: Code::wrongType, unknownKey, missingKey, unknownWord and keysExclude. What does not fit becomes
// `absent`, at its place: the readers take the rest as it is.
void checkShape(text::JsonValue& root, text::Diagnostics& diagnostics);

}  // namespace weft::graph
