#include "engine/graph/survey/matrix.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "engine/graph/language/expr.h"

namespace weft::graph {

namespace {

using text::Code;

// Codes by which a read says that what it needs was switched off, with its name and the ways out.
bool namesDisabled(const text::Diagnostic& d) {
  return d.code == Code::disabledWriter || d.code == Code::conditionLeavesSlotEmpty ||
         d.code == Code::nothingPresented;
}

// Codes by which an enabled pass does not do what it is there for.
bool namesLost(const text::Diagnostic& d) {
  return d.severity == text::Severity::warning &&
         (d.code == Code::readBeforeWrite || d.code == Code::culledOverwritten ||
          d.code == Code::culledUnread);
}

// What a person can choose: words and switches, and the ends of a range.
std::vector<std::string> choicesOf(const ParameterDesc& desc) {
  using Kind = ParameterDesc::Type;
  if (desc.type == Kind::choice) return desc.choices;
  if (desc.type == Kind::boolean) return {"false", "true"};
  std::vector<std::string> values;
  if (desc.type != Kind::number && desc.type != Kind::integer) return values;
  for (const std::optional<double>& end : {desc.min, desc.max})
    if (end) values.push_back(toText(Value::number(*end)));
  return values;
}

}  // namespace

std::string Variation::text() const {
  std::string text;
  for (const std::string& pass : disables) text += (text.empty() ? "" : " ") + ("--disable " + pass);
  if (!parameter.empty()) text += fmt::format("--set {}={}", parameter, value);
  return text.empty() ? "as it is" : text;
}

Matrix tryMatrix(const GraphDesc& desc, const Registry& registry, const Settings& settings,
                 const MatrixOptions& options) {
  Matrix matrix;
  text::Diagnostics errors;    // of the last variation
  std::set<std::string> told;  // passes and resources that were warned of
  const auto expand = [&](const Variation& variation) {
    Settings varied = settings;
    for (const std::string& pass : variation.disables) varied.disables.emplace_back(pass);
    if (!variation.parameter.empty()) varied.sets.emplace_back(variation.parameter, variation.value);
    text::Diagnostics said, lost;
    auto graph = expandGraph(desc, registry, varied, said);
    errors.clear();
    for (const text::Diagnostic& d : said.items())
      if (d.severity == text::Severity::error)
        errors.add(d);
      else if (namesLost(d) && told.insert(fmt::format("{} {}", d.pass, d.resource)).second)
        lost.add(d);
    const bool changed = !variation.disables.empty() || !variation.parameter.empty();
    if (graph && changed && !lost.empty()) matrix.lost.push_back({variation, std::move(lost)});
    if (graph && options.visit) options.visit(variation, graph);
    return graph;
  };
  // Whether the graph does without the passes.
  const auto tryDisables = [&](std::vector<std::string> passes) {
    Variation variation{.disables = std::move(passes), .parameter = {}, .value = {}};
    if (expand(variation)) return true;
    const bool known = std::ranges::all_of(errors.items(), namesDisabled);
    (known ? matrix.needed : matrix.broken).push_back({std::move(variation), std::move(errors)});
    return false;
  };
  const std::shared_ptr<const FlatGraph> base = expand({});
  if (!base) return matrix;
  std::set<std::string_view> seen;
  std::vector<std::string> dispensable;
  for (const PassSpec& spec : base->specs) {
    if (!seen.insert(spec.declared).second) continue;
    ++matrix.passes;
    if (tryDisables({spec.declared})) dispensable.push_back(spec.declared);
  }
  for (std::size_t i = 0; options.pairs && i < dispensable.size(); ++i)
    for (std::size_t k = i + 1; k < dispensable.size(); ++k) {
      ++matrix.pairs;
      tryDisables({dispensable[i], dispensable[k]});
    }
  for (const ParameterSpec& parameter : base->parameters)
    for (const std::string& value : choicesOf(parameter.desc)) {
      ++matrix.values;
      Variation variation{.disables = {}, .parameter = parameter.path, .value = value};
      if (!expand(variation)) matrix.broken.push_back({std::move(variation), std::move(errors)});
    }
  return matrix;
}

}  // namespace weft::graph
