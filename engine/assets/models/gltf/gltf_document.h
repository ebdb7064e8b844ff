// A glTF 2.0 file before anything is made of it: its JSON, its buffers, and accessors that lie in them. .gltf and .glb. Every index
// and range is judged before it is used. The first mistake is reported with its place (W164 for a file that is no such document,
// W165 for a value that cannot be) and thrown as Refused, which readGltf() catches. Khronos, "glTF 2.0 Specification". Internal
// to the folder.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/assets/model.h"
#include "engine/assets/models/parts/model_files.h"
#include "engine/text/json/dom.h"

namespace weft::assets {

struct Refused {};

// Its elements lie in a buffer.
struct GltfAccessor {
  const text::JsonValue* row = nullptr;
  std::uint32_t count = 0, components = 0;
  int type = 0;  // componentType: 5120 to 5126
  bool normalized = false;
  const char* data = nullptr;  // null: zeros
  std::size_t stride = 0;
};

// Calls `work` with a number of a componentType.
template <class Work>
auto withComponent(int type, const Work& work) {
  if (type == 5120) return work(std::int8_t{});
  if (type == 5121) return work(std::uint8_t{});
  if (type == 5122) return work(std::int16_t{});
  if (type == 5123) return work(std::uint16_t{});
  return type == 5125 ? work(std::uint32_t{}) : work(float{});
}

// The value at the end of these keys, or null.
const text::JsonValue* valueOf(const text::JsonValue& object, std::initializer_list<std::string_view> keys);
// The items of an array; empty when there is none.
const std::vector<text::JsonValue>& itemsOf(const text::JsonValue& object, std::string_view key);
std::string textOf(const text::JsonValue& object, std::string_view key, std::string otherwise = "");

class GltfDocument {
 public:
  GltfDocument(std::string bytes, ModelFiles& files);
  GltfDocument(const GltfDocument&) = delete;
  GltfDocument& operator=(const GltfDocument&) = delete;

  const text::JsonValue& root() const { return root_; }
  // The rows of a table at the top, "nodes"; empty when there is none.
  const std::vector<text::JsonValue>& rows(std::string_view table) const { return itemsOf(root_, table); }

  // A member that must be there.
  const text::JsonValue& need(const text::JsonValue& object, std::string_view key);
  // An index into a table of `count` rows, which messages call `table`; or into one at the top.
  std::uint32_t index(std::string_view table, std::size_t count, const text::JsonValue& value);
  std::uint32_t index(std::string_view table, const text::JsonValue& value) {
    return index(table, rows(table).size(), value);
  }
  // The number at the end of these keys, or `otherwise`.
  float number(const text::JsonValue& object, std::initializer_list<std::string_view> keys, double otherwise,
               double min, double max);
  // Reads as many numbers as `out` has, within ±1e9; false when the key is absent.
  bool numbers(const text::JsonValue& object, std::string_view key, std::span<float> out);

  // An accessor of this kind ("VEC3"), of floats or numbers of 8 or 16 bits where `floats`, else of unsigned whole numbers.
  GltfAccessor accessor(const text::JsonValue& index, std::string_view kind, bool floats);
  // count * components numbers: T is float, or std::uint32_t for unsigned whole ones. A normalized one is from -1 or 0 to 1.
  template <class T>
  std::vector<T> read(const GltfAccessor& accessor);
  // Gives the accessors of a primitive that Draco packed their bytes. KHR_draco_mesh_compression.
  void unpackDraco(const text::JsonValue& primitive);

  struct View {
    std::string_view bytes;
    std::size_t stride = 0;
  };
  View view(const text::JsonValue& index);

  // Ends the reading where `good` is not, after an error that was reported already.
  static void refuseUnless(bool good) {
    if (!good) throw Refused{};
  }
  template <class... Args>
  [[noreturn]] void fail(text::Saying<Args...> what, const text::JsonValue& where, Args&&... args) {
    pointTo(where, diagnostics_.error<Args...>(what, where.place, std::forward<Args>(args)...));
    throw Refused{};
  }
  // W168
  template <class... Args>
  void leaveOut(text::Saying<Args...> what, const text::JsonValue& where, Args&&... args) {
    pointTo(where, diagnostics_.warning<Args...>(what, where.place, std::forward<Args>(args)...));
  }

 private:
  void pointTo(const text::JsonValue& where, text::Diagnostic& said) {
    said.pointer = text::pointerAt(root_, where.begin);
  }
  [[noreturn]] void failFile(std::string_view why, std::string expected, std::string found);
  std::string_view split(std::string_view bytes, std::string_view& binary);
  void checkExtensions();
  std::string unpackMeshopt(const text::JsonValue& packed);
  std::string readBuffer(const text::JsonValue& row, std::string_view binary);
  // A whole number that a file can hold; 0 where it is absent.
  std::uint64_t whole(const text::JsonValue& object, std::string_view key);

  ModelFiles& files_;
  text::Diagnostics& diagnostics_;
  text::JsonValue root_;
  std::vector<std::string> buffers_;
  std::map<std::size_t, std::string> views_, accessors_;  // by row: what was packed
};

// Which uv set maps of a material are looked up with, and how they are moved: KHR_texture_transform. A material has one or two,
// because a vertex has two uv; maps that want a third are left out, with W168.
struct GltfUv {
  std::uint32_t set = 0;
  std::array<float, 2> offset{0, 0}, scale{1, 1};
  float rotation = 0;  // radians
  friend bool operator==(const GltfUv&, const GltfUv&) = default;
};
using GltfUvs = std::vector<GltfUv>;

// Puts the materials of a document, and one more for meshes without, into the model; the uvs of each. `made`: of a file of another format.
std::vector<GltfUvs> readMaterials(GltfDocument& document, ModelFiles& files, Model& model, bool made);

// The file as a Model; `made`: it was made of one of another format, whose paths may be those of another machine and whose
// vertices are one for each corner. Left out, with W168: points and lines, further uv sets, a second sun, extensions
// that are not known. False after errors, or when the load was stopped.
bool readGltf(std::string bytes, ModelFiles& files, Model& model, bool made = false);

}  // namespace weft::assets
