// weft ablate: what each pass costs and does.
#include "app/commands/commands.h"
#include "app/output/standard_streams.h"
#include "app/trials/ablation.h"
#include "app/trials/device_run.h"

namespace weft::app {

int runAblate(const Options& options) {
  const auto run = [&](gl::Context& context, const runtime::World& world, base::Diagnostics& diagnostics) {
    const auto table = ablatePasses(context, options, world, diagnostics);
    if (!table) return 1;
    print(options.format == "json"   ? ablationJson(*table)
          : options.format == "html" ? ablationPage(*table, options.graph)
                                     : ablationText(*table));
    return 0;
  };
  return runOnDevice({&options, 1}, 1, run);
}

}  // namespace weft::app
