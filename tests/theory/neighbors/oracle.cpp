#include "tests/theory/neighbors/oracle.h"

#include <cmath>
#include <numbers>

namespace weft::theory {

namespace {

double unit(std::mt19937& random) {
  return std::uniform_real_distribution<double>(0, 1)(random);
}

// `axis` is the third column.
glm::dmat3 frameOf(glm::dvec3 axis) {
  const glm::dvec3 side =
      glm::normalize(glm::cross(axis, std::abs(axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
  return {side, glm::cross(axis, side), axis};
}

// With the density cosine / pi.
glm::dvec3 cosineDirection(const glm::dmat3& frame, double u, double v) {
  const double r = std::sqrt(u), phi = 2 * std::numbers::pi * v;
  return frame * glm::dvec3(r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(1 - u, 0.0)));
}

}  // namespace

std::vector<Solid> solidsOf(const std::vector<Ball>& balls) {
  std::vector<Solid> solids;
  for (const Ball& ball : balls)
    solids.push_back({glm::dvec3(ball.center), double(ball.radius), double(ball.albedo.x)});
  return solids;
}

Meeting meet(const std::vector<Solid>& solids, glm::dvec3 from, glm::dvec3 direction, int self) {
  Meeting nearest{.sphere = -1, .distance = 1e300};
  for (std::size_t i = 0; i < solids.size(); ++i) {
    if (int(i) == self) continue;
    const glm::dvec3 to = solids[i].center - from;
    const double along = glm::dot(to, direction), r2 = solids[i].radius * solids[i].radius;
    const double beside2 = glm::dot(to, to) - along * along;
    if (beside2 > r2 || along < 0) continue;
    const double distance = along - std::sqrt(r2 - beside2);
    if (distance > -1e-9 && distance < nearest.distance) nearest = {.sphere = int(i), .distance = distance};
  }
  return nearest;
}

double skySeen(const std::vector<Solid>& solids, glm::dvec3 at, glm::dvec3 normal, int self, int side,
               std::mt19937& random) {
  const glm::dmat3 frame = frameOf(normal);
  int seen = 0;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      seen +=
          meet(solids, at, cosineDirection(frame, (i + unit(random)) / side, (j + unit(random)) / side), self)
              .sphere < 0;
  return double(seen) / (side * side);
}

double tracedLight(const std::vector<Solid>& solids, glm::dvec3 at, glm::dvec3 normal, int self,
                   const Sky& sky, int paths, std::mt19937& random, std::optional<double> floor) {
  double sum = 0;
  for (int i = 0; i < paths; ++i) {
    glm::dvec3 place = at, n = normal;
    double left = 1;
    int on = self;
    while (left > 1e-4) {
      const glm::dvec3 direction = cosineDirection(frameOf(n), unit(random), unit(random));
      const Meeting met = meet(solids, place, direction, on);
      const double down = floor && direction.y < 0 ? -place.y / direction.y : 1e300;
      if (down > 0 && down < met.distance && down < 1e300) {
        on = -1;
        left *= *floor;
        place += direction * down;
        n = {0, 1, 0};
        continue;
      }
      if (met.sphere < 0) {
        sum += left * sky(direction);
        break;
      }
      on = met.sphere;
      const Solid& solid = solids[static_cast<std::size_t>(on)];
      left *= solid.albedo;
      place += direction * met.distance;
      n = glm::normalize(place - solid.center);
    }
  }
  return sum / paths;
}

double lobeSeen(const std::vector<Solid>& solids, glm::dvec3 at, glm::dvec3 normal, glm::dvec3 view,
                double roughness, int self, int rays, std::mt19937& random) {
  const double alpha = std::max(roughness * roughness, 1e-4), a2 = alpha * alpha;
  const glm::dmat3 frame = frameOf(normal);
  const double nv = glm::dot(normal, view);
  const auto masking = [&](double cosine) { return std::sqrt(a2 + (1 - a2) * cosine * cosine); };
  double all = 0, seen = 0;
  for (int i = 0; i < rays; ++i) {
    // Half vectors with the density D (N.H).
    const double u = unit(random), phi = 2 * std::numbers::pi * unit(random);
    const double c = std::sqrt((1 - u) / (1 + (a2 - 1) * u)), s = std::sqrt(std::max(1 - c * c, 0.0));
    const glm::dvec3 h = frame * glm::dvec3(s * std::cos(phi), s * std::sin(phi), c);
    const double vh = glm::dot(view, h);
    const glm::dvec3 l = h * (2 * vh) - view;
    const double nl = glm::dot(normal, l);
    if (vh <= 0 || nl <= 0) continue;
    // D G F / (4 NL NV) NL over D NH / (4 VH), with height-correlated G.
    const double weight = 2 * nl * vh / ((nl * masking(nv) + nv * masking(nl)) * c);
    all += weight;
    if (meet(solids, at, l, self).sphere < 0) seen += weight;
  }
  return all > 0 ? seen / all : 1;
}

double discSeen(const std::vector<Solid>& solids, glm::dvec3 at, glm::dvec3 axis, double angle, int self,
                int rays, std::mt19937& random) {
  const glm::dmat3 frame = frameOf(axis);
  int seen = 0;
  for (int i = 0; i < rays; ++i) {
    const double c = 1 - unit(random) * (1 - std::cos(angle)), s = std::sqrt(1 - c * c);
    const double phi = 2 * std::numbers::pi * unit(random);
    seen += meet(solids, at, frame * glm::dvec3(s * std::cos(phi), s * std::sin(phi), c), self).sphere < 0;
  }
  return double(seen) / rays;
}

}  // namespace weft::theory
