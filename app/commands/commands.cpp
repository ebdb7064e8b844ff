// The commands that print: dot, plan, bench, schema, types.
#include "app/commands/commands.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sstream>

#include "app/bench/edit_bench.h"
#include "app/bench/frame_bench.h"
#include "app/output/standard_streams.h"
#include "app/session/session.h"
#include "engine/graph/language/schema.h"
#include "engine/graph/print/dot.h"
#include "engine/graph/print/format_table.h"
#include "engine/graph/print/json.h"
#include "engine/graph/print/text.h"
#include "engine/runtime/imports/registry.h"

namespace weft::app {

namespace {

std::shared_ptr<const graph::Plan> planFor(const Options& options, base::Diagnostics& diagnostics) {
  const auto world = loadWorld(options, diagnostics);
  return makePlan(options, world ? world->facts() : factsWithoutWorld(), true, diagnostics);
}

}  // namespace

int runDot(const Options& options) {
  base::Diagnostics diagnostics;
  if (const auto plan = planFor(options, diagnostics)) print(graph::dumpDot(*plan));
  return report(diagnostics);
}

int runPlan(const Options& options) {
  base::Diagnostics diagnostics;
  if (const auto plan = planFor(options, diagnostics))
    print(options.format == "json" ? graph::dumpJson(*plan, options.explain)
                                   : graph::dumpText(*plan, options.explain));
  return report(diagnostics);
}

int runBench(const Options& options) {
  base::Diagnostics diagnostics;
  Options frame = options, edit = options;
  frame.graph = options.frameGraph;
  edit.graph = options.editGraph;
  std::optional<std::string> text;
  if (!frame.graph.empty()) {
    text = benchFrame(frame, diagnostics);
  } else if (!edit.graph.empty()) {
    text = benchEdits(edit, diagnostics);
  } else {
    frame.graph = edit.graph = dataFolder() + "/graphs/studio.json";
    const auto edits = benchEdits(edit, diagnostics);
    const auto frames = edits ? benchFrame(frame, diagnostics) : std::nullopt;
    if (frames) text = fmt::format("{{\"edit\": {},\n\"frame\": {}}}", *edits, *frames);
  }
  if (text) print(*text + "\n");
  return report(diagnostics);
}

int runSchema(const Options&) {
  print(graph::graphSchema());
  return 0;
}

// What a graph may name, from the registry itself.
int runTypes(const Options&) {
  const graph::Registry registry = runtime::makeRegistry({}, {});
  print("pass types\n");
  for (const graph::PassType& type : registry.passTypes) {
    print(fmt::format("  {}\n    {}\n", type.name, type.doc));
    if (!type.keys.empty()) print(fmt::format("    keys: {}\n", fmt::join(type.keys, ", ")));
    for (const graph::FixedSlot& slot : type.fixedSlots)
      print(fmt::format("    slot {}: {}\n", slot.name, slot.doc));
  }
  print("\nimports\n");
  for (const graph::ImportType& type : registry.imports) {
    print(fmt::format("  @{}\n    {}\n", type.name, type.doc));
    for (const graph::ImportArgument& argument : type.arguments)
      print(fmt::format("    {} (default {}): {}\n", argument.name, graph::toText(argument.initial),
                        argument.doc));
    for (const graph::TableColumn& column : type.columns)
      print(fmt::format("    .{} {}{}{}\n", column.name, column.type, column.doc.empty() ? "" : ": ",
                        column.doc));
  }
  print("\nformats\n");
  std::istringstream formats(graph::formatTable());
  for (std::string line; std::getline(formats, line);) print("  " + line + "\n");
  return 0;
}

}  // namespace weft::app
