// weft explain: what the plan knows of one pass, resource or parameter.
#include "app/commands/commands.h"
#include "app/output/standard_streams.h"
#include "app/session/session.h"
#include "engine/graph/print/describe.h"

namespace weft::app {

int runExplain(const Options& options) {
  base::Diagnostics diagnostics;
  const auto world = loadWorld(options, diagnostics);
  const auto plan = makePlan(options, world ? world->facts() : factsWithoutWorld(), true, diagnostics);
  if (plan)
    if (const auto text = graph::describe(*plan, options.name, diagnostics)) print(*text);
  return report(diagnostics);
}

}  // namespace weft::app
