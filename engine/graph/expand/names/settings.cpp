// --set, "set" of files and --disable: finds the parameter or pass a name means (the full dotted name, else the only one that
// ends in it) and checks values. The defaults of parameters were checked by the reader.
#include "engine/graph/expand/names/settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/graph/expand/names/names.h"
#include "engine/graph/language/names.h"
#include "engine/text/files/file.h"
#include "engine/text/nearest.h"
#include "graph_sentences.h"

namespace weft::graph {

Setting::Setting(std::string setName, std::string setText)
    : name(std::move(setName)), value(parseValue(setText)), text(std::move(setText)) {}

Setting::Setting(std::string setName, Value setValue, Origin setOrigin)
    : name(std::move(setName)), value(std::move(setValue)), origin(setOrigin) {}

std::string sourceOf(const Setting& setting) {
  if (setting.origin == Origin::command_line)
    return fmt::format("{} {}={}", setting.option, setting.name, setting.text);
  return fmt::format("the value {} set here for {}", toText(setting.value), setting.name);
}

std::string sourceOf(const Disable& disable) {
  return disable.origin == Origin::command_line ? disable.option + " " + disable.name
                                                : fmt::format("switching off {} here", disable.name);
}

int componentsOf(ParameterDesc::Type type) {
  using Type = ParameterDesc::Type;
  return type == Type::vec2 ? 2 : type == Type::vec3 ? 3 : type == Type::vec4 ? 4 : 0;
}

bool fitsType(const ParameterDesc& desc, const Value& value) {
  const bool number = value.type == Value::Type::number, word = value.type == Value::Type::symbol;
  switch (desc.type) {
    case ParameterDesc::Type::boolean:
      return value.type == Value::Type::boolean;
    case ParameterDesc::Type::integer:
      return number && value.v[0] == std::floor(value.v[0]);
    case ParameterDesc::Type::number:
      return number;
    case ParameterDesc::Type::choice:
      return word && std::ranges::find(desc.choices, value.symbol) != desc.choices.end();
    case ParameterDesc::Type::file:
      return word;
    default:
      return value.type == Value::Type::list && value.count == componentsOf(desc.type);
  }
}

bool fitsRange(const ParameterDesc& desc, const Value& value) {
  if (value.type == Value::Type::boolean) return true;
  return std::all_of(value.v.begin(), value.v.begin() + value.count, [&](double x) {
    return std::isfinite(x) && (!desc.min || x >= *desc.min) && (!desc.max || x <= *desc.max);
  });
}

namespace expansion {

namespace {

using Type = ParameterDesc::Type;

// "a number from 0 to 8", "a whole number up to 6", "a number", of a list each.
std::string expectedOf(const ParameterDesc& desc) {
  if (desc.type == Type::boolean) return "true or false";
  if (desc.type == Type::choice) return fmt::format("one of {}", fmt::join(desc.choices, ", "));
  if (desc.type == Type::file) return "the path of a file";
  std::string range = desc.type == Type::integer ? "a whole number" : "a number";
  if (desc.min) range += fmt::format(" from {}", *desc.min);
  if (desc.max) range += fmt::format("{} {}", desc.min ? " to" : " up to", *desc.max);
  const int count = componentsOf(desc.type);
  return count == 0 ? range
                    : fmt::format("a list of {}, each {}, such as {}", count, range, toText(desc.initial));
}

template <class Said>  // Setting or Disable; a panel has no place
Where placeOf(const Said& said) {
  return said.origin == Origin::command_line ? text::placeOfOption(sourceOf(said)) : Where();
}

void reportAmbiguous(Model& model, const std::vector<std::string>& meant, std::string_view wanted,
                     std::string_view noun, const Where& by) {
  report(model, say::ambiguousName, by, wanted, noun, fmt::join(meant, ", "), meant[0]);
}

// Gives the parameter of `scope`, or of a file that it includes, whose name ends in `wanted` a value; to one that is a file
// `path`, if there is one. Null after a report.
Parameter* applySet(Model& model, Scope& scope, const std::string& wanted, const Value& value,
                    const std::optional<std::string>& path, const Where& by) {
  std::vector<std::uint32_t> found = parametersMeant(model, scope.prefix, wanted);
  if (found.empty() && isUnread(scope, wanted)) return nullptr;
  if (found.empty()) mendDeclarations(model);
  const std::string leaf = wanted.substr(wanted.rfind('.') + 1);
  if (found.empty() && std::ranges::find(model.misspelt, leaf) != model.misspelt.end())
    if (const Variable meant = findVariable(model, scope, leaf); meant.kind == Variable::Kind::parameter)
      found = {meant.index};
  if (found.size() != 1) {
    std::vector<std::string> names;
    for (std::uint32_t i = 0; i < model.parameters.size(); ++i)
      if (const std::string& full = model.parameters[i].path;
          full.starts_with(scope.prefix) && (found.empty() || std::ranges::find(found, i) != found.end()))
        names.push_back(full.substr(scope.prefix.size()));
    if (found.empty())
      report(model, say::unknownParameter, by, wanted, model.scopes.front().desc->path,
             suffixHint(wanted, names));
    else
      reportAmbiguous(model, names, wanted, "parameters", by);
    return nullptr;
  }
  Parameter& parameter = model.parameters[found[0]];
  const ParameterDesc& desc = *parameter.desc;
  const Value taken = desc.type == Type::file && path ? Value::text(*path) : value;
  const bool fits = fitsType(desc, taken);
  if (fits && fitsRange(desc, taken)) {
    parameter.value = taken;
    parameter.valuePlace = by;
    return &parameter;
  }
  std::string expected = expectedOf(desc);
  if (desc.place.file)
    expected += fmt::format(", as {}:{}:{} says", *desc.place.file, desc.place.line, desc.place.column);
  const std::string text = taken.type == Value::Type::symbol ? taken.symbol : toText(taken);
  const std::string near = text::nearestHint(text, desc.choices);
  fits ? report(model, say::settingOutOfRange, by, parameter.path, text, expected, near)
       : report(model, say::notAValueForIt, by, parameter.path, text, expected, near);
  return nullptr;
}

}  // namespace

void applySetting(Model& model, const Setting& set) {
  // A path is what was written, whatever else that may mean.
  std::optional<std::string> path;
  if (set.origin == Origin::command_line) path = set.text;
  if (Parameter* const parameter =
          applySet(model, model.scopes.front(), set.name, set.value, path, placeOf(set)))
    parameter->origin = set.origin;
}

void applyDisable(Model& model, const Disable& disable) {
  const std::string& wanted = disable.name;
  const std::string source = sourceOf(disable);
  const Where by = placeOf(disable);
  const std::string declared = wanted.substr(0, wanted.find('['));
  std::vector<std::string> names;
  std::vector<std::pair<Scope*, const PassDesc*>> candidates;  // without a scope: a pass, else an include
  for (Scope& scope : model.scopes) {
    if (scope.parent && declared == wanted) {
      names.push_back(scope.prefix.substr(0, scope.prefix.size() - 1));
      candidates.emplace_back(&scope, scope.stanza);
    }
    for (const PassDesc& pass : scope.desc->passes)
      if (!pass.include) {
        names.push_back(scope.prefix + pass.name);
        candidates.emplace_back(nullptr, &pass);
      }
  }
  const std::vector<std::size_t> found = suffixMatches(names, declared);
  // When a file is included twice, both stanzas are meant.
  const auto isSame = [&](std::size_t i) {
    return candidates[i].second->place == candidates[found[0]].second->place;
  };
  if (!std::ranges::all_of(found, isSame)) {
    std::vector<std::string> meant;
    for (const std::size_t i : found) meant.push_back(names[i]);
    return reportAmbiguous(model, meant, wanted, "passes", by);
  }
  for (const std::size_t i : found)
    if (candidates[i].first)
      candidates[i].first->disabledBy = source;
    else
      model.disables[names[i]].push_back(
          {source, declared == wanted ? "" : names[i] + wanted.substr(declared.size())});
  if (!found.empty() || isUnread(model.scopes.front(), declared)) return;
  if (!parametersMeant(model, "", wanted).empty())
    report(model, say::parameterNotPass, by, wanted);
  else
    report(model, say::unknownPass, by, wanted, suffixHint(declared, names));
}

// A file of more than three values of which none is for this graph is one mistake, and reported.
static bool isForeign(Model& model, const Scope& scope, const SetDesc& first) {
  std::size_t count = 0;
  for (const SetDesc& set : scope.desc->sets)
    if (set.place.file == first.place.file) {
      if (!parametersMeant(model, scope.prefix, set.name).empty() || isUnread(scope, set.name)) return false;
      ++count;
    }
  if (count < 4) return false;
  report(model, say::presetOfOtherGraph, first.place, *first.place.file, count,
         model.scopes.front().desc->path, first.name);
  return true;
}

void applySettings(Model& model) {
  const auto [width, height] = std::pair(model.settings.screenWidth, model.settings.screenHeight);
  if (width < 1 || width > kMaxSize || height < 1 || height > kMaxSize)
    report(model, say::screenOutOfRange, text::placeOfOption("--size"), kMaxSize, width, height);
  // What files say first, the innermost first, so that an including file has the last word; then the command line.
  for (auto scope = model.scopes.rbegin(); scope != model.scopes.rend(); ++scope) {
    text::FileName file;
    bool foreign = false;
    for (const SetDesc& set : scope->desc->sets) {
      if (isOver(model)) return;
      if (std::exchange(file, set.place.file) != set.place.file) foreign = isForeign(model, *scope, set);
      if (foreign) continue;
      std::optional<std::string> path;
      if (set.value.type == Value::Type::symbol) path = text::besideFile(set.place, set.value.symbol);
      Parameter* const parameter = applySet(model, *scope, set.name, set.value, path, set.place);
      if (!parameter) continue;
      parameter->origin = set.origin;
      if (set.valuePlace.file) parameter->valuePlace = set.valuePlace;
    }
  }
  for (const Setting& set : model.settings.sets) applySetting(model, set);
  for (const Disable& disable : model.settings.disables) applyDisable(model, disable);
}

}  // namespace expansion

}  // namespace weft::graph
