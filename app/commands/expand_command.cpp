// weft expand: a plan as a graph file without includes, repeats and conditions.
#include "app/commands/commands.h"
#include "app/output/standard_streams.h"
#include "app/session/session.h"
#include "engine/base/json/layout.h"
#include "engine/graph/print/graph_file.h"

namespace weft::app {

int runExpand(const Options& options) {
  base::Diagnostics diagnostics;
  const auto world = loadWorld(options, diagnostics);
  const auto plan = makePlan(options, world ? world->facts() : factsWithoutWorld(), true, diagnostics);
  if (plan)
    print(base::layoutJson(graph::graphFileOf(*plan),
                           {.packed = {"set"}, .starts = {"read", "write", "modify"}}));
  return report(diagnostics);
}

}  // namespace weft::app
