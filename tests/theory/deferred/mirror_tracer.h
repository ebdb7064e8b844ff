// A path tracer of one bounce for scenes of triangles and spheres whose materials emit or are metals: GGX, Smith's height-correlated
// masking and Schlick's Fresnel by the definition. Shares nothing with the shaders. Does not: let a metal that
// is reflected show anything but the sky.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "engine/scene/scene.h"

namespace weft::theory {

class MirrorTracer {
 public:
  using Sky = std::function<glm::dvec3(glm::dvec3)>;
  MirrorTracer(const scene::Scene& scene, const scene::CameraPose& pose, std::uint32_t width,
               std::uint32_t height, Sky sky);

  // Of a pixel whose center sees a metal, row 0 at the bottom; what else it sees has no `metal`.
  struct Pixel {
    bool metal = false;
    bool sphere = false;        // ray-traced, not of triangles
    std::uint32_t surface = 0;  // its instance or sphere
    glm::dvec3 radiance{0};     // by `rays` rays of its lobe
  };
  Pixel pixel(std::uint32_t x, std::uint32_t y, int rays) const;

 private:
  struct Triangle {
    glm::dvec3 a, ab, ac;
    glm::dvec3 normals[3];
    std::uint32_t surface, material;
  };
  struct Ball {
    glm::dvec3 center;
    double radius;
    std::uint32_t surface, material;
  };
  struct Box {
    glm::dvec3 low{1e30}, high{-1e30};
  };
  struct Branch {
    Box box;
    std::uint32_t first = 0, count = 0, right = 0;  // count 0: a branch, its left follows
  };
  struct Met {
    double away = 1e30;  // that is nothing
    glm::dvec3 normal{0};
    std::uint32_t surface = 0, material = 0;
    bool sphere = false;
  };
  struct Bounce {
    glm::dvec3 direction{0, 1, 0}, weight{0};
  };
  std::uint32_t build(std::uint32_t first, std::uint32_t count);
  Met meet(glm::dvec3 from, glm::dvec3 direction) const;
  static Bounce bounceOf(const scene::Material& metal, glm::dvec3 n, glm::dvec3 v, double u, double around);
  glm::dvec3 severalAt(std::uint32_t material, double nv) const;

  std::vector<Triangle> triangles_;
  std::vector<Ball> balls_;
  std::vector<Branch> branches_;
  std::vector<scene::Material> materials_;
  static constexpr int kCosines = 16;
  std::vector<std::array<double, kCosines>>
      single_;  // of each material, were it white: its albedo in one bounce
  glm::dvec3 eye_, right_, up_, forward_;
  double slope_;
  std::uint32_t width_, height_;
  Sky sky_;
};

}  // namespace weft::theory
