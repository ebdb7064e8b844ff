#include "app/ui/pass_rows.h"

#include <map>

#include "engine/graph/flat_graph.h"
#include "engine/graph/language/names.h"

namespace weft::app::ui {

namespace {

void addRows(const graph::GraphDesc& file, const std::string& prefix, std::size_t depth,
             std::vector<PassRow>& rows) {
  for (const graph::PassDesc& pass : file.passes) {
    const std::size_t row = rows.size();
    rows.push_back({.name = prefix + pass.name, .label = pass.name, .desc = &pass, .depth = depth});
    if (pass.include && pass.include->graph)
      addRows(*pass.include->graph, prefix + pass.name + ".", depth + 1, rows);
    rows[row].end = rows.size();
  }
}

}  // namespace

std::vector<PassRow> passRowsOf(const graph::GraphDesc& desc, const graph::Plan& plan) {
  const graph::FlatGraph& graph = *plan.graph;
  std::vector<PassRow> rows;
  addRows(desc, "", 0, rows);
  std::map<std::string, std::size_t> byName;
  for (std::size_t i = 0; i < rows.size(); ++i) byName.emplace(rows[i].name, i);
  for (std::uint32_t pass = 0; pass < graph.specs.size(); ++pass)
    if (const auto row = byName.find(graph.specs[pass].declared); row != byName.end())
      rows[row->second].passes.push_back(pass);
  for (const graph::DisabledPass& pass : graph.disabled)
    if (const auto row = byName.find(pass.name.substr(0, pass.name.find('['))); row != byName.end())
      if (rows[row->second].passes.empty()) rows[row->second].why = pass.why;
  for (PassRow& row : rows)
    for (std::size_t i = static_cast<std::size_t>(&row - rows.data()); i < row.end; ++i) {
      if (rows[i].effect()) continue;
      ++(rows[i].passes.empty() ? row.off : row.on);
      if (row.effect() && row.why.empty() && rows[i].passes.empty()) row.why = rows[i].why;
    }
  for (PassRow& row : rows)
    if (row.on > 0) row.why.clear();
  return rows;
}

std::string switchNameOf(const graph::FlatGraph& graph, std::uint32_t pass) {
  const graph::PassSpec& spec = graph.specs[pass];
  std::string name = spec.declared;
  for (const graph::PassSpec& other : graph.specs)
    if (other.place == spec.place) name = graph::commonSuffix(name, other.declared);
  return name;
}

std::string disabledBy(const PassRow& row, const graph::Settings& settings) {
  for (std::string name = row.name;; name.resize(name.rfind('.'))) {
    for (const graph::Disable& disable : settings.disables)
      if (graph::hasSuffix(name, disable.name)) return disable.name;
    if (name.find('.') == std::string::npos) return {};
  }
}

std::string switchParameterOf(const PassRow& row, const graph::FlatGraph& graph) {
  const std::string* const condition = row.desc->enabled.onlyVariable();
  if (row.on > 0 || !condition) return {};
  // As the file names it, or a file around it.
  for (std::string scope = row.name; !scope.empty();) {
    scope.resize(scope.find('.') == std::string::npos ? 0 : scope.rfind('.'));
    const std::string path = (scope.empty() ? "" : scope + ".") + *condition;
    for (const graph::ParameterSpec& parameter : graph.parameters)
      if (parameter.path == path && parameter.desc.type == graph::ParameterDesc::Type::boolean)
        return parameter.value.truth() ? "" : path;
  }
  return {};
}

}  // namespace weft::app::ui
