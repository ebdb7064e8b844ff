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

// Where a value comes from that no file says.
enum class Origin : std::uint8_t { command_line, panel };

// A value for a parameter. `name` is any unique suffix.
struct Setting {
  std::string name;
  Value value;
  Origin origin = Origin::command_line;
  std::string text{};  // as it was written on the command line
  // From the command line: the text behind NAME=, which is read here and nowhere else.
  Setting(std::string setName, std::string setText);
  Setting(std::string setName, Value setValue, Origin setOrigin);
};

// A pass, or all passes of an include, that is disabled; any unique suffix of its name means all its repeats.
struct Disable {
  std::string name;
  Origin origin = Origin::command_line;
  Disable(std::string passName, Origin from = Origin::command_line) : name(std::move(passName)), origin(from) {}
  Disable(const char* passName) : name(passName) {}
};

struct Settings {
  std::uint32_t screenWidth = 1280, screenHeight = 720;
  bool software = false;                                  // device.software
  std::vector<Setting> sets{};                            // in order: the last wins
  std::vector<Disable> disables{};
};

// How diagnostics call them: "--set bloom=yes" and "--disable fxaa" as on the command line, "the value 9 set here for
// exposure" and "switching off fxaa here" of a panel.
std::string sourceOf(const Setting& setting);
std::string sourceOf(const Disable& disable);
// The place of what was on the command line: "command line: --set bloom=yes", without a line.
Place placeOfOption(const std::string& option);
bool isSetting(const Place& place);

// The expanded graph, or null after errors. Warnings leave a graph. `diagnostics` may hold errors of the
// reader already: then everything is checked as far as it goes, and null is returned.
std::shared_ptr<const FlatGraph> expandGraph(const GraphDesc& desc, const Registry& registry,
                                             const Settings& settings, base::Diagnostics& diagnostics);

// An entry of Settings::sets, or of ::disables, that the graph does not take, and why.
struct Refusal {
  bool disable = false;
  std::size_t index = 0;
  base::Diagnostic why;
};
std::vector<Refusal> findRefused(const GraphDesc& desc, const Registry& registry, const Settings& settings);

}  // namespace weft::graph
