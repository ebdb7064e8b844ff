// A polygon as triangles. Internal to the folder.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace weft::assets {

// Twice its area times its normal: Newell, 1972.
glm::dvec3 areaOf(std::span<const glm::dvec3> polygon);

// Rows of the corners of a polygon that is nearly flat; of a convex one a fan. `work` counts down; when it is used up, all are fans.
std::vector<std::array<std::size_t, 3>> triangulate(std::span<const glm::dvec3> polygon, std::size_t& work);

}  // namespace weft::assets
