#include "engine/graph/expand/names/apply_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "engine/graph/expand/names/scope.h"
#include "engine/graph/language/suffix.h"
#include "engine/text/files/file.h"
#include "engine/text/nearest.h"

namespace weft::graph::expansion {

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

// Who says a name that is not written whole: where a message about it stands, and what it begins with.
struct SaidBy {
  Where place;
  std::string before{};  // "the value 9 set here for exposure: " of a panel, which has no place
};
template <class Said>  // Setting or Disable
SaidBy saidBy(const Said& said) {
  const std::string source = sourceOf(said);
  if (said.origin == Origin::command_line) return {text::placeOfOption(source)};
  return {Where{}, source + ": "};
}

// True, with a report, when a name may mean several things.
bool isAmbiguous(Model& model, const std::vector<std::string>& meant, std::string_view wanted,
                 std::string_view noun, const SaidBy& by) {
  if (meant.size() < 2) return false;
  report(model, Code::ambiguousName, by.place,
         fmt::format("{}'{}' may mean several {}", by.before, wanted, noun),
         {.found = fmt::format("{}", fmt::join(meant, ", ")),
          .hint = fmt::format("write more of the name, such as '{}'", meant[0])});
  return true;
}

// Whether `value` fits a parameter: its type, its choices, its range.
bool checkParameterValue(Model& model, const Parameter& parameter, const Value& value, const SaidBy& by) {
  const ParameterDesc& desc = *parameter.desc;
  const bool fits = fitsType(desc, value);
  if (fits && fitsRange(desc, value)) return true;
  std::string expected = expectedOf(desc);
  if (desc.place.file)
    expected += fmt::format(", as {}:{}:{} says", *desc.place.file, desc.place.line, desc.place.column);
  const std::string text = value.type == Value::Type::symbol ? value.symbol : toText(value);
  const std::vector<std::string> words =
      desc.type == Type::boolean ? std::vector<std::string>{"true", "false"} : desc.choices;
  std::string meant = text::nearestName(text, words);
  if (desc.type == Type::boolean)
    for (const char* word : {"0", "no", "off", "1", "yes", "on"})
      if (text == word) meant = text == "1" || text == "yes" || text == "on" ? "true" : "false";
  return report(model, fits ? Code::numberOutOfRange : Code::badParameterValue, by.place,
                fmt::format("{}parameter '{}': '{}' is {}", by.before, parameter.path, text,
                            fits ? "out of its range" : "not a value for it"),
                {.expected = std::move(expected),
                 .hint = meant.empty() ? "" : fmt::format("did you mean '{}'?", meant)});
}

// Gives the parameter of `scope`, or of a file that it includes, whose name ends in `wanted` a value; to one that is a file
// `path`, if there is one. Null after a report.
Parameter* applySet(Model& model, const Scope& scope, const std::string& wanted, const Value& value,
                    const std::optional<std::string>& path, const SaidBy& by) {
  const auto nameOf = [&](const Parameter& parameter) { return parameter.path.substr(scope.prefix.size()); };
  const std::vector<std::uint32_t> found = parametersMeant(model, scope.prefix, wanted);
  if (found.empty()) {
    if (mayBeUnread(scope, wanted)) return nullptr;
    std::vector<std::string> names;
    for (const Parameter& parameter : model.parameters)
      if (parameter.path.starts_with(scope.prefix)) names.push_back(nameOf(parameter));
    std::string hint = suffixHint(wanted, names);
    if (hint.empty())
      hint = fmt::format("'weft params {}' lists what there is", model.scopes.front().desc->path);
    report(model, Code::unknownParameter, by.place,
           fmt::format("{}no parameter is called '{}'", by.before, wanted), {.hint = std::move(hint)});
    return nullptr;
  }
  std::vector<std::string> meant;
  for (const std::uint32_t index : found) meant.push_back(nameOf(model.parameters[index]));
  if (isAmbiguous(model, meant, wanted, "parameters", by)) return nullptr;
  Parameter& parameter = model.parameters[found[0]];
  const Value taken = parameter.desc->type == Type::file && path ? Value::text(*path) : value;
  if (!checkParameterValue(model, parameter, taken, by)) return nullptr;
  parameter.value = taken;
  parameter.valuePlace = by.place;
  return &parameter;
}

}  // namespace

void applySetting(Model& model, const Setting& set) {
  // A path is what was written, whatever else that may mean.
  std::optional<std::string> path;
  if (set.origin == Origin::command_line) path = set.text;
  if (Parameter* const parameter =
          applySet(model, model.scopes.front(), set.name, set.value, path, saidBy(set)))
    parameter->origin = set.origin;
}

void applyDisable(Model& model, const Disable& disable) {
  const std::string& wanted = disable.name;
  const std::string source = sourceOf(disable);
  const SaidBy by = saidBy(disable);
  const std::string declared = wanted.substr(0, wanted.find('['));
  struct Candidate {
    Scope* scope;  // an include; null: a pass
    const PassDesc* stanza;
  };
  std::vector<std::string> names;
  std::vector<Candidate> candidates;
  for (Scope& scope : model.scopes) {
    if (scope.parent && declared == wanted) {
      names.push_back(scope.prefix.substr(0, scope.prefix.size() - 1));
      candidates.push_back({&scope, scope.stanza});
    }
    for (const PassDesc& pass : scope.desc->passes)
      if (!pass.include) {
        names.push_back(scope.prefix + pass.name);
        candidates.push_back({nullptr, &pass});
      }
  }
  const std::vector<std::size_t> found = suffixMatches(names, declared);
  // When a file is included twice, both stanzas are meant.
  const auto isSame = [&](std::size_t i) {
    return text::isSamePlace(candidates[i].stanza->place, candidates[found[0]].stanza->place);
  };
  std::vector<std::string> meant;
  for (const std::size_t i : found) meant.push_back(names[i]);
  if (!std::ranges::all_of(found, isSame) && isAmbiguous(model, meant, wanted, "passes", by)) return;
  for (const std::size_t i : found)
    if (candidates[i].scope)
      candidates[i].scope->disabledBy = source;
    else
      model.disables[names[i]].push_back(
          {source, declared == wanted ? "" : names[i] + wanted.substr(declared.size())});
  if (!found.empty() || mayBeUnread(model.scopes.front(), declared)) return;
  if (const auto named = parametersMeant(model, "", wanted); !named.empty()) {
    const Parameter& parameter = model.parameters[named[0]];
    report(model, Code::parameterNotPass, by.place,
           fmt::format("{}'{}' is a parameter, not a pass", by.before, parameter.path),
           {.hint = fmt::format("--set {}={}", wanted,
                                parameter.desc->type == Type::boolean ? "false" : "VALUE")});
    return;
  }
  report(model, Code::unknownPass, by.place, fmt::format("{}no pass is called '{}'", by.before, wanted),
         {.hint = suffixHint(declared, names)});
}

void applySettings(Model& model) {
  const auto [width, height] = std::pair(model.settings.screenWidth, model.settings.screenHeight);
  if (width < 1 || width > 16384 || height < 1 || height > 16384)
    report(model, Code::numberOutOfRange, text::placeOfOption("--size"),
           "the screen's size is out of its range",
           {.expected = "1 to 16384 pixels a side", .found = fmt::format("{}x{}", width, height)});
  // What files say first, the innermost first, so that an including file has the last word; then the command line.
  for (auto scope = model.scopes.rbegin(); scope != model.scopes.rend(); ++scope)
    for (const SetDesc& set : scope->desc->sets) {
      if (isOver(model)) return;
      std::optional<std::string> path;
      if (set.value.type == Value::Type::symbol) path = text::besideFile(set.place, set.value.symbol);
      Parameter* const parameter = applySet(model, *scope, set.name, set.value, path, {set.place});
      if (!parameter) continue;
      parameter->origin = set.origin;
      if (set.valuePlace.file) parameter->valuePlace = set.valuePlace;
    }
  for (const Setting& set : model.settings.sets) applySetting(model, set);
  for (const Disable& disable : model.settings.disables) applyDisable(model, disable);
}

}  // namespace weft::graph::expansion
