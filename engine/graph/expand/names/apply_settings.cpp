#include "engine/graph/expand/names/apply_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/files/file.h"
#include "engine/base/nearest.h"
#include "engine/graph/expand/names/names.h"
#include "engine/graph/expand/names/parameter_check.h"
#include "engine/graph/expand/names/scope.h"
#include "engine/graph/expand/names/unread.h"
#include "engine/graph/language/suffix.h"
#include "engine/graph/language/value.h"

namespace weft::graph::expansion {

namespace {

using Type = ParameterDesc::Type;

std::string joined(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

// "a number from 0 to 8", "a whole number up to 6", "a number".
std::string rangeText(const ParameterDesc& desc) {
  std::string text = desc.type == Type::integer ? "a whole number" : "a number";
  if (desc.min) text += fmt::format(" from {}", *desc.min);
  if (desc.max) text += fmt::format("{} {}", desc.min ? " to" : " up to", *desc.max);
  return text;
}

std::string listText(const ParameterDesc& desc, int count) {
  const std::string range = desc.min || desc.max ? ", each " + rangeText(desc) : "";
  return fmt::format("a list of {} numbers{}, such as {}", count, range, toText(desc.initial));
}

std::string expectedOf(const ParameterDesc& desc) {
  switch (desc.type) {
    case Type::boolean:
      return "true or false";
    case Type::integer:
    case Type::number:
      return rangeText(desc);
    case Type::choice:
      return "one of " + joined(desc.choices);
    case Type::file:
      return "the path of a file";
    default:
      return listText(desc, componentsOf(desc.type));
  }
}

// The value that was probably meant, as it is written for --set; "" when nobody can say.
std::string meantBy(const ParameterDesc& desc, const Value& value) {
  const std::string text = value.type == Value::Type::symbol ? value.symbol : toText(value);
  if (desc.type == Type::boolean) {
    for (const char* word : {"1", "yes", "on", "True", "TRUE", "enable", "enabled"})
      if (text == word) return "true";
    for (const char* word : {"0", "no", "off", "False", "FALSE", "disable", "disabled", "none"})
      if (text == word) return "false";
    return base::nearestName(text, std::vector<std::string>{"true", "false"});
  }
  if (desc.type == Type::choice) return base::nearestName(text, desc.choices);
  if (const int count = componentsOf(desc.type); count > 0) {
    const Value list = parseValue("[" + text + "]");
    return list.type == Value::Type::list && list.count == count ? toText(list) : "";
  }
  if (desc.type == Type::integer && value.type == Value::Type::number)
    return fmt::format("{}", std::llround(value.v[0]));
  // A comma for a point, a unit behind it.
  std::string number = text;
  std::ranges::replace(number, ',', '.');
  if (const std::size_t end = number.find_first_not_of("+-.0123456789"); end != std::string::npos && end > 0)
    number.resize(end);
  const auto meant = parseNumber(number);
  return meant && (desc.type == Type::number || *meant == std::floor(*meant)) ? number : "";
}

// What a diagnostic about a setting begins with: of the command line a place, of a panel words in the
// message.
Where placeOf(Origin origin, const std::string& source) {
  return origin == Origin::command_line ? base::placeOfOption(source) : Where{};
}

std::string prefixOf(Origin origin, const std::string& source) {
  return origin == Origin::command_line ? std::string() : source + ": ";
}

bool reportUnlessOne(Model& model, const std::vector<std::string>& names,
                     const std::vector<std::size_t>& found, std::string_view wanted, std::string_view noun,
                     const Where& place, const std::string& before) {
  if (found.size() == 1) return false;
  std::string all;
  for (const std::size_t i : found) all += (all.empty() ? "" : ", ") + names[i];
  auto& d = model.diagnostics.error(Code::ambiguousName, place,
                                    fmt::format("{}'{}' may mean several {}", before, wanted, noun));
  d.found = all;
  d.hint = fmt::format("write more of the name, such as '{}'", names[found[0]]);
  return true;
}

// Where a value stands, and which parameters it may mean: those of `prefix`, by the rest of their names. `before` stands
// before a message about it.
struct SetPlace {
  const Scope& scope;
  std::string_view prefix = "";
  Where place = {};
  Where valuePlace = {};  // `place` when it has no file
  Origin kind = Origin::file;
  std::string before = {};
};

// For a name that no parameter has: the pass that gives it a value, and no default. "" when none does.
std::string hintAtFixedValue(const Model& model, const std::string& wanted) {
  const std::size_t dot = wanted.rfind('.');
  const std::string leaf = wanted.substr(dot + 1),
                    owner = dot == std::string::npos ? "" : wanted.substr(0, dot);
  for (const Scope& scope : model.scopes)
    for (const PassDesc& pass : scope.desc->passes) {
      const auto value = std::ranges::find(pass.parameters, leaf, &PassParameterDesc::name);
      if (value == pass.parameters.end() || value->declared) continue;
      if (const std::string name = scope.prefix + pass.name; owner.empty() || hasSuffix(name, owner))
        return fmt::format(
            "pass '{}' sets its '{}' and declares no parameter: write {{ \"default\": … }} there", name,
            leaf);
    }
  return {};
}

// A value of a file whose name is like none that there is.
struct Stranger {
  const SetDesc* set;
  std::string hint;
};

// Those of one file together: it may be a preset of another graph.
void reportStrangers(Model& model, const std::vector<Stranger>& strangers) {
  constexpr std::size_t kMost = 20;
  std::vector<bool> told(strangers.size());
  for (std::size_t first = 0; first < strangers.size(); ++first) {
    if (told[first]) continue;
    const SetDesc& set = *strangers[first].set;
    std::string names;
    std::size_t count = 0;
    for (std::size_t i = first; i < strangers.size(); ++i) {
      if (*strangers[i].set->place.file != *set.place.file) continue;
      told[i] = true;
      if (count++ < kMost) names += fmt::format("{}'{}'", count == 1 ? "" : ", ", strangers[i].set->name);
    }
    if (count > kMost) names += fmt::format(" and {} more", count - kMost);
    auto& d =
        model.diagnostics.error(Code::unknownParameter, set.place,
                                fmt::format("no parameter{} called {}", count == 1 ? " is" : "s are", names));
    const std::string all = model.parameters.empty() ? "the graph has none"
                                                     : fmt::format("'weft params {}' lists what there is",
                                                                   model.scopes.front().desc->path);
    if (count == 1)
      d.hint = !strangers[first].hint.empty() ? strangers[first].hint : model.parameters.empty() ? "" : all;
    else
      d.hint = set.origin == Origin::preset ? "the preset is for a graph that has them; " + all : all;
  }
}

// `valueFor(type)` makes the value. A value of a file whose name is like none is added to `strangers`, when they are
// given, and not reported.
template <class ValueFor>
void applySet(Model& model, const std::string& wanted, const SetPlace& origin, const ValueFor& valueFor,
              std::vector<Stranger>* strangers = nullptr, const SetDesc* set = nullptr) {
  std::vector<std::string> names;
  std::vector<std::size_t> parameters;
  const auto add = [&](std::size_t i) {
    if (!model.parameters[i].path.starts_with(origin.prefix)) return;
    names.push_back(model.parameters[i].path.substr(origin.prefix.size()));
    parameters.push_back(i);
  };
  // Only those of its last part can be meant.
  if (const auto leaves = model.parametersByLeaf.find(std::string_view(wanted).substr(wanted.rfind('.') + 1));
      leaves != model.parametersByLeaf.end()) {
    for (std::uint32_t i = leaves->second.first; i != kNone; i = model.parameters[i].nextOfLeaf) add(i);
  }
  const std::vector<std::size_t> found = suffixMatches(names, wanted);
  if (found.empty()) {
    if (mayBeUnread(origin.scope, wanted)) return;
    names.clear();
    for (std::size_t i = 0; i < model.parameters.size(); ++i) add(i);
    std::string hint = hintAtFixedValue(model, wanted);
    if (hint.empty()) hint = suffixHint(wanted, names);
    const bool near = !hint.empty() && !hint.starts_with("known");
    if (strangers && !near) {
      strangers->push_back({set, std::move(hint)});
      return;
    }
    auto& d = model.diagnostics.error(Code::unknownParameter, origin.place,
                                      fmt::format("{}no parameter is called '{}'", origin.before, wanted));
    d.hint = std::move(hint);
    if (d.hint.empty() && !model.parameters.empty())
      d.hint = fmt::format("'weft params {}' lists what there is", model.scopes.front().desc->path);
    return;
  }
  if (reportUnlessOne(model, names, found, wanted, "parameters", origin.place, origin.before)) return;
  Parameter& parameter = model.parameters[parameters[found[0]]];
  Value value = valueFor(parameter.desc->type);
  if (!checkParameterValue(model, parameter, value, origin.place, origin.before)) return;
  parameter.value = std::move(value);
  parameter.valuePlace = origin.valuePlace.file ? origin.valuePlace : origin.place;
  parameter.origin = origin.kind;
}

}  // namespace

void applySetting(Model& model, const Setting& set) {
  const std::string source = sourceOf(set);
  const SetPlace place{model.scopes.front(),        "", placeOf(set.origin, source), {}, set.origin,
                       prefixOf(set.origin, source)};
  applySet(model, set.name, place, [&](Type type) {
    // A path is what was written, whatever else that may mean.
    const bool path = type == Type::file && set.origin == Origin::command_line;
    return path ? Value::text(set.text) : set.value;
  });
}

namespace {

// What files say first, the innermost first, so that an including file has the last word; then the command
// line.
void applySets(Model& model) {
  std::vector<Stranger> strangers;
  for (auto scope = model.scopes.rbegin(); scope != model.scopes.rend(); ++scope)
    for (const SetDesc& set : scope->desc->sets) {
      if (isOver(model)) continue;
      const SetPlace place{*scope, scope->prefix, set.place, set.valuePlace, set.origin};
      const auto valueFor = [&](Type type) {
        const bool path = type == Type::file && set.value.type == Value::Type::symbol;
        return path ? Value::text(base::besideFile(set.place, set.value.symbol)) : set.value;
      };
      applySet(model, set.name, place, valueFor, &strangers, &set);
    }
  reportStrangers(model, strangers);
  for (const Setting& set : model.settings.sets) applySetting(model, set);
}

}  // namespace

void applyDisable(Model& model, const Disable& disable) {
  const std::string& wanted = disable.name;
  const std::string source = sourceOf(disable);
  const Where place = placeOf(disable.origin, source);
  const std::string before = prefixOf(disable.origin, source);
  const std::string declared = wanted.substr(0, wanted.find('['));
  struct Candidate {
    Scope* scope;      // an include
    std::string pass;  // or a pass
    const PassDesc* stanza;
  };
  std::vector<std::string> names;
  std::vector<Candidate> candidates;
  for (Scope& scope : model.scopes) {
    if (scope.parent && declared == wanted) {
      names.push_back(scope.prefix.substr(0, scope.prefix.size() - 1));
      candidates.push_back({&scope, {}, scope.stanza});
    }
    for (const PassDesc& pass : scope.desc->passes)
      if (!pass.include) {
        names.push_back(scope.prefix + pass.name);
        candidates.push_back({nullptr, names.back(), &pass});
      }
  }
  const std::vector<std::size_t> found = suffixMatches(names, declared);
  if (!found.empty()) {
    // When a file is included twice, both stanzas are meant.
    const auto isSame = [&](std::size_t i) {
      return base::isSamePlace(candidates[i].stanza->place, candidates[found[0]].stanza->place);
    };
    if (!std::ranges::all_of(found, isSame) &&
        reportUnlessOne(model, names, found, wanted, "passes", place, before))
      return;
    for (const std::size_t i : found) {
      const Candidate& match = candidates[i];
      if (match.scope) {
        match.scope->disabledBy = source;
        continue;
      }
      const std::string instance = declared == wanted ? "" : match.pass + wanted.substr(declared.size());
      model.disables[match.pass].push_back({source, match.pass, instance});
    }
    return;
  }
  std::vector<std::string> parameters;
  for (const Parameter& parameter : model.parameters) parameters.push_back(parameter.path);
  if (const auto named = suffixMatches(parameters, wanted); !named.empty()) {
    auto& d = model.diagnostics.error(
        Code::parameterNotPass, place,
        fmt::format("{}'{}' is a parameter, not a pass", before, parameters[named[0]]));
    const Parameter& parameter = model.parameters[named[0]];
    d.hint = parameter.desc->type == Type::boolean ? fmt::format("--set {}=false", wanted)
                                                   : fmt::format("set it with --set {}=VALUE", wanted);
    return;
  }
  if (mayBeUnread(model.scopes.front(), declared)) return;
  auto& d = model.diagnostics.error(Code::unknownPass, place,
                                    fmt::format("{}no pass is called '{}'", before, wanted));
  d.hint = suffixHint(declared, names);
}

bool checkParameterValue(Model& model, const Parameter& parameter, const Value& value, const Where& place,
                         const std::string& before) {
  const ParameterDesc& desc = *parameter.desc;
  const auto refuse = [&](Code code, const char* why) {
    const bool empty = value.type == Value::Type::symbol && value.symbol.empty();
    auto& d = model.diagnostics.error(
        code, place,
        empty ? fmt::format("{}parameter '{}': the value is empty", before, parameter.path)
              : fmt::format("{}parameter '{}': {} is {}", before, parameter.path, toText(value), why));
    d.expected = expectedOf(desc);
    if (desc.place.file)
      d.expected += fmt::format(", as {}:{}:{} says", *desc.place.file, desc.place.line, desc.place.column);
    return &d;
  };
  if (!fitsType(desc, value)) {
    const bool wantsNumber = desc.type == Type::number || desc.type == Type::integer;
    const char* const why =
        value.type == Value::Type::symbol && wantsNumber ? whyNoNumber(value.symbol) : nullptr;
    auto* d = refuse(Code::badParameterValue, why                         ? why
                                              : desc.type == Type::choice ? "none of its choices"
                                                                          : "of the wrong type");
    if (const std::string meant = why ? "" : meantBy(desc, value); !meant.empty())
      d->hint = fmt::format("did you mean '{}'?", meant);
    return false;
  }
  if (!fitsRange(desc, value)) {
    refuse(Code::numberOutOfRange, "out of its range");
    return false;
  }
  return true;
}

base::Diagnostic placedAtArgument(Model& model, Scope& scope, const std::vector<NamedExpr>& arguments,
                                  base::Diagnostic problem) {
  if (!problem.place.file || problem.place.line != 0) return problem;
  const std::string file = *problem.place.file;
  Where ofSequence;  // of which `file` may be a picture
  for (const NamedExpr& argument : arguments) {
    Names names(model, scope);
    base::Diagnostics said;  // by whoever evaluated it for the import
    const Value value = argument.expr.evaluate(names, said);
    if (value.type != Value::Type::symbol) continue;
    if (value.symbol == file) problem.place = argument.expr.place();
    for (const std::string& name : argument.expr.variables()) {
      const Variable variable = findVariable(model, scope, name);
      if (variable.kind != Variable::Kind::parameter) continue;
      const Parameter& parameter = model.parameters[variable.index];
      if (parameter.value != value || !isKnown(parameter.valuePlace)) continue;
      if (value.symbol == file) problem.place = parameter.valuePlace;
      if (parameter.desc->type == Type::file) ofSequence = parameter.valuePlace;
    }
  }
  if (problem.place.file && problem.place.line == 0 && isKnown(ofSequence)) problem.place = ofSequence;
  return problem;
}

void applySettings(Model& model) {
  const auto badScreen = [](std::uint32_t x) { return x < 1 || x > 16384; };
  if (badScreen(model.settings.screenWidth) || badScreen(model.settings.screenHeight)) {
    auto& d = model.diagnostics.error(Code::numberOutOfRange, base::placeOfOption("--size"),
                                      "the screen's size is out of its range");
    d.expected = "1 to 16384 pixels a side";
    d.found = fmt::format("{}x{}", model.settings.screenWidth, model.settings.screenHeight);
  }
  applySets(model);
  for (const Disable& disable : model.settings.disables) applyDisable(model, disable);
}

}  // namespace weft::graph::expansion
