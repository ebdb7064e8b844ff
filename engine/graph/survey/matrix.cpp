#include "engine/graph/survey/matrix.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "engine/graph/language/value.h"

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

class Trial {
 public:
  Trial(const GraphDesc& desc, const Registry& registry, const Settings& settings,
        const MatrixOptions& options)
      : desc_(desc), registry_(registry), settings_(settings), options_(options) {}

  Matrix run() {
    const std::shared_ptr<const FlatGraph> base = expand({});
    if (!base) return std::move(matrix_);
    const std::vector<std::string> passes = passesOf(*base);
    matrix_.passes = passes.size();
    std::vector<std::string> dispensable;
    for (const std::string& pass : passes)
      if (tryDisables({pass})) dispensable.push_back(pass);
    for (std::size_t i = 0; options_.pairs && i < dispensable.size(); ++i)
      for (std::size_t k = i + 1; k < dispensable.size(); ++k) {
        ++matrix_.pairs;
        tryDisables({dispensable[i], dispensable[k]});
      }
    for (const ParameterSpec& parameter : base->parameters)
      for (const std::string& value : valuesOf(parameter.desc)) {
        ++matrix_.values;
        Variation variation{.disables = {}, .parameter = parameter.path, .value = value};
        if (!expand(variation)) matrix_.broken.push_back({std::move(variation), std::move(said_)});
      }
    return std::move(matrix_);
  }

 private:
  static std::vector<std::string> passesOf(const FlatGraph& graph) {
    std::vector<std::string> names;
    std::set<std::string_view> seen;
    for (const PassSpec& spec : graph.specs)
      if (seen.insert(spec.declared).second) names.push_back(spec.declared);
    return names;
  }

  // What a person can choose: words and switches, and the ends of a range.
  static std::vector<std::string> valuesOf(const ParameterDesc& desc) {
    using Kind = ParameterDesc::Type;
    if (desc.type == Kind::choice) return desc.choices;
    if (desc.type == Kind::boolean) return {"false", "true"};
    std::vector<std::string> values;
    if (desc.type != Kind::number && desc.type != Kind::integer) return values;
    for (const std::optional<double>& end : {desc.min, desc.max})
      if (end) values.push_back(toText(Value::number(*end)));
    return values;
  }

  std::shared_ptr<const FlatGraph> expand(const Variation& variation) {
    Settings settings = settings_;
    for (const std::string& pass : variation.disables) settings.disables.emplace_back(pass);
    if (!variation.parameter.empty()) settings.sets.emplace_back(variation.parameter, variation.value);
    text::Diagnostics said;
    auto graph = expandGraph(desc_, registry_, settings, said);
    said_.clear();
    text::Diagnostics lost;
    for (const text::Diagnostic& d : said.items())
      if (d.severity == text::Severity::error)
        said_.add(d);
      else if (namesLost(d) && told_.insert(fmt::format("{} {}", d.pass, d.resource)).second)
        lost.add(d);
    const bool changed = !variation.disables.empty() || !variation.parameter.empty();
    if (graph && changed && !lost.empty()) matrix_.lost.push_back({variation, std::move(lost)});
    if (graph && options_.visit) options_.visit(variation, graph);
    return graph;
  }

  // Whether the graph does without the passes.
  bool tryDisables(std::vector<std::string> passes) {
    Variation variation{.disables = std::move(passes), .parameter = {}, .value = {}};
    if (expand(variation)) return true;
    const bool told = std::ranges::all_of(said_.items(), namesDisabled);
    (told ? matrix_.needed : matrix_.broken).push_back({std::move(variation), std::move(said_)});
    return false;
  }

  const GraphDesc& desc_;
  const Registry& registry_;
  const Settings& settings_;
  const MatrixOptions& options_;
  Matrix matrix_;
  text::Diagnostics said_;
  std::set<std::string> told_;  // passes and resources that were warned of
};

}  // namespace

std::string Variation::text() const {
  std::string text;
  for (const std::string& pass : disables) text += (text.empty() ? "" : " ") + ("--disable " + pass);
  if (!parameter.empty()) text += fmt::format("--set {}={}", parameter, value);
  return text.empty() ? "as it is" : text;
}

Matrix tryMatrix(const GraphDesc& desc, const Registry& registry, const Settings& settings,
                 const MatrixOptions& options) {
  return Trial(desc, registry, settings, options).run();
}

}  // namespace weft::graph
