// weft diff: how the plan of one graph differs from that of another.
#include "app/commands/commands.h"
#include "app/output/standard_streams.h"
#include "app/session/session.h"
#include "engine/graph/print/diff.h"

namespace weft::app {

int runDiff(const Options& options) {
  base::Diagnostics diagnostics;
  const auto world = loadWorld(options, diagnostics);
  const runtime::WorldFacts facts = world ? world->facts() : factsWithoutWorld();
  Options other = options;
  other.graph = options.otherGraph;
  const auto before = makePlan(options, facts, true, diagnostics);
  const auto after = makePlan(other, facts, true, diagnostics);
  if (!before || !after || diagnostics.hasErrors()) {
    report(diagnostics);
    return 2;
  }
  const std::string text = graph::diffText(*before, *after);
  print(text);
  report(diagnostics);
  return text.empty() ? 0 : 1;
}

}  // namespace weft::app
