// weft ablate: what each pass costs and does.
#include "app/commands/commands.h"
#include "app/output/standard_streams.h"
#include "app/session/session.h"
#include "app/trials/ablation.h"

namespace weft::app {

int runAblate(const Options& options) {
  base::Diagnostics diagnostics;
  const auto world = loadWorld(options, diagnostics);
  const auto context = world ? openContext(options, diagnostics) : nullptr;
  if (!context) {
    makePlan(options, world ? world->facts() : factsWithoutWorld(), true, diagnostics);
    report(diagnostics);
    return world ? 3 : 1;
  }
  if (const auto table = ablatePasses(*context, options, *world, diagnostics))
    print(options.format == "json"   ? ablationJson(*table)
          : options.format == "html" ? ablationPage(*table, options.graph)
                                     : ablationText(*table));
  return report(diagnostics);
}

}  // namespace weft::app
