// What a white metal reflects of an environment map, by brute force from the definition: GGX, Smith's height-correlated
// masking, Fresnel 1, and what several bounces add by Kulla and Conty ("Revisiting physically based shading at
// Imageworks", SIGGRAPH 2017 courses). Shares nothing with the shaders. Does not: know GL, or prefilter anything.
#pragma once

#include <memory>
#include <vector>

#include "engine/assets/images/image.h"
#include "tests/theory/oracle.h"

namespace weft::theory {

class ReflectionOracle {
 public:
  // The map as decoded, RGB or RGBA, values beyond half floats included. Linear between texels, except that what
  // a texel has above `kBright` counts as light of the texel's own area.
  explicit ReflectionOracle(const assets::ImageF& map);

  // Directional albedo of a roughness, and the environment's light weighted by what it leaves.
  struct Metal {
    double roughness = 0, alpha = 0;
    std::vector<double> albedo;  // over the cosine, at i / (size - 1)
    double averageAlbedo = 1;
    double albedoAt(double cosine) const;
  };
  static Metal metalOf(double roughness);

  // Radiance towards `view` (unit, away from the surface) at a point with `normal`, both in the world.
  // `samples` half vectors of the set `set`: sets are independent of each other. A set may be shared by `parts` points
  // that belong together (a pixel's): each takes its own part.
  Vec3 radiance(Vec3 normal, Vec3 view, const Metal& metal, int samples, unsigned set, int part = 0,
                int parts = 1) const;
  // The share of it that several bounces give; smooth, so one value serves a whole pixel.
  Vec3 severalBounces(Vec3 normal, Vec3 view, const Metal& metal) const;
  Vec3 lookUp(Vec3 direction) const;  // with what is above kBright
  Vec3 dimAt(Vec3 direction) const;   // without it

  static constexpr float kBright = 30;
  struct Patch {
    Vec3 direction, light;  // radiance times solid angle
  };
  const std::vector<Patch>& bright() const { return bright_; }  // what is above kBright

 private:
  struct alignas(16) Texel {
    float r, g, b;
  };
  // Between four texels of dim_.
  struct Place {
    const Texel *upper_left, *upper_right, *lower_left, *lower_right;
    double x, y;
  };
  Place placeOf(Vec3 direction) const;
  static Vec3 between(const Place& place);

  int width_ = 0, height_ = 0;
  std::vector<Texel> dim_, whole_;  // up to kBright; everything
  std::vector<Patch> bright_;       // above it
  std::vector<Patch> coarse_;       // dim_, in cells
};

// Weft's measure of a difference: of 255, after x / (1 + x) and gamma 2.2.
double shownOf255(double radiance);

}  // namespace weft::theory
