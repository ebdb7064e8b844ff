#include "engine/scene/sort.h"

#include <array>
#include <utility>

namespace weft::scene {

// Least significant digit first, three digits of 11 bits: stable, 2 * 8 bytes moved per element and digit. A
// digit that all keys share is skipped.
void sortElements(std::vector<SortElement>& elements, std::vector<SortElement>& scratch) {
  constexpr std::size_t kBuckets = 2048;
  constexpr std::uint32_t kMask = kBuckets - 1;
  std::array<std::array<std::uint32_t, kBuckets>, 3> counts{};
  for (const SortElement& e : elements) {
    ++counts[0][e.key & kMask];
    ++counts[1][(e.key >> 11) & kMask];
    ++counts[2][e.key >> 22];
  }
  scratch.resize(elements.size());
  for (std::size_t digit = 0; digit < 3; ++digit) {
    const std::uint32_t shift = static_cast<std::uint32_t>(digit) * 11;
    std::array<std::uint32_t, kBuckets>& offsets = counts[digit];
    if (elements.empty() || offsets[(elements[0].key >> shift) & kMask] == elements.size()) continue;
    std::uint32_t sum = 0;
    for (std::uint32_t& offset : offsets) sum += std::exchange(offset, sum);
    for (const SortElement& e : elements) scratch[offsets[(e.key >> shift) & kMask]++] = e;
    elements.swap(scratch);
  }
}

float powerOf(glm::vec3 eye, glm::vec3 center, float radius) {
  const glm::vec3 to = center - eye;
  return ((to.x * to.x + to.y * to.y) + to.z * to.z) - radius * radius;
}

void drawOrder(std::span<const Instance> instances, glm::vec3 eye, std::vector<SortElement>& out,
               std::vector<SortElement>& scratch) {
  out.resize(instances.size());
  for (std::size_t i = 0; i < instances.size(); ++i)
    out[i] = {depthKey(powerOf(eye, instances[i].center, instances[i].radius)),
              static_cast<std::uint32_t>(i)};
  sortElements(out, scratch);
}

}  // namespace weft::scene
