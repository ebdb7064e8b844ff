#include "app/view/capture.h"

#include <fmt/format.h>

namespace weft::app {

bool saveScreenshot(runtime::Renderer& renderer, const std::string& path, base::Diagnostics& diagnostics) {
  const auto image = renderer.readPresented8();
  if (!image ||
      !assets::savePng8(path, image->width, image->height, image->channels, image->texels, diagnostics))
    return false;
  fmt::print("wrote {}\n", path);
  return true;
}

}  // namespace weft::app
