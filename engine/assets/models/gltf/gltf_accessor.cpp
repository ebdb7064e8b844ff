#include "engine/assets/models/gltf/gltf_accessor.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace weft::assets {

namespace {

template <class T>
T load(const char* data) {
  T value;
  std::memcpy(&value, data, sizeof value);
  return value;
}

// Calls with each element's bytes, sparse ones included.
template <class Use>
void eachElement(const GltfAccessor& a, const Use& use) {
  if (a.data)
    for (std::size_t i = 0; i < a.count; ++i) use(i, a.data + i * a.stride);
  const std::size_t indexBytes = bytesOfType(a.sparseType), valueBytes = bytesOfType(a.type) * a.components;
  for (std::size_t i = 0; i < a.sparse; ++i)
    use(static_cast<std::size_t>(componentAt(a.sparseIndices + i * indexBytes, a.sparseType, false)),
        a.sparseValues + i * valueBytes);
}

}  // namespace

std::size_t bytesOfType(int type) {
  switch (type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      return 0;
  }
}

std::uint32_t componentsOf(std::string_view kind) {
  constexpr std::pair<std::string_view, std::uint32_t> kKinds[] = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
  for (const auto& [name, count] : kKinds)
    if (name == kind) return count;
  return 0;
}

double componentAt(const char* data, int type, bool normalized) {
  switch (type) {
    case 5120:
      return normalized ? std::max(load<std::int8_t>(data) / 127.0, -1.0) : load<std::int8_t>(data);
    case 5121:
      return load<std::uint8_t>(data) / (normalized ? 255.0 : 1.0);
    case 5122:
      return normalized ? std::max(load<std::int16_t>(data) / 32767.0, -1.0) : load<std::int16_t>(data);
    case 5123:
      return load<std::uint16_t>(data) / (normalized ? 65535.0 : 1.0);
    case 5125:
      return load<std::uint32_t>(data);
    default:
      return static_cast<double>(load<float>(data));
  }
}

std::vector<float> readFloats(const GltfAccessor& a) {
  std::vector<float> out(std::size_t{a.count} * a.components, 0);
  const std::size_t step = bytesOfType(a.type);
  eachElement(a, [&](std::size_t i, const char* element) {
    for (std::size_t c = 0; c < a.components; ++c)
      out[i * a.components + c] = static_cast<float>(componentAt(element + c * step, a.type, a.normalized));
  });
  return out;
}

std::vector<std::uint32_t> readWhole(const GltfAccessor& a) {
  std::vector<std::uint32_t> out(std::size_t{a.count} * a.components, 0);
  const std::size_t step = bytesOfType(a.type);
  eachElement(a, [&](std::size_t i, const char* element) {
    for (std::size_t c = 0; c < a.components; ++c)
      out[i * a.components + c] = static_cast<std::uint32_t>(componentAt(element + c * step, a.type, false));
  });
  return out;
}

}  // namespace weft::assets
