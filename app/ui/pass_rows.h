// The rows of the panel of passes: every stanza of the graph's files in their order; and what their boxes turn on and off.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/graph/desc.h"
#include "engine/graph/expand/names/settings.h"
#include "engine/graph/plan.h"

namespace weft::app::ui {

struct PassRow {
  std::string name;   // full, as declared: "post.fxaa", "post.fxaa.smooth"
  std::string label;  // its last part
  const graph::PassDesc* desc = nullptr;
  std::size_t depth = 0, end = 0;     // of includes around it; behind the rows that it includes
  std::vector<std::uint32_t> passes;  // its instances in FlatGraph::passes
  std::string why;                    // why it is off; "" when it is on
  std::size_t on = 0, off = 0;        // passes in it, itself included
  bool effect() const { return desc->include.has_value(); }
};

// `desc` must outlive them.
std::vector<PassRow> passRowsOf(const graph::GraphDesc& desc, const graph::Plan& plan);

// What is given to --disable to turn the pass off: its name, or, when its file is included twice, the end of the name that
// means it in all of them. F8 could not write them apart.
std::string switchNameOf(const graph::FlatGraph& graph, std::uint32_t pass);

// What --disable or a box named to turn a row or an effect around it off; "" when something else did.
std::string disabledBy(const PassRow& row, const graph::Settings& settings);
// The parameter that turns the row on when it is true, of a stanza with "enabled": "$name" that is off; else "".
std::string switchParameterOf(const PassRow& row, const graph::FlatGraph& graph);

}  // namespace weft::app::ui
