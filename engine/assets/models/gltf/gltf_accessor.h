// Elements of a glTF accessor: bytes to numbers. What strays was refused before (engine/assets/models/gltf/gltf_document.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace weft::assets {

// An accessor whose every element lies in its buffer.
struct GltfAccessor {
  std::uint32_t count = 0, components = 0;
  int type = 0;  // componentType: 5120 to 5126
  bool normalized = false;
  std::string kind;            // "VEC3"
  const char* data = nullptr;  // null: zeros
  std::size_t stride = 0;
  std::uint32_t sparse = 0;  // elements that stand elsewhere
  int sparseType = 0;
  const char *sparseIndices = nullptr, *sparseValues = nullptr;
};

std::size_t bytesOfType(int componentType);         // 0 for no type
std::uint32_t componentsOf(std::string_view kind);  // 0 for no kind
// One component as a number; a normalised one is from -1 or 0 to 1.
double componentAt(const char* data, int type, bool normalized);

std::vector<float> readFloats(const GltfAccessor& accessor);         // count * components
std::vector<std::uint32_t> readWhole(const GltfAccessor& accessor);  // the same, of unsigned whole numbers

}  // namespace weft::assets
