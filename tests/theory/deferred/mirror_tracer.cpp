#include "tests/theory/deferred/mirror_tracer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::theory {

namespace {

constexpr double kNear = 1e-5, kFar = 1e30;

glm::dmat4 worldOf(const scene::Scene& scene, scene::NodeId id) {
  const scene::Node& node = *scene.nodes.find(id);
  const glm::dmat4 own = glm::dmat4(scene::matrixOf(node.local)) * glm::dmat4(glm::dmat3(node.inner));
  return node.parent.valid() ? worldOf(scene, node.parent) * own : own;
}

bool hits(glm::dvec3 low, glm::dvec3 high, glm::dvec3 from, glm::dvec3 inverse, double nearest) {
  const glm::dvec3 a = (low - from) * inverse, b = (high - from) * inverse, enter = glm::min(a, b),
                   leave = glm::max(a, b);
  const double first = std::max({enter.x, enter.y, enter.z, 0.0}),
               last = std::min({leave.x, leave.y, leave.z, nearest});
  return first <= last;
}

double radicalInverse(std::uint32_t i, std::uint32_t base) {
  double value = 0, digit = 1.0 / base;
  for (; i > 0; i /= base, digit /= base) value += digit * (i % base);
  return value;
}

}  // namespace

MirrorTracer::MirrorTracer(const scene::Scene& scene, const scene::CameraPose& pose, std::uint32_t width,
                           std::uint32_t height, Sky sky)
    : eye_(pose.position), width_(width), height_(height), sky_(std::move(sky)) {
  forward_ = glm::normalize(glm::dvec3(pose.target) - eye_);
  right_ = glm::normalize(glm::cross(forward_, glm::dvec3(0, 1, 0)));
  up_ = glm::cross(right_, forward_);
  slope_ = std::tan(pose.fovDegrees * std::numbers::pi / 360);
  std::uint32_t surface = 0;
  const auto keep = [&](scene::MaterialId id) {
    materials_.push_back(*scene.materials.find(id));
    return static_cast<std::uint32_t>(materials_.size() - 1);
  };
  for (const scene::MeshInstance& instance : scene.meshInstances.rows()) {
    const scene::Mesh& mesh = *scene.meshes.find(instance.mesh);
    const glm::dmat4 world = worldOf(scene, instance.node);
    const glm::dmat3 turn = glm::transpose(glm::inverse(glm::dmat3(world)));
    const std::uint32_t material = keep(instance.material);
    for (std::uint32_t i = 0; i < mesh.indexCount; i += 3) {
      glm::dvec3 at[3];
      Triangle made{};
      for (std::uint32_t corner = 0; corner < 3; ++corner) {
        const auto& vertex =
            scene.meshData
                ->vertices[mesh.firstVertex + scene.meshData->indices[mesh.firstIndex + i + corner]];
        at[corner] = world * glm::dvec4(vertex.position, 1);
        made.normals[corner] = glm::normalize(turn * glm::dvec3(vertex.normal));
      }
      made.a = at[0], made.ab = at[1] - at[0], made.ac = at[2] - at[0];
      made.surface = surface, made.material = material;
      triangles_.push_back(made);
    }
    ++surface;
  }
  for (const scene::Sphere& sphere : scene.spheres.rows())
    balls_.push_back({sphere.center, sphere.radius, surface++, keep(sphere.material)});
  for (scene::Material white : materials_) {
    white.albedo = glm::vec3(1);
    std::array<double, kCosines>& single = single_.emplace_back();
    for (int i = 0; i < kCosines; ++i)
      for (int ray = 0; ray < 256; ++ray) {
        const double cosine = (i + 0.5) / kCosines;
        const glm::dvec3 v(std::sqrt(1 - cosine * cosine), 0, cosine);
        single[i] += bounceOf(white, {0, 0, 1}, v, (ray + 0.5) / 256, radicalInverse(ray, 2)).weight.x / 256;
      }
  }
  if (!triangles_.empty()) build(0, static_cast<std::uint32_t>(triangles_.size()));
}

std::uint32_t MirrorTracer::build(std::uint32_t first, std::uint32_t count) {
  const auto self = static_cast<std::uint32_t>(branches_.size());
  branches_.emplace_back();
  Box box, middles;
  const auto middleOf = [](const Triangle& t) { return t.a + (t.ab + t.ac) / 3.0; };
  for (std::uint32_t i = first; i < first + count; ++i) {
    const Triangle& t = triangles_[i];
    for (const glm::dvec3 corner : {t.a, t.a + t.ab, t.a + t.ac})
      box.low = glm::min(box.low, corner), box.high = glm::max(box.high, corner);
    middles.low = glm::min(middles.low, middleOf(t)), middles.high = glm::max(middles.high, middleOf(t));
  }
  branches_[self].box = box;
  if (count <= 6) {
    branches_[self].first = first, branches_[self].count = count;
    return self;
  }
  const glm::dvec3 size = middles.high - middles.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto begin = triangles_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count, [&](const Triangle& a, const Triangle& b) {
    return middleOf(a)[axis] < middleOf(b)[axis];
  });
  build(first, count / 2);
  branches_[self].right = build(first + count / 2, count - count / 2);
  return self;
}

MirrorTracer::Met MirrorTracer::meet(glm::dvec3 from, glm::dvec3 direction) const {
  Met met;
  for (const Ball& ball : balls_) {
    const glm::dvec3 to = ball.center - from;
    const double along = glm::dot(to, direction),
                 root2 = ball.radius * ball.radius - glm::dot(to, to) + along * along;
    const double away = along - std::sqrt(std::max(root2, 0.0));
    if (root2 < 0 || away < kNear || away >= met.away) continue;
    met = {away, glm::normalize(direction * away - to), ball.surface, ball.material, true};
  }
  if (branches_.empty()) return met;
  const glm::dvec3 inverse = 1.0 / direction;
  std::vector<std::uint32_t> open{0};
  while (!open.empty()) {
    const std::uint32_t at = open.back();
    const Branch& branch = branches_[at];
    open.pop_back();
    if (!hits(branch.box.low, branch.box.high, from, inverse, met.away)) continue;
    if (branch.count == 0) {
      open.push_back(branch.right);
      open.push_back(at + 1);
    }
    for (std::uint32_t i = branch.first; i < branch.first + branch.count; ++i) {
      const Triangle& t = triangles_[i];
      const glm::dvec3 p = glm::cross(direction, t.ac), s = from - t.a, q = glm::cross(s, t.ab);
      const double determinant = glm::dot(t.ab, p);
      if (determinant < 1e-14) continue;  // its back
      const double u = glm::dot(s, p) / determinant, v = glm::dot(direction, q) / determinant;
      const double away = glm::dot(t.ac, q) / determinant;
      if (u < 0 || v < 0 || u + v > 1 || away < kNear || away >= met.away) continue;
      met = {away, glm::normalize(t.normals[0] * (1 - u - v) + t.normals[1] * u + t.normals[2] * v),
             t.surface, t.material, false};
    }
  }
  return met;
}

MirrorTracer::Bounce MirrorTracer::bounceOf(const scene::Material& metal, glm::dvec3 n, glm::dvec3 v,
                                            double u, double around) {
  const double alpha = std::max(static_cast<double>(metal.roughness) * metal.roughness, 1e-4);
  const glm::dvec3 axis = std::abs(n.x) < 0.8 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 side = glm::normalize(glm::cross(n, axis)), across = glm::cross(n, side);
  const auto lambda = [&](double cosine) {
    return 0.5 * (std::sqrt(1 + alpha * alpha * (1 / (cosine * cosine) - 1)) - 1);
  };
  // Half vectors by the distribution times the cosine; the weight is the rest of the reflectance.
  const double tangent = alpha * std::sqrt(u / (1 - u)), cosine = 1 / std::sqrt(1 + tangent * tangent);
  const double turn = 2 * std::numbers::pi * around;
  const glm::dvec3 h = cosine * (n + tangent * (std::cos(turn) * side + std::sin(turn) * across));
  const double vh = glm::dot(v, h), nv = glm::dot(n, v);
  const glm::dvec3 l = 2 * vh * h - v;
  const double nl = glm::dot(n, l);
  if (nv <= 0 || vh <= 0 || nl <= 0) return {};
  const glm::dvec3 f0(metal.albedo), fresnel = f0 + (1.0 - f0) * std::pow(1 - vh, 5);
  return {l, fresnel * (vh / (cosine * nv) / (1 + lambda(nv) + lambda(nl)))};
}

MirrorTracer::Pixel MirrorTracer::pixel(std::uint32_t x, std::uint32_t y, int rays) const {
  const double ndcX = 2 * (x + 0.5) / width_ - 1, ndcY = 2 * (y + 0.5) / height_ - 1;
  const glm::dvec3 ray = glm::normalize(forward_ + slope_ * (ndcX * width_ / height_ * right_ + ndcY * up_));
  const Met met = meet(eye_, ray);
  Pixel pixel;
  if (met.away >= kFar) return pixel;
  pixel.surface = met.surface;
  pixel.metal = !materials_[met.material].blinnPhong;
  pixel.sphere = met.sphere;
  if (!pixel.metal) return pixel;
  const glm::dvec3 from = eye_ + ray * met.away + met.normal * 1e-4;
  const auto lightFrom = [&](glm::dvec3 direction, std::uint32_t number) {
    const Met other = meet(from, direction);
    if (other.away >= kFar) return sky_(direction);
    if (materials_[other.material].blinnPhong) return glm::dvec3(materials_[other.material].emissive);
    const Bounce second = bounceOf(materials_[other.material], other.normal, -direction,
                                   radicalInverse(number, 3), radicalInverse(number, 5));
    return second.weight * sky_(second.direction);
  };
  glm::dvec3 several(0);  // the mean light of the hemisphere
  for (int i = 0; i < rays; ++i) {
    const auto number = static_cast<std::uint32_t>(i);
    const Bounce first =
        bounceOf(materials_[met.material], met.normal, -ray, (i + 0.5) / rays, radicalInverse(number, 2));
    if (first.weight != glm::dvec3(0))
      pixel.radiance += first.weight * lightFrom(first.direction, number) / (1.0 * rays);
    if (rays == 1) continue;
    const double turn = 2 * std::numbers::pi * radicalInverse(number, 3), z = 1 - 2 * (i + 0.5) / rays,
                 r = std::sqrt(1 - z * z);
    const glm::dvec3 cosine =
        glm::normalize(met.normal + glm::dvec3(r * std::cos(turn), r * std::sin(turn), z));
    several += lightFrom(cosine, number) / (1.0 * rays);
  }
  if (rays > 1) pixel.radiance += several * severalAt(met.material, glm::dot(met.normal, -ray));
  return pixel;
}

// Kulla and Conty, "Revisiting physically based shading at Imageworks", SIGGRAPH 2017 courses: what leaves after more than
// one bounce on a microsurface.
glm::dvec3 MirrorTracer::severalAt(std::uint32_t material, double nv) const {
  const std::array<double, kCosines>& single = single_[material];
  double mean = 0;
  for (int i = 0; i < kCosines; ++i) mean += single[i] * (2 * i + 1) / (kCosines * kCosines);
  const glm::dvec3 fresnel = glm::dvec3(materials_[material].albedo) * (20.0 / 21) + 1.0 / 21;
  const double there = single[std::clamp(static_cast<int>(nv * kCosines), 0, kCosines - 1)];
  return (1 - there) * fresnel * fresnel * mean / (1.0 - fresnel * (1 - mean));
}

}  // namespace weft::theory
