#include "app/trials/device_run.h"

#include "app/session/session.h"

namespace weft::app {

int runOnDevice(std::span<const Options> all, int wrong,
                const std::function<int(gl::Context&, const runtime::World&, base::Diagnostics&)>& run) {
  const Options& options = all.front();
  base::Diagnostics diagnostics;
  const auto world = loadWorld(options, diagnostics);
  if (!world) {
    makePlan(options, factsWithoutWorld(), true, diagnostics);
    report(diagnostics);
    return wrong;
  }
  for (const Options& each : all)
    if (isWrong(each, world->facts(), diagnostics)) {
      report(diagnostics);
      return wrong;
    }
  const auto context = openContext(options, diagnostics);
  if (!context) {
    makePlan(options, world->facts(), true, diagnostics);  // one that came by a pipe
    report(diagnostics);
    return 3;
  }
  const int code = run(*context, *world, diagnostics);
  return report(diagnostics) ? wrong : code;
}

}  // namespace weft::app
