// What spheres do to each other's light, from the definitions in double precision: rays against spheres, paths that end
// in the sky. Shares nothing with the shaders. Does not: know GL, or any closed form.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <random>
#include <vector>

#include "tests/theory/lab.h"

namespace weft::theory {

struct Solid {
  glm::dvec3 center;
  double radius = 1, albedo = 0;
};
std::vector<Solid> solidsOf(const std::vector<Ball>& balls);

// The nearest sphere that a ray meets, but for sphere `self`, on which it begins; -1: none. -1 as `self`: all count.
struct Meeting {
  int sphere = -1;
  double distance = 0;
};
Meeting meet(const std::vector<Solid>& solids, glm::dvec3 from, glm::dvec3 direction, int self);

// Share of directions, weighted by the cosine, in which a point of sphere `self` sees none: side x side strata.
double skySeen(const std::vector<Solid>& solids, glm::dvec3 at, glm::dvec3 normal, int self, int side,
               std::mt19937& random);

// Irradiance over pi of a point of sphere `self`, all spheres diffuse, by paths that end in `sky`. With `floor` there is
// a diffuse plane y = 0 of that albedo.
using Sky = std::function<double(glm::dvec3 direction)>;
double tracedLight(const std::vector<Solid>& solids, glm::dvec3 at, glm::dvec3 normal, int self,
                   const Sky& sky, int paths, std::mt19937& random, std::optional<double> floor = {});

// Share of a GGX lobe (the BRDF of a white mirror times the cosine) in which a point sees none, towards `view`.
double lobeSeen(const std::vector<Solid>& solids, glm::dvec3 at, glm::dvec3 normal, glm::dvec3 view,
                double roughness, int self, int rays, std::mt19937& random);

// Share of a disc of `angle` radians around `axis` in which a point sees none.
double discSeen(const std::vector<Solid>& solids, glm::dvec3 at, glm::dvec3 axis, double angle, int self,
                int rays, std::mt19937& random);

}  // namespace weft::theory
