// A glTF 2.0 file before anything is made of it: its JSON, its buffers, and accessors that are known to lie in them. .gltf
// and .glb. What is wrong has a place in the JSON: W164 for a file that is no such document, W165 for a value that cannot
// be. Nothing that is reached through here strays: every index and range is judged before it is used. Khronos, "glTF 2.0
// Specification". Does not: know nodes, meshes or materials.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/assets/model.h"
#include "engine/assets/models/parts/model_files.h"
#include "engine/base/json/dom.h"

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

class GltfDocument {
 public:
  GltfDocument(ModelFiles& files, base::Diagnostics& diagnostics)
      : files_(files), diagnostics_(diagnostics) {}
  GltfDocument(const GltfDocument&) = delete;
  GltfDocument& operator=(const GltfDocument&) = delete;

  // False after errors.
  bool open(std::string bytes);

  const base::JsonValue& root() const { return *root_; }
  // The rows of a table at the top, "nodes"; empty when there is none.
  const std::vector<base::JsonValue>& rows(std::string_view table) const;

  // An index into a table: absent when `value` is null; W165 when there is no such row.
  std::optional<std::uint32_t> index(std::string_view table, const base::JsonValue* value);
  // The same for a table elsewhere, such as an extension's; `table` is what a message calls it.
  std::optional<std::uint32_t> indexOf(std::string_view table, std::size_t count,
                                       const base::JsonValue& value);
  // A number of an object, or `otherwise`; W165 outside the range.
  double number(const base::JsonValue& object, std::string_view key, double otherwise, double min,
                double max);
  // Reads `count` numbers, within ±1e9; false after W165 or when the key is absent.
  bool numbers(const base::JsonValue& object, std::string_view key, std::size_t count, float* out);
  std::string text(const base::JsonValue& object, std::string_view key) const;

  // W165 when the accessor is of another kind ("VEC3"), or has no float or normalised components where `floats`.
  const GltfAccessor* accessor(const base::JsonValue* index, std::string_view kind, bool floats);

  // The bytes of a buffer view; empty after an error.
  std::optional<std::string_view> view(const base::JsonValue* index);

  // "VEC3"; "" where the index is none. Nothing is said.
  std::string_view kindOf(const base::JsonValue& accessor) const;

  base::Diagnostic& fail(const base::JsonValue& where, std::string message);      // W165
  base::Diagnostic& leaveOut(const base::JsonValue& where, std::string message);  // W168

 private:
  bool split(std::string_view bytes, std::string_view& json, std::string_view& binary);
  bool readBuffers(std::string_view binary);
  bool readViews();
  bool readAccessors();
  bool readAccessor(const base::JsonValue& value);
  bool readSparse(const base::JsonValue& value, GltfAccessor& accessor, std::size_t elementBytes);
  bool checkExtensions();
  // A whole number that a file can hold; W165 otherwise.
  std::optional<std::uint64_t> whole(const base::JsonValue& object, std::string_view key,
                                     std::uint64_t otherwise);

  ModelFiles& files_;
  base::Diagnostics& diagnostics_;
  std::optional<base::JsonValue> root_;
  std::vector<std::string> buffers_;
  struct View {
    std::string_view bytes;
    std::size_t stride = 0;
  };
  std::vector<View> views_;
  std::vector<GltfAccessor> accessors_;
};

}  // namespace weft::assets
