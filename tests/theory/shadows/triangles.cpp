#include "tests/theory/shadows/triangles.h"

#include <algorithm>
#include <cmath>

namespace weft::theory {

Triangles::Triangles(const scene::Scene& scene) {
  constexpr double kAround = 1e-6;  // so that no ray misses a box by rounding
  for (const scene::MeshInstance& instance : scene.meshInstances.rows()) {
    const scene::Mesh& mesh = *scene.meshes.find(instance.mesh);
    const glm::dvec3 moved(scene.nodes.find(instance.node)->local.translation);
    Mesh made{.low = glm::dvec3(1e30), .high = glm::dvec3(-1e30), .first = triangles_.size()};
    const auto corner = [&](std::uint32_t i) {
      const glm::dvec3 at =
          moved +
          glm::dvec3(scene.meshData->vertices[mesh.firstVertex + scene.meshData->indices[mesh.firstIndex + i]]
                         .position);
      made.low = glm::min(made.low, at - kAround);
      made.high = glm::max(made.high, at + kAround);
      return at;
    };
    for (std::uint32_t i = 0; i < mesh.indexCount; i += 3) {
      const glm::dvec3 a = corner(i), b = corner(i + 1), c = corner(i + 2);
      triangles_.push_back({a, b - a, c - a});
    }
    made.end = triangles_.size();
    meshes_.push_back(made);
  }
}

// Calls visit(distance, triangle), which returns up to where the ray goes on. By Cramer's rule for the two edges and the ray.
template <typename Visit>
void Triangles::forMet(glm::dvec3 from, glm::dvec3 way, const Visit& visit) const {
  double nearest = 1e30;
  const glm::dvec3 inverse = 1.0 / way;
  for (const Mesh& mesh : meshes_) {
    const glm::dvec3 a = (mesh.low - from) * inverse, b = (mesh.high - from) * inverse,
                     enter = glm::min(a, b), leave = glm::max(a, b);
    if (std::max({enter.x, enter.y, enter.z, 0.0}) > std::min({leave.x, leave.y, leave.z, nearest})) continue;
    for (std::size_t i = mesh.first; i < mesh.end; ++i) {
      const Triangle& triangle = triangles_[i];
      const glm::dvec3 p = glm::cross(way, triangle.two);
      const double determinant = glm::dot(triangle.one, p);
      if (std::abs(determinant) < 1e-12) continue;
      const glm::dvec3 s = from - triangle.a, q = glm::cross(s, triangle.one);
      const double u = glm::dot(s, p) / determinant, v = glm::dot(way, q) / determinant,
                   distance = glm::dot(triangle.two, q) / determinant;
      if (u < 0 || v < 0 || u + v > 1 || distance <= 0 || distance >= nearest) continue;
      nearest = visit(distance, triangle);
      if (nearest <= 0) return;
    }
  }
}

Hit Triangles::meet(glm::dvec3 from, glm::dvec3 way) const {
  Hit hit;
  forMet(from, way, [&](double distance, const Triangle& triangle) {
    hit = {distance, glm::cross(triangle.one, triangle.two)};
    return distance;
  });
  if (hit.distance < 1e30) hit.normal = glm::normalize(hit.normal);
  return hit;
}

bool Triangles::meetsAny(glm::dvec3 from, glm::dvec3 way) const {
  bool met = false;
  forMet(from, way, [&](double, const Triangle&) {
    met = true;
    return 0.0;
  });
  return met;
}

}  // namespace weft::theory
