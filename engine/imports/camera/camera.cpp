#include "engine/imports/camera/camera.h"

#include <algorithm>

#include "engine/imports/camera_views.h"

namespace weft::imports {

namespace {

using graph::Value;

// In the order of reflect().
std::uint32_t jitterOf(const graph::ImportRequest& request) {
  return static_cast<std::uint32_t>(std::clamp(request.arguments[0].second.v[0], 0.0, 4294967295.0));
}

double fovOf(const graph::ImportRequest& request) {
  const double focal = request.arguments[1].second.v[0];
  const double sensor = std::clamp(request.arguments[2].second.v[0], 1e-3, 1e5);
  return focal > 0 ? scene::fovOfLens(std::clamp(focal, 0.01 * sensor, 1e4 * sensor), sensor) : 0;
}

class CameraProvider : public Provider {
 public:
  explicit CameraProvider(const graph::ImportRequest& request) : views_(jitterOf(request), fovOf(request)) {}
  const scene::ViewData& view(const Frame& frame, std::uint32_t width, std::uint32_t height) override {
    return views_.view(frame, width, height);
  }

 private:
  CameraViews views_;
};

}  // namespace

graph::ImportType Camera::reflect() const {
  return {.name = "camera",
          .kind = graph::ImportKind::view,
          .doc = "The scene's camera. Declared under the name `camera` it is the view of every pass.",
          .arguments = {{.name = "jitter",
                         .initial = Value::number(0),
                         .choices = {},
                         .doc = "length of the sub-pixel Halton sequence; 0 for none"},
                        {.name = "focal_length",
                         .initial = Value::number(0),
                         .choices = {},
                         .doc = "of its lens in mm: sets the angle of view; 0 for the scene's angle"},
                        {.name = "sensor_height",
                         .initial = Value::number(24),
                         .choices = {},
                         .doc = "mm that the picture's height stands for"}},
          .everyPass = true};
}

std::unique_ptr<Provider> Camera::provide(const graph::ImportRequest& request) const {
  return std::make_unique<CameraProvider>(request);
}

}  // namespace weft::imports
