#include "tests/theory/neighbors/tracer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::theory {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr int kLongest = 64;  // bounces of a path; white metals that touch keep light between them for long

double uniform(std::mt19937& random) {
  return std::uniform_real_distribution<double>(0, 1)(random);
}

// `axis` is the third column.
glm::dmat3 basisOf(glm::dvec3 axis) {
  const glm::dvec3 side =
      glm::normalize(glm::cross(axis, std::abs(axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
  return {side, glm::cross(axis, side), axis};
}

glm::dvec3 lambertian(std::mt19937& random) {
  const double u = uniform(random), phi = kTurn * uniform(random);
  return {std::sqrt(u) * std::cos(phi), std::sqrt(u) * std::sin(phi), std::sqrt(1 - u)};
}

// Smith's Lambda of GGX (Heitz 2014, equation 72).
double smith(double cosine, double alpha) {
  const double tan2 = std::max(0.0, 1 - cosine * cosine) / (cosine * cosine);
  return (std::sqrt(1 + alpha * alpha * tan2) - 1) / 2;
}

// A half vector with the density of the normals that `v` sees (Heitz, JCGT 2018).
glm::dvec3 visibleNormal(glm::dvec3 v, double alpha, std::mt19937& random) {
  const glm::dmat3 around = basisOf(glm::normalize(glm::dvec3(alpha * v.x, alpha * v.y, v.z)));
  const double r = std::sqrt(uniform(random)), phi = kTurn * uniform(random);
  const double x = r * std::cos(phi), half = 0.5 * (1 + around[2].z);
  // The basis need not have its first axis in the plane z = 0 as long as the disc's lower half is the one that is squeezed.
  const glm::dvec3 flat =
      around[2].z < 0.999999 ? glm::normalize(glm::cross(glm::dvec3(0, 0, 1), around[2])) : around[0];
  const glm::dvec3 up = glm::cross(around[2], flat);
  const double y = (1 - half) * std::sqrt(1 - x * x) + half * r * std::sin(phi);
  const glm::dvec3 n = x * flat + y * up + std::sqrt(std::max(0.0, 1 - x * x - y * y)) * around[2];
  return glm::normalize(glm::dvec3(alpha * n.x, alpha * n.y, std::max(n.z, 0.0)));
}

}  // namespace

MetalTracer::MetalTracer(const Setup& setup)
    : solids_(solidsOf(setup.balls)), sky_(*setup.environment), ground_(setup.ground) {
  for (const Ball& ball : setup.balls) {
    colors_.emplace_back(ball.albedo);
    metals_.push_back(ReflectionOracle::metalOf(double(ball.roughness)));
    diffuse_.push_back(ball.metallic == 0);
  }
}

int MetalTracer::sphereAt(glm::dvec3 from, glm::dvec3 direction) const {
  return meet(solids_, from, direction, -1).sphere;
}

glm::dvec3 MetalTracer::radiance(glm::dvec3 from, glm::dvec3 direction, int paths,
                                 std::mt19937& random) const {
  glm::dvec3 sum(0);
  for (int i = 0; i < paths; ++i) sum += path(from, direction, random);
  return sum / double(paths);
}

// GGX, Smith's height-correlated masking (Heitz 2014), Schlick's Fresnel, and several bounces by Kulla and Conty.
glm::dvec3 MetalTracer::thrown(std::size_t sphere, glm::dvec3 v, glm::dvec3 l) const {
  const glm::dvec3 color = colors_[sphere];
  if (l.z <= 0) return glm::dvec3(0);
  if (diffuse_[sphere]) return color * (l.z / std::numbers::pi);
  const ReflectionOracle::Metal& metal = metals_[sphere];
  const glm::dvec3 h = glm::normalize(v + l), mean = color * (20.0 / 21) + 1.0 / 21;
  const double a2 = metal.alpha * metal.alpha, d = h.z * h.z * (a2 - 1) + 1;
  const double distribution = a2 / (std::numbers::pi * d * d);
  const double single = distribution / (4 * v.z * (1 + smith(v.z, metal.alpha) + smith(l.z, metal.alpha)));
  const double lost = 1 - metal.averageAlbedo;
  const glm::dvec3 several = (1 - metal.albedoAt(v.z)) * (1 - metal.albedoAt(l.z)) / lost * mean * mean *
                             metal.averageAlbedo / (1.0 - mean * lost) * (l.z / std::numbers::pi);
  return (color + (1.0 - color) * std::pow(1 - glm::dot(v, h), 5)) * single + several;
}

glm::dvec3 MetalTracer::brightLight(glm::dvec3 from, int on, glm::dvec3& l, std::mt19937& random) const {
  const auto& bright = sky_.bright();
  if (bright.empty()) return glm::dvec3(0);
  const auto count = static_cast<double>(bright.size());
  const ReflectionOracle::Patch& patch =
      bright[std::min(static_cast<std::size_t>(uniform(random) * count), bright.size() - 1)];
  l = {patch.direction.x, patch.direction.y, patch.direction.z};
  const bool below = ground_ && ground_->albedo && l.y < 0;
  if (below || meet(solids_, from, l, on).sphere >= 0) return glm::dvec3(0);
  return glm::dvec3(patch.light.x, patch.light.y, patch.light.z) * count;
}

glm::dvec3 MetalTracer::path(glm::dvec3 from, glm::dvec3 direction, std::mt19937& random) const {
  glm::dvec3 left(1), sum(0), l;
  int on = -1;
  bool all = true;  // what is bright counts at the path's end: the last place was a mirror, or there was none
  for (int bounce = 0; bounce < kLongest; ++bounce) {
    const Meeting met = meet(solids_, from, direction, on);
    if (ground_ && ground_->albedo && direction.y < 0) {
      const double down = (double(ground_->height) - from.y) / direction.y;
      if (down > 0 && (met.sphere < 0 || down < met.distance)) {
        on = -1;
        left *= glm::dvec3(*ground_->albedo);
        from += direction * down;
        const glm::dvec3 bright = brightLight(from, on, l, random);
        sum += left * bright * (l.y / std::numbers::pi);
        all = false;
        direction = basisOf({0, 1, 0}) * lambertian(random);
        continue;
      }
    }
    if (met.sphere < 0) {
      const Vec3 to = {direction.x, direction.y, direction.z}, light = all ? sky_.lookUp(to) : sky_.dimAt(to);
      return sum + left * glm::dvec3(light.x, light.y, light.z);
    }
    on = met.sphere;
    from += direction * met.distance;
    const auto row = static_cast<std::size_t>(on);
    const ReflectionOracle::Metal& metal = metals_[row];
    const glm::dvec3 color = colors_[row];
    const glm::dmat3 frame = basisOf(glm::normalize(from - solids_[row].center));
    const glm::dvec3 v = glm::transpose(frame) * -direction;
    const double alpha = metal.alpha;
    const bool diffuse = diffuse_[row];
    all = !diffuse && alpha == 0;
    if (!all) {
      const glm::dvec3 bright = brightLight(from, on, l, random);
      if (bright != glm::dvec3(0)) sum += left * bright * thrown(row, v, glm::transpose(frame) * l);
    }
    const auto fresnel = [&](double cosine) { return color + (1.0 - color) * std::pow(1 - cosine, 5); };
    const double several = alpha > 0 ? 0.15 : 0;  // the share of paths that take the term of several bounces
    if (diffuse) {
      l = lambertian(random);
      left *= color;
    } else if (uniform(random) < several) {
      l = lambertian(random);
      const glm::dvec3 mean = color * (20.0 / 21) + 1.0 / 21;
      const double lost = 1 - metal.averageAlbedo;
      left *= (1 - metal.albedoAt(v.z)) * (1 - metal.albedoAt(l.z)) / lost * mean * mean *
              metal.averageAlbedo / (1.0 - mean * lost) / several;
    } else if (alpha > 0) {
      const glm::dvec3 h = visibleNormal(v, alpha, random);
      l = 2 * glm::dot(v, h) * h - v;
      if (l.z <= 0) return sum;
      const double ofView = smith(v.z, alpha);
      left *= fresnel(glm::dot(v, h)) * ((1 + ofView) / (1 + ofView + smith(l.z, alpha))) / (1 - several);
    } else {
      l = {-v.x, -v.y, v.z};
      left *= fresnel(v.z);
    }
    direction = glm::normalize(frame * l);
  }
  return sum;
}

}  // namespace weft::theory
