#include "tests/theory/lens/thin_lens.h"

#include <cmath>
#include <string>

namespace weft::theory {

double outlineOf(int blades, double angle) {
  if (blades < 3) return 1;
  const double sector = 2 * M_PI / blades, within = angle - sector * std::floor(angle / sector);
  return std::cos(sector / 2) / std::cos(within - sector / 2);
}

double ThinLens::unitsPerPixel(double at) const {
  return std::tan(M_PI / 6) / (height / 2.0) * at;
}

std::vector<weft::graph::Setting> ThinLens::sets() const {
  // A focal length f and an f-number N for which what lies at `distance` has that disc: f^2 / (N (s - f)) |1 - s / d| on a sensor of 24 mm.
  const double f = 1.8 * std::sqrt(diameter / 240);
  const double aperture = f * f / (focus - f) * std::abs(1 - focus / distance) / (diameter * 0.024 / height);
  return {{"dof", "true"},
          {"bloom", "false"},
          {"focal_length", std::to_string(1000 * f)},
          {"aperture", std::to_string(aperture)},
          {"focus_distance", std::to_string(focus)},
          {"sensor_height", "24"},
          {"largest_bokeh", diameter < 62 ? "32" : "34"},
          {"blades", std::to_string(blades)}};
}

double arrives(const ThinLens& lens, glm::dvec2 light, glm::dvec2 pixel,
               const std::vector<Blocker>& blockers) {
  // A ray from the light through a place `at` on the lens (the camera is its middle) is seen at the pixel where it meets the plane in focus.
  const double blur = 1 - lens.focus / lens.distance, unit = lens.unitsPerPixel(lens.focus);
  const glm::dvec2 at = (pixel - light) * unit / blur;
  const double most = lens.diameter / 2 * unit / std::abs(blur);
  const double away = glm::length(at);
  if (away > most) return 0;
  if (lens.blades >= 3 && away > most * outlineOf(lens.blades, std::atan2(at.y, at.x))) return 0;
  const glm::dvec3 from(light * lens.unitsPerPixel(lens.distance), lens.distance);
  const glm::dvec3 ray = glm::dvec3(at, 0) - from;
  for (const Blocker& blocker : blockers) {
    const glm::dvec3 to = blocker.center - from;
    const double along = glm::dot(to, ray) / glm::dot(ray, ray);
    const glm::dvec3 nearest = to - along * ray;
    if (along > 0 && along < 1 && glm::dot(nearest, nearest) < blocker.radius * blocker.radius) return 0;
  }
  return 1;
}

}  // namespace weft::theory
