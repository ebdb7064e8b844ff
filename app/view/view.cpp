// weft view: a graph in a window, with an orbiting camera; files that change on disk take effect at once.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "app/commands.h"
#include "app/session.h"
#include "app/view/viewer.h"

namespace weft::app {

int runView(const Options& options) {
  base::Diagnostics diagnostics;
  Options files = options;
  if (!files.environment.empty()) files.environment = firstEnvironment(options.environment, diagnostics).value_or("");
  Options first = files;
  if (!options.waitForAssets) first.environment.clear();  // comes while the window is open
  auto world = loadWorld(first, diagnostics);
  if (!world || diagnostics.hasErrors()) return report(diagnostics);
  if (!files.environment.empty() && !world->environment()) world->expectEnvironment();
  auto session = openDevice(options, diagnostics);
  if (!session) {
    report(diagnostics);
    return 3;
  }
  if (!session->context->window()) {
    fmt::print(stderr, "weft view needs a window: use --backend glfw, or `weft render` without a display\n");
    return 2;
  }
  graph::Settings settings = settingsOf(options, session->context->device().software);
  const gl::Size size = session->context->framebufferSize();
  settings.screenWidth = std::max(1u, size.width);
  settings.screenHeight = std::max(1u, size.height);
  LiveGraph live(files, session->renderer, std::move(*world), std::move(settings));
  if (!live.load(diagnostics)) return report(diagnostics);
  return Viewer(options, *session, live, std::move(diagnostics)).run();
}

}  // namespace weft::app
