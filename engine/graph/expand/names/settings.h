// What a person asked of a graph beside its files: the screen, values of parameters, disabled passes. Plain data; what a
// name means is found when the graph is expanded (names.h). Also whether a parameter takes a value.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/graph/desc.h"

namespace weft::graph {

// A value for a parameter. `name` is any unique suffix.
struct Setting {
  std::string name;
  Value value;
  Origin origin = Origin::command_line;
  std::string text{};            // as it was written on the command line
  std::string option = "--set";  // of the command line, for messages
  // From the command line: the text behind NAME=, which is read here and nowhere else.
  Setting(std::string setName, std::string setText);
  Setting(std::string setName, Value setValue, Origin setOrigin);
};

// A pass, or all passes of an include, that is disabled; any unique suffix of its name means all its repeats.
struct Disable {
  std::string name;
  Origin origin = Origin::command_line;
  std::string option = "--disable";  // of the command line, for messages
  Disable(std::string passName, Origin from = Origin::command_line)
      : name(std::move(passName)), origin(from) {}
  Disable(const char* passName) : name(passName) {}
};

struct Settings {
  std::uint32_t screenWidth = 1280, screenHeight = 720;
  bool software = false, window = false;  // device.software, device.window
  std::vector<Setting> sets{};            // in order: the last wins
  std::vector<Disable> disables{};
  std::vector<Pick> kept{};  // to be looked at: what writes them is live
};

// How diagnostics call them: "--set bloom=yes" and "--disable fxaa" as on the command line, "the value 9 set here for
// exposure" and "switching off fxaa here" of a panel.
std::string sourceOf(const Setting& setting);
std::string sourceOf(const Disable& disable);

// 2 to 4 of a list, else 0.
int componentsOf(ParameterDesc::Type type);
// Whether a value fits the type and the choices of a parameter; whether one that fits the type is in the range, of a list
// every component. They allocate nothing, so that a value can be set between two frames.
bool fitsType(const ParameterDesc& desc, const Value& value);
bool fitsRange(const ParameterDesc& desc, const Value& value);
inline bool takesValue(const ParameterDesc& desc, const Value& value) {
  return fitsType(desc, value) && fitsRange(desc, value);
}

}  // namespace weft::graph
