#include "app/ui/pass_switch.h"

#include "engine/graph/language/suffix.h"

namespace weft::app::ui {

std::string switchNameOf(const graph::FlatGraph& graph, std::uint32_t pass) {
  const graph::PassSpec& spec = graph.specs[pass];
  std::string name = spec.declared;
  for (const graph::PassSpec& other : graph.specs)
    if (text::isSamePlace(other.place, spec.place)) name = graph::commonSuffix(name, other.declared);
  return name;
}

std::string disabledBy(const graph::DisabledPass& pass, const graph::Settings& settings) {
  for (const graph::Disable& disable : settings.disables)
    if (graph::sourceOf(disable) == pass.why) return disable.name;
  return {};
}

}  // namespace weft::app::ui
