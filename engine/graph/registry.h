// What the graph core must know of pass types (engine/passes reflects them) and of imports (engine/imports does). It is
// plain data, so that a graph can be checked without a device.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/graph/desc.h"
#include "engine/graph/language/format.h"
#include "engine/text/diagnostic.h"

namespace weft::graph {

// One bit per glMemoryBarrier bit that a plan can need (OpenGL 4.5 core, 7.12.2). Which access needs which is
// compile/hazards.cpp; the runtime maps them to GL enums.
enum BarrierBit : std::uint16_t {
  kBarrierUniform = 1 << 0,        // UNIFORM
  kBarrierTexture = 1 << 1,        // TEXTURE_FETCH
  kBarrierImage = 1 << 2,          // SHADER_IMAGE_ACCESS
  kBarrierCommand = 1 << 3,        // COMMAND
  kBarrierTextureUpdate = 1 << 4,  // TEXTURE_UPDATE: clears and sub-image writes
  kBarrierBufferUpdate = 1 << 5,   // BUFFER_UPDATE: buffer clears and copies
  kBarrierFramebuffer = 1 << 6,    // FRAMEBUFFER: attachments, blits, read-back of textures
  kBarrierStorage = 1 << 7,        // SHADER_STORAGE
};
constexpr int kBarrierBitCount = 8;
constexpr const char* barrierName(BarrierBit bit) {
  constexpr std::array<const char*, kBarrierBitCount> kNames = {
      "uniform",        "texture_fetch", "image_access", "command",
      "texture_update", "buffer_update", "framebuffer",  "shader_storage"};
  return kNames[static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(bit)))];
}

enum class ShaderShape : std::uint8_t { none, fragment, compute, draw };

struct FixedSlot {  // for pass types without a shader (blit, mipmap)
  enum class Takes : std::uint8_t { texture, buffer, either };
  std::string name;
  Access access = Access::read;
  std::string doc;
  Takes takes = Takes::texture;
};

struct PassType {
  std::string name;  // "fullscreen"
  std::string doc;   // one paragraph
  ShaderShape shader = ShaderShape::none;
  Kind defaultReadTexture = Kind::sampled;
  Kind defaultWriteTexture = Kind::color;  // a depth format becomes Kind::depth when this is color
  std::vector<std::string> keys;  // pass keys it takes besides those every pass takes: "threads", "list", …
  std::vector<FixedSlot> fixedSlots;  // empty: slots are the author's
  // For types without a shader. `framebuffers`: the slots are bound as framebuffers, as a blit needs.
  // `fromSource`: the view of the written texture begins at the level that is read.
  bool framebuffers = false, fromSource = false;
  bool indirect = false;  // takes a buffer as the arguments of its command
  // Barrier bits (BarrierBit) that the GL command needs besides those of its slots' kinds, on the ranges that the slots
  // name, because it touches them in a way that no slot says.
  std::uint16_t touches = 0;
};

enum class ImportKind : std::uint8_t { texture, buffer, view, list, event };

struct ImportArgument {
  std::string name;
  Value initial;  // default; type none means required
  std::vector<std::string> choices;
  std::string doc;
  bool drawList = false;  // a word that names a draw list
  bool view = false;      // a word that names a view; empty: that of the file's passes that name none
  bool ofMeshes = false;  // of a draw list: says something of its meshes only
};

// A field of the rows of a table that shaders read as an array of structs, by name.
struct TableColumn {
  std::string name;  // "center"
  std::string type;  // as GLSL spells it: "vec3"
  std::string doc;   // with its unit
};

struct ImportType {
  std::string name;  // "environment", "spheres", "camera", "cut"
  ImportKind kind = ImportKind::texture;
  std::string doc;
  std::vector<ImportArgument> arguments;
  // Values of it, which parameters name, as "@lamps[0].color". Of buffers: rows, laid out as the reading shader's block says.
  std::vector<TableColumn> columns{};
  std::uint32_t array = 0;  // of textures: this many in one slot, as resources with "array"; see elementOf()
  bool views = false;       // of buffers: its elements are views as well: @lamps[l].face[f]
  bool everyPass = false;   // of views: one under the type's name is that of every pass that names none
};

// An import with its arguments evaluated. Two requests with equal type and arguments are one import.
struct ImportRequest {
  std::string type;
  // In the order of ImportType::arguments, defaults filled in.
  std::vector<std::pair<std::string, Value>> arguments{};
  // Draw lists and views that the graph declares, by the arguments that name them.
  std::vector<std::pair<std::string, ImportRequest>> of{};
  const Value& at(std::string_view argument) const;             // one that the type has
  const ImportRequest* named(std::string_view argument) const;  // null: it names none of these
  friend bool operator==(const ImportRequest&, const ImportRequest&) = default;
};
// A hash of the request, by which an import is found again without comparing words.
std::uint64_t keyOf(const ImportRequest& request);
// Which texture a request stands for, where the type has `array`: the last argument, which expansion adds, else 0.
std::uint32_t elementOf(const ImportRequest& request);

// What is known of an import before anything runs.
struct ImportFacts {
  bool exists = false;  // false: has() is 0, `?` slots lose it, alternatives skip it
  // A graph whose picture stands in for a texture that does not exist, so that reads need no `?`: a path from the folder that
  // holds graphs/, which lives as long as the program.
  std::string_view fallback{};
  Format format = Format::none;  // textures
  std::uint32_t width = 1, height = 1, depth = 1, layers = 1, mips = 1;
  bool layered = false;                      // an array texture, also with one layer
  std::uint64_t bytes = 0;                   // buffers; 0 when not yet known
  double count = 0;                          // count(x): rows of a list or buffer
  bool changing = false;                     // something else in the course of a run, whatever the scene is
  std::vector<text::Diagnostic> problems{};  // reported with the import; an error makes it unusable
};

// A whole number between the parentheses of a geometry: "icosphere(3)".
struct GeometryArgument {
  std::string name;
  int min = 0, max = 0;
  int initial = 0;  // when it is left out
};

struct GeometryType {
  std::string name;
  std::vector<GeometryArgument> arguments;
  bool meshes = false;     // draws the meshes of a draw list, each with its own vertices
  int counted = 0;         // above 0, its argument is how many vertices an instance has: a multiple of this
  bool indexed = false;    // has indices
  std::string attributes;  // of its vertices, by the names of the shader's inputs: "position, normal"
};

struct Registry {
  std::vector<PassType> passTypes;
  std::vector<ImportType> imports;
  std::vector<std::string> drawLists;  // of every scene: "spheres", "opaque", …
  struct Things {
    std::vector<std::string> lists;  // in which they stand
    std::uint64_t count = 0;
  };
  std::vector<Things> things;            // of the scene, where it says another list than is usual for them
  std::vector<GeometryType> geometries;  // "quad", "icosphere", "mesh", "triangle"
  std::function<ImportFacts(const ImportRequest&)> factsOf;
};

// The thing of that name, of a list; null when there is none.
template <class Things>
auto* findNamed(Things& things, std::string_view name) {
  const auto found = std::ranges::find_if(things, [&](const auto& each) { return each.name == name; });
  return found == things.end() ? nullptr : &*found;
}

// The plug-ins of one kind that an engine knows, pass types or imports, by the name that each reflects.
template <class PlugIn>
class PlugIns {
 public:
  void add(std::unique_ptr<PlugIn> plugIn) {
    std::string name = plugIn->reflect().name;
    assert(!find(name) && "a plug-in of this name is already registered");
    entries_.emplace_back(std::move(name), std::move(plugIn));
  }
  // Null for a name that is unknown.
  const PlugIn* find(std::string_view name) const {
    for (const auto& [known, plugIn] : entries_)
      if (known == name) return plugIn.get();
    return nullptr;
  }
  auto reflect() const {
    std::vector<decltype(std::declval<const PlugIn&>().reflect())> all;
    for (const auto& [name, plugIn] : entries_) all.push_back(plugIn->reflect());
    return all;
  }

 private:
  std::vector<std::pair<std::string, std::unique_ptr<PlugIn>>> entries_;
};

}  // namespace weft::graph
