// GraphDesc to FlatGraph: scopes of includes, parameters, repeats, conditions, alternatives, disabled passes,
// renames, versions, sizes and every check of the design's "Diagnostics". Pure: no clock, no device, no
// files.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/diagnostic.h"
#include "engine/graph/desc.h"
#include "engine/graph/flat_graph.h"
#include "engine/graph/registry.h"

namespace weft::graph {

struct Settings {
  std::uint32_t screenWidth = 1280, screenHeight = 720;
  bool software = false;                                  // device.software
  std::vector<std::pair<std::string, std::string>> sets;  // --set NAME=VALUE; NAME is any unique suffix
  std::vector<std::string> disables;  // --disable NAME; any unique suffix, all its repeats
};

// How diagnostics call an entry of Settings::sets or ::disables: as on the command line.
std::string sourceOfSet(const std::string& name, const std::string& value);
std::string sourceOfDisable(const std::string& name);
// The place of diagnostics about one: the "file" is "command line: --set bloom=yes", without a line.
Place placeOfSetting(const std::string& source);
bool isSetting(const Place& place);

// The expanded graph, or null after errors. Warnings leave a graph. `diagnostics` may hold errors of the
// reader already: then everything is checked as far as it goes, and null is returned.
std::shared_ptr<const FlatGraph> expandGraph(const GraphDesc& desc, const Registry& registry,
                                             const Settings& settings, base::Diagnostics& diagnostics);

}  // namespace weft::graph
