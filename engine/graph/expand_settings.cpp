#include "engine/graph/expand_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/base/nearest.h"
#include "engine/graph/expand_scope.h"
#include "engine/graph/read_context.h"
#include "engine/graph/suffix.h"

namespace weft::graph {

std::string sourceOfSet(const std::string& name, const std::string& value) {
  return fmt::format("--set {}={}", name, value);
}

std::string sourceOfDisable(const std::string& name) {
  return "--disable " + name;
}

}  // namespace weft::graph

namespace weft::graph::expansion {

namespace {

using Type = ParameterDesc::Type;

std::string_view trim(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

std::optional<double> parseNumber(std::string_view text) {
  text = trim(text);
  double x = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(x)) return std::nullopt;
  return x;
}

// A JSON scalar or list of numbers, else a word.
Value parseValue(std::string_view text, Type type) {
  if (type == Type::file) return Value::text(std::string(text));
  text = trim(text);
  if (text == "true" || text == "false") return Value::boolean(text == "true");
  if (const auto number = parseNumber(text)) return Value::number(*number);
  if (text.size() >= 2 && text.front() == '[' && text.back() == ']') {
    Value list;
    list.type = Value::Type::list;
    std::string_view rest = text.substr(1, text.size() - 2);
    while (list.count < 4) {
      const std::size_t comma = rest.find(',');
      const auto number = parseNumber(rest.substr(0, comma));
      if (!number) break;
      list.v[list.count++] = *number;
      if (comma == std::string_view::npos) return list;
      rest = rest.substr(comma + 1);
    }
  }
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  return Value::text(std::string(text));
}

std::string joined(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

std::string rangeText(const ParameterDesc& desc) {
  if (desc.min && desc.max) return fmt::format("a number from {} to {}", *desc.min, *desc.max);
  return desc.min ? fmt::format("a number from {}", *desc.min) : fmt::format("a number up to {}", *desc.max);
}

bool reportUnlessOne(Model& model, const std::vector<std::string>& names,
                     const std::vector<std::size_t>& found, const std::string& source,
                     std::string_view wanted, std::string_view noun, const Place& place = {}) {
  if (found.size() == 1) return false;
  std::string all;
  for (const std::size_t i : found) all += (all.empty() ? "" : ", ") + names[i];
  auto& d = model.diagnostics.error(Code::W46, place,
                                    fmt::format("{}: '{}' may mean several {}", source, wanted, noun));
  d.found = all;
  d.hint = fmt::format("write more of the name, such as '{}'", names[found[0]]);
  return true;
}

// Where a value comes from, and which parameters it may mean: those of `prefix`, by the rest of their names.
struct Origin {
  std::string source;  // as the person wrote it
  const Scope& scope;
  std::string_view prefix = "";
  Place place = {};
  std::string pointer = {};
};

// `valueFor(type)` makes the value.
template <class ValueFor>
void applySet(Model& model, const std::string& wanted, const Origin& origin, const ValueFor& valueFor) {
  std::vector<std::string> names;
  std::vector<std::size_t> parameters;
  for (std::size_t i = 0; i < model.parameters.size(); ++i)
    if (model.parameters[i].path.starts_with(origin.prefix)) {
      names.push_back(model.parameters[i].path.substr(origin.prefix.size()));
      parameters.push_back(i);
    }
  const std::vector<std::size_t> found = suffixMatches(names, wanted);
  if (found.empty()) {
    if (mayBeUnread(origin.scope, wanted)) return;
    auto& d = model.diagnostics.error(Code::W44, origin.place,
                                      fmt::format("{}: no parameter is called '{}'", origin.source, wanted));
    d.pointer = origin.pointer;
    d.hint = suffixHint(wanted, names);
    return;
  }
  if (reportUnlessOne(model, names, found, origin.source, wanted, "parameters", origin.place)) return;
  Parameter& parameter = model.parameters[parameters[found[0]]];
  Value value = valueFor(parameter.desc->type);
  if (checkParameterValue(model, parameter, value, origin.place, origin.source))
    parameter.value = std::move(value);
}

// What files say first, the innermost first, so that an including file has the last word; then the command
// line.
void applySets(Model& model) {
  for (auto scope = model.scopes.rbegin(); scope != model.scopes.rend(); ++scope)
    for (const SetDesc& set : scope->desc->sets)
      applySet(model, set.name,
               {fmt::format("\"set\" {} to {}", set.name, toText(set.value)), *scope, scope->prefix,
                set.place, set.pointer},
               [&](Type type) {
                 const bool path = type == Type::file && set.value.type == Value::Type::symbol;
                 return path ? Value::text(besideFile(set.place, set.value.symbol)) : set.value;
               });
  for (const auto& [name, text] : model.settings.sets)
    applySet(model, name, {sourceOfSet(name, text), model.scopes.front()},
             [&](Type type) { return parseValue(text, type); });
}

void applyDisable(Model& model, const std::string& wanted) {
  const std::string source = sourceOfDisable(wanted);
  const std::string declared = wanted.substr(0, wanted.find('['));
  struct Candidate {
    Scope* scope;      // an include
    std::string pass;  // or a pass
  };
  std::vector<std::string> names;
  std::vector<Candidate> candidates;
  for (Scope& scope : model.scopes) {
    if (scope.parent && declared == wanted) {
      names.push_back(scope.prefix.substr(0, scope.prefix.size() - 1));
      candidates.push_back({&scope, {}});
    }
    for (const PassDesc& pass : scope.desc->passes)
      if (!pass.include) {
        names.push_back(scope.prefix + pass.name);
        candidates.push_back({nullptr, names.back()});
      }
  }
  const std::vector<std::size_t> found = suffixMatches(names, declared);
  if (!found.empty()) {
    if (reportUnlessOne(model, names, found, source, wanted, "passes")) return;
    const Candidate& match = candidates[found[0]];
    if (match.scope) {
      match.scope->disabledBy = source;
      return;
    }
    const std::string instance = declared == wanted ? "" : match.pass + wanted.substr(declared.size());
    model.disables[match.pass].push_back({source, match.pass, instance});
    return;
  }
  std::vector<std::string> parameters;
  for (const Parameter& parameter : model.parameters) parameters.push_back(parameter.path);
  if (const auto named = suffixMatches(parameters, wanted); !named.empty()) {
    auto& d = model.diagnostics.error(
        Code::W84, {}, fmt::format("{}: '{}' is a parameter, not a pass", source, parameters[named[0]]));
    const Parameter& parameter = model.parameters[named[0]];
    d.hint = parameter.desc->type == Type::boolean ? fmt::format("--set {}=false", wanted)
                                                   : fmt::format("set it with --set {}=VALUE", wanted);
    return;
  }
  if (mayBeUnread(model.scopes.front(), declared)) return;
  auto& d = model.diagnostics.error(Code::W45, {}, fmt::format("{}: no pass is called '{}'", source, wanted));
  d.hint = suffixHint(declared, names);
}

}  // namespace

bool checkParameterValue(Model& model, const Parameter& parameter, const Value& value, const Place& place,
                         const std::string& source) {
  const ParameterDesc& desc = *parameter.desc;
  const auto wrongType = [&](std::string expected) {
    auto& d = model.diagnostics.error(
        Code::W47, place, fmt::format("parameter '{}': {} is of the wrong type", parameter.path, source));
    d.expected = std::move(expected);
    d.found = toText(value);
    if (!desc.choices.empty() && value.type == Value::Type::symbol)
      d.hint = base::nearestHint(value.symbol, desc.choices);
    return false;
  };
  const auto listOf = [&](int n) { return value.type == Value::Type::list && value.count == n; };
  switch (desc.type) {
    case Type::boolean:
      if (value.type != Value::Type::boolean) return wrongType("true or false");
      break;
    case Type::integer:
      if (value.type != Value::Type::number || value.v[0] != std::floor(value.v[0]))
        return wrongType("a whole number");
      break;
    case Type::number:
      if (value.type != Value::Type::number) return wrongType("a number");
      break;
    case Type::vec2:
      if (!listOf(2)) return wrongType("a list of 2 numbers");
      break;
    case Type::vec3:
      if (!listOf(3)) return wrongType("a list of 3 numbers");
      break;
    case Type::vec4:
      if (!listOf(4)) return wrongType("a list of 4 numbers");
      break;
    case Type::choice:
      if (value.type != Value::Type::symbol ||
          std::find(desc.choices.begin(), desc.choices.end(), value.symbol) == desc.choices.end())
        return wrongType("one of " + joined(desc.choices));
      break;
    case Type::file:
      if (value.type != Value::Type::symbol) return wrongType("the path of a file");
      break;
  }
  for (std::size_t i = 0; i < value.count; ++i)
    if (value.type != Value::Type::boolean &&
        (!std::isfinite(value.v[i]) || (desc.min && value.v[i] < *desc.min) ||
         (desc.max && value.v[i] > *desc.max))) {
      auto& d = model.diagnostics.error(
          Code::W48, place, fmt::format("parameter '{}': {} is out of its range", parameter.path, source));
      d.expected = rangeText(desc);
      d.found = toText(value);
      return false;
    }
  return true;
}

void applySettings(Model& model) {
  const auto badScreen = [](std::uint32_t x) { return x < 1 || x > 16384; };
  if (badScreen(model.settings.screenWidth) || badScreen(model.settings.screenHeight)) {
    auto& d = model.diagnostics.error(Code::W48, {}, "the screen's size is out of its range");
    d.expected = "1 to 16384 pixels a side";
    d.found = fmt::format("{}x{}", model.settings.screenWidth, model.settings.screenHeight);
  }
  applySets(model);
  for (const std::string& name : model.settings.disables) applyDisable(model, name);
}

}  // namespace weft::graph::expansion
