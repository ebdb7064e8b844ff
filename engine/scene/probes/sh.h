// Real spherical harmonics up to band 2, and what of them a cap of constant radiance has in closed form. Order of the nine:
// Y00, Y1-1 (y), Y10 (z), Y11 (x), Y2-2 (xy), Y2-1 (yz), Y20 (3zz - 1), Y21 (xz), Y22 (xx - yy), as in Ramamoorthi and
// Hanrahan, "An Efficient Representation for Irradiance Environment Maps", SIGGRAPH 2001. shaders/gi/sh.glsl has the same.
// Does not: know spheres, probes or where they stand.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>

namespace weft::scene {

constexpr std::size_t kShCount = 9;
constexpr float kPi = 3.14159265358979f;

// The functions in a unit direction.
std::array<float, kShCount> shBasis(glm::vec3 direction);

// The factor of each band from radiance to irradiance, the cosine lobe: pi, 2 pi / 3, pi / 4.
constexpr glm::vec3 kCosineLobe{kPi, kPi * 2 / 3, kPi / 4};

// Radiance 1 in a cone around a direction w whose half angle has this sine (0..1, at most a right angle): the coefficient
// (l, m) of it is component l of this times Y_lm(w). Its zonal harmonics, turned to w.
glm::vec3 capBands(float sine);
// The same of a point that lights a surface facing it as much as the cone does: all of its light comes from w.
glm::vec3 pointBands(float sine);

}  // namespace weft::scene
