// Metal and diffuse spheres that reflect one another and a diffuse ground, by paths through the definitions in double precision: GGX,
// Smith's height-correlated masking, Schlick's Fresnel, what several bounces within a surface add by Kulla and Conty
// ("Revisiting physically based shading at Imageworks", SIGGRAPH 2017 courses). Paths end in an environment map; what
// is bright there also lights each place on the way but mirrors. Shares nothing with the shaders. Does not: know GL,
// lamps, or the gloss of dielectrics.
#pragma once

#include <glm/glm.hpp>
#include <random>
#include <vector>

#include "tests/theory/lab.h"
#include "tests/theory/neighbors/oracle.h"
#include "tests/theory/reflection/oracle.h"

namespace weft::theory {

class MetalTracer {
 public:
  // Of the setup: balls (metals, or diffuse ones where `metallic` is 0), environment and ground. A ground's surface has no end.
  explicit MetalTracer(const Setup& setup);

  // The sphere that the ray meets first, -1: none. Goes past the ground.
  int sphereAt(glm::dvec3 from, glm::dvec3 direction) const;
  // Mean radiance of `paths` paths that begin with this ray.
  glm::dvec3 radiance(glm::dvec3 from, glm::dvec3 direction, int paths, std::mt19937& random) const;

 private:
  // What a surface leaves towards `v` of light from `l`, times the cosine. Both are in its frame: z is its normal.
  glm::dvec3 thrown(std::size_t sphere, glm::dvec3 v, glm::dvec3 l) const;
  // What a place gets of one part of what is bright, chosen by chance, over that chance; `l` goes there.
  glm::dvec3 brightLight(glm::dvec3 from, int on, glm::dvec3& l, std::mt19937& random) const;
  glm::dvec3 path(glm::dvec3 from, glm::dvec3 direction, std::mt19937& random) const;

  std::vector<Solid> solids_;
  std::vector<glm::dvec3> colors_;
  std::vector<ReflectionOracle::Metal> metals_;
  std::vector<bool> diffuse_;
  ReflectionOracle sky_;
  std::optional<scene::Ground> ground_;
};

}  // namespace weft::theory
