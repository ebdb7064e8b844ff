// What the parts of the reader share: checked access to JSON values, with diagnostics that know the pass and
// the resource being read. Every accessor takes null for an absent key and then yields the absent value
// silently. Private to engine/graph/read.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>

#include "engine/base/json/dom.h"
#include "engine/base/limits.h"
#include "engine/base/words/foreign_words.h"
#include "engine/graph/desc.h"
#include "engine/graph/language/enough.h"
#include "engine/graph/language/keys.h"

namespace weft::graph {

using base::JsonMember;
using base::JsonValue;

// Keys by which a file that was given as a graph is known as a scene.
constexpr std::array<std::string_view, 3> kSceneKeys = {"cameras", "models", "lamp_grids"};

class ReadContext {
 public:
  explicit ReadContext(base::Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  std::string pass, resource;  // set while one is read

  base::Diagnostic& error(base::Code code, const JsonValue& value, std::string message);
  base::Diagnostic& errorAt(base::Code code, const Place& place, std::string message);

  // False, with Code::wrongType, when `value` is something else. `what` names it: "\"passes\"".
  bool expect(const JsonValue& value, JsonValue::Type type, std::string_view what, std::string hint = {});

  // Code::unknownKey for keys that are not in `keys`, Code::missingKey for required ones that are missing. A missing key that
  // an unknown one is a misspelling of is not reported again.
  // `foreign`: where the keys of other engines are looked up for the hint.
  void checkKeys(const JsonValue& object, std::span<const KeySpec> keys, std::string_view what,
                 std::optional<base::Foreign> foreign = std::nullopt);

  // Code::notAName unless `name` is an identifier without reserved words.
  bool checkName(std::string_view name, const Place& place, std::string_view what);
  // The same, and not a word of GLSL: slots, parameters and defines are spelled alike in shaders.
  bool checkShaderName(std::string_view name, const Place& place, std::string_view what);
  // Code::duplicateName when `name` was already registered in `seen`.
  using Seen = std::unordered_map<std::string, Place>;
  bool checkFresh(Seen& seen, const std::string& name, const Place& place, std::string_view what);

  std::string text(const JsonValue* value, std::string_view what);
  bool flag(const JsonValue* value, std::string_view what);
  std::optional<double> number(const JsonValue* value, std::string_view what);
  // One of `words`, or Code::unknownWord with the nearest.
  std::optional<std::string> word(const JsonValue* value, std::span<const std::string_view> words,
                                  std::string_view what);
  // A number, a boolean, a list of 1 to 4, or an expression.
  Expr expr(const JsonValue* value, std::string_view what);
  std::optional<RefDesc> ref(const JsonValue* value, std::string_view what);
  // The strings of a list, or a single one.
  std::vector<const JsonValue*> strings(const JsonValue* value, std::string_view what);

  // For the parsers of strings, which know neither pointer nor pass: adopt() what they said into a fresh
  // Diagnostics.
  void adopt(const base::Diagnostics& said);

  // False once there are enough errors (enough.h): further ones are not kept.
  bool goesOn() const { return !enoughErrors(diagnostics_); }

 private:
  base::Diagnostics& diagnostics_;
  base::Diagnostic unkept_;
};

// The parts, by what stands in the file; each takes a value of any type and reports what does not fit.
std::optional<ParameterDesc> readParameter(ReadContext& context, const JsonMember& member);
// A value of "set": a number, a boolean, a word or path, a list of two to four numbers.
std::optional<Value> readValue(ReadContext& context, const JsonMember& member);
std::optional<ResourceDesc> readResource(ReadContext& context, const JsonMember& member);
// Include stanzas come back with include->graph still null.
std::optional<PassDesc> readPass(ReadContext& context, const JsonValue& value);

}  // namespace weft::graph
