#include "app/trials/device_run.h"

#include "app/session/session.h"

namespace weft::app {

int runOnDevice(const Options& options, int wrong,
                const std::function<int(gl::Context&, const runtime::World&, base::Diagnostics&)>& run) {
  base::Diagnostics diagnostics;
  const auto world = loadWorld(options, diagnostics);
  const auto context = world ? openContext(options, diagnostics) : nullptr;
  if (!context) {
    makePlan(options, world ? world->facts() : factsWithoutWorld(), true, diagnostics);
    report(diagnostics);
    return world ? 3 : wrong;
  }
  const int code = run(*context, *world, diagnostics);
  return report(diagnostics) ? wrong : code;
}

}  // namespace weft::app
