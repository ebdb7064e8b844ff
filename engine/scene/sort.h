// Back-to-front draw order on the CPU, and the contract it shares with shaders/spheres/sort/order.glsl.
//
// What is compared, d, in float, in exactly this order without fused operations (`precise` in GLSL), is the power of the eye:
//   d = ((x * x + y * y) + z * z) - r * r, with (x, y, z) = center - eye: the squared length of a tangent from the eye.
// Of two spheres that do not meet, the one with the greater power is never before the other: the plane in which both powers
// are equal lies between them, and the eye is on the nearer one's side of it (Aurenhammer, "Power diagrams", SIAM J. Comput. 1987).
// Key, a uint, of *descending* d (farthest first when sorted ascending):
//   d is NaN  -> 0xffffffff (last);     d == 0 -> d = +0 (so that -0 equals +0)
//   b = floatBitsToUint(d);   u = (b & 0x80000000) != 0 ? ~b : b | 0x80000000;   key = ~u
// Elements are (key, index), sorted ascending by key, then by index. Padding of the GPU sort is
// (0xffffffff, i) with i >= count: it follows every real element, NaN included.
#pragma once

#include <bit>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/scene/scene.h"

namespace weft::scene {

struct SortElement {  // uvec2 of the GPU buffer
  std::uint32_t key = 0, index = 0;
  friend auto operator<=>(const SortElement&, const SortElement&) = default;
};

constexpr std::uint32_t depthKey(float depth) {
  if (depth != depth) return 0xffffffffu;
  const std::uint32_t bits = depth == 0 ? 0u : std::bit_cast<std::uint32_t>(depth);
  return ~((bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u);
}
float powerOf(glm::vec3 eye, glm::vec3 center, float radius);

// Sorts by (key, index) ascending; `elements` must come with ascending indices, because only the keys are compared. `scratch` is
// working memory, reused from call to call.
void sortElements(std::vector<SortElement>& elements, std::vector<SortElement>& scratch);

// Replaces `out` by the elements of the instances, sorted.
void drawOrder(std::span<const Instance> instances, glm::vec3 eye, std::vector<SortElement>& out,
               std::vector<SortElement>& scratch);

}  // namespace weft::scene
