// FlatGraph: a graph after expansion. Includes, repeats, conditions, alternatives and disabled passes are gone, each
// version with storage of its own is a resource of its own, every size is a number and every name an index. Passes
// stand in declared order, which is always a legal order: a use refers to the latest version before it. compile()
// reads this, in flat arrays. It needs only the first members;
// `specs`, `slots` and the rest are for the executor.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/graph/desc.h"
#include "engine/graph/language/format.h"
#include "engine/graph/registry.h"

namespace weft::graph {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

enum class Target : std::uint8_t {
  texture_2d,
  texture_2d_array,
  texture_cube,
  texture_cube_array,
  texture_3d,
  texture_2d_multisample
};
enum class ResourceKind : std::uint8_t { texture, buffer, imported_texture, imported_buffer };

struct TextureShape {
  Format format = Format::none;
  Target target = Target::texture_2d;
  std::uint8_t samples = 1;
  std::uint16_t layers = 1;  // faces included (6 per cube); 1 for 3D
  std::uint16_t mips = 1;
  std::uint32_t width = 1, height = 1, depth = 1;
  friend bool operator==(const TextureShape&, const TextureShape&) = default;
};

// One storage of a resource. A pass that reads a resource and writes all of it makes another FlatResource ("hdr#2").
struct FlatResource : TextureShape {
  ResourceKind kind = ResourceKind::texture;
  std::uint64_t bytes = 0;   // of one copy, all levels and layers; history multiplies by n + 1
  std::uint8_t history = 0;  // depth n: n + 1 copies, persistent
  // Has a version zero: the first use of a sub-resource in a frame finds it cleared; a `write` then need not cover everything.
  bool hasClear = false;
  std::uint32_t import = kNone;  // index into FlatGraph::imports
  friend bool operator==(const FlatResource&, const FlatResource&) = default;
};

// One access of one pass to a rectangle of sub-resources. Buffers and 3D depth count as one sub-resource.
struct FlatUse {
  std::uint32_t resource = 0;
  std::uint16_t mip = 0, mips = 1, layer = 0, layers = 1;
  std::uint8_t planes = 1;   // bit 0: color or depth, bit 1: stencil (whole depth-stencil: 3)
  std::uint8_t history = 0;  // n of @-n: reads an earlier publication, orders nothing
  Kind kind = Kind::sampled;
  Access access = Access::read;
  bool keep = false;      // a write that stays attached even when nobody reads it
  bool feedback = false;  // modify that also samples its own texel (glTextureBarrier)
  friend bool operator==(const FlatUse&, const FlatUse&) = default;
};

struct FlatPass {
  std::uint32_t firstUse = 0, useCount = 0;
  Cadence cadence = Cadence::always;
  std::uint32_t period = 1;  // of Cadence::every: it runs in frames 0, period, 2 * period, …
  bool sideEffect = false;
  std::uint16_t touches = 0;  // as PassType::touches
  std::uint32_t slices = 1;
};

// `count` sub-resources of a use, in the order of forEachSubresource (subresource.h), that one use wrote.
struct VersionRun {
  std::uint32_t writer = kNone;  // kNone: version zero, an import, or nothing
  std::uint32_t count : 31 = 0;
  std::uint32_t last : 1 = 0;  // of its use
};

// Which use wrote what each use sees. For every sub-resource of a read or modify that is the latest writer in an earlier
// pass, in declared order; for a read of @-n, for `present` and for outputs it is the last writer of all. VersionWalk
// (versions/versions.h) makes the links while passes are expanded or read; checks, liveness, dependencies and
// compile() only read them. A link is one number: the index of the use that wrote all of it; or kNone when no use did,
// and for a write; or kRuns plus the index of the first of several runs.
struct VersionLinks {
  static constexpr std::uint32_t kRuns = 0x80000000u;

  std::vector<std::uint32_t> passOf;  // per use: its pass
  std::vector<std::uint32_t> seen;    // per use: the link
  std::uint32_t present = kNone;
  std::vector<std::uint32_t> outputs;  // links, parallel to FlatGraph::outputs
  std::vector<VersionRun> runs;
  bool forward = false;  // some link of a history leads to its own pass or a later one

  static bool hasRuns(std::uint32_t link) { return link >= kRuns && link != kNone; }

  // Calls f(writer, count) for the runs of a link. The count is 0 when there is only one run, which covers everything.
  template <class F>
  void forEachRun(std::uint32_t link, F&& f) const {
    if (!hasRuns(link)) {
      f(link, 0u);
      return;
    }
    std::size_t at = link & ~kRuns;
    do f(runs[at].writer, std::uint32_t{runs[at].count});
    while (runs[at++].last == 0);
  }
  // Calls f(writer) for each use that wrote some of it. A writer may come more than once.
  template <class F>
  void forEachWriter(std::uint32_t link, F&& f) const {
    forEachRun(link, [&](std::uint32_t writer, std::uint32_t) {
      if (writer != kNone) f(writer);
    });
  }
};

// ---- carried for the executor -------------------------------------------------------------------------------------

// A declared slot of a pass instance. Slots that are not connected have useCount 0 (compiled without HAS_<NAME>).
struct SlotSpec : SlotHead {
  std::uint32_t firstUse = 0;  // into FlatGraph::uses
  std::uint32_t useCount = 0;  // more than one: an array of samplers, elements in order
  // Of a read of @-n: the use of what `first` names, which is bound while the n-th publication before is not there. kNone:
  // `first` is a value.
  std::uint32_t firstValue = kNone;
  std::uint32_t border = kNone;  // into FlatGraph::borders; kNone: zeros
  Kind kind = Kind::sampled;
  Sampler sampler;
  bool array = false;  // true when the resource was declared with "array", even of one element
  bool optional = false;
};

// A parameter of a pass, or an element of one: of an array, or a column of a matrix.
struct UniformSpec {
  std::string name;
  std::uint32_t element = kNone, elements = 0;  // which, of how many; kNone: the whole
  Value value;                                  // with the present parameters; age() counts as 0
  // Absent: the value never changes while the plan runs. Else the folded expression, in which age() (by FlatResource index),
  // live parameters (by index into FlatGraph::parameters) and values of imports (WatchedValue) are left.
  Expr dynamic;
  std::string path;  // full name of the parameter behind it ("post.dof.aperture"), or empty
  Place place;
  bool constant = false;  // written as a number or a list
  bool isFirst() const { return element == kNone || element == 0; }
  std::string text() const { return element == kNone ? name : name + "[" + std::to_string(element) + "]"; }
};

struct DefineSpec {
  std::string name, text;  // #define name text; a choice CURVE adds CURVE_<CHOICE> for all its choices
  friend bool operator==(const DefineSpec&, const DefineSpec&) = default;
};

// clang-format off
enum class BlendFactor : std::uint8_t {
  zero, one, src_color, one_minus_src_color, dst_color, one_minus_dst_color,
  src_alpha, one_minus_src_alpha, dst_alpha, one_minus_dst_alpha,
  constant_color, one_minus_constant_color, constant_alpha, one_minus_constant_alpha, src_alpha_saturate
};
enum class StencilOp : std::uint8_t {
  keep, zero, replace, increment, increment_wrap, decrement, decrement_wrap, invert
};
// clang-format on
enum class BlendEquation : std::uint8_t { add, subtract, reverse_subtract, min, max };
// Of red, green and blue, or of alpha. As it is made, nothing is blended.
struct BlendPart {
  BlendFactor source = BlendFactor::one, destination = BlendFactor::zero;
  BlendEquation equation = BlendEquation::add;
  friend bool operator==(const BlendPart&, const BlendPart&) = default;
};
struct Blend {
  BlendPart color, alpha;
  friend bool operator==(const Blend&, const Blend&) = default;
};
// The words for whole blends, in the order of the schema: none, add, alpha, premultiplied, multiply, min, max.
constexpr std::array<Blend, 7> kBlends = [] {
  using enum BlendFactor;
  using enum BlendEquation;
  constexpr BlendPart over{one, one_minus_src_alpha}, sum{one, one}, product{dst_color, zero};
  return std::array<Blend, 7>{{{},
                               {sum, sum},
                               {{src_alpha, one_minus_src_alpha}, over},
                               {over, over},
                               {product, product},
                               {{one, one, min}, {one, one, min}},
                               {{one, one, max}, {one, one, max}}}};
}();
enum class Cull : std::uint8_t { none, front, back };

// Of a color slot.
struct ColorState {
  Blend blend;
  std::uint8_t mask = 15;  // bits 0 to 3: red, green, blue and alpha are written
  friend bool operator==(const ColorState&, const ColorState&) = default;
};

struct StencilFace {
  Compare test = Compare::always;
  StencilOp fail = StencilOp::keep, depthFail = StencilOp::keep, pass = StencilOp::keep;
  bool writes() const {
    return fail != StencilOp::keep || depthFail != StencilOp::keep || pass != StencilOp::keep;
  }
  friend bool operator==(const StencilFace&, const StencilFace&) = default;
};
struct StencilState {
  StencilFace front, back;
  std::uint8_t reference = 0, readMask = 255, writeMask = 255;
  bool writes() const { return writeMask != 0 && (front.writes() || back.writes()); }
  friend bool operator==(const StencilState&, const StencilState&) = default;
};

struct StateSpec {
  std::vector<std::pair<std::string, ColorState>> colors;  // of the slots that "state" names, or of all
  std::array<double, 4> blendColor{};
  std::optional<StencilState> stencil;
  std::optional<std::array<std::int32_t, 4>> viewport;  // x, y, width, height; absent: all of the attachment
  std::optional<std::uint32_t> sampleMask;
  bool alphaToCoverage = false, depthClamp = false;
  bool depthTest = false;
  Compare depthCompare = Compare::always;
  bool depthWrite = true;  // only with a depth test and a writable depth attachment
  Cull cull = Cull::none;
  bool lines = false;  // polygon: line
  double offsetFactor = 0, offsetUnits = 0;
  friend bool operator==(const StateSpec&, const StateSpec&) = default;
};

struct PassSpec : PassHead {
  std::string name;      // full instance name: "bloom.glow_down[3]"
  std::string declared;  // without the index: "bloom.glow_down"
  std::uint32_t firstSlot = 0, slotCount = 0;
  std::vector<DefineSpec> defines;
  std::vector<UniformSpec> uniforms;
  StateSpec state;
  std::uint32_t threads[3] = {1, 1, 1};
  Place threadsPlace;                     // of "threads", else of the pass
  std::uint32_t instances = 1;            // of a draw without a list
  Expr timedInstances;                    // the same, folded, when it contains age(); else absent
  std::array<std::uint32_t, 2> raster{};  // of a pass without attachments, in texels; else 0
  std::uint8_t rasterSamples = 1;
  bool indirect = false;             // the command takes its arguments from a buffer
  std::uint32_t draws = 1;           // records of it, of a draw
  std::uint32_t listImport = kNone;  // of the graph's own: import index
  std::vector<double> geometryArguments;
  bool meshes = false;                        // as GeometryType::meshes
  std::array<std::uint32_t, 2> screen{1, 1};  // pixels: what `screen` means in its file, which cameras see
  std::uint32_t view = kNone;                 // import index; kNone: the default camera
  std::uint16_t viewLayer = 0, viewFace = 0;
};

struct ImportSpec {
  ImportRequest request;
  std::uint64_t key = 0;  // keyOf(request)
  ImportKind kind = ImportKind::texture;
  std::string name;                   // resource name in the graph, or "@environment"
  std::vector<TableColumn> columns;   // as ImportType::columns
  std::vector<std::string> standIns;  // names of own textures that a list of alternatives offers in its place
  double count = 0;                   // rows of a list or buffer, as ImportFacts::count
  bool changing = false;              // as ImportFacts::changing
  std::string_view fallback{};        // as ImportFacts::fallback, of one that does not exist
  Place place{};                      // of its declaration; without a file for one that is named only as @x
};

// A name of the files that has no resource of its own: a list of alternatives, an input, an import that is declared again
// under another name. For people; nothing runs by it.
struct AliasSpec {
  std::string name;  // "post.luminance"
  Place place;
  std::vector<std::string> texts;    // the alternatives as written, conditions included; empty for the others
  std::vector<std::string> targets;  // the names they stand for: resources, imports or other aliases
};

// What a parameter is now.
struct ParameterState {
  std::string path;                     // full name: "post.exposure", "post.dof.aperture"
  Value value;                          // after --set
  Origin origin = Origin::declaration;  // of the value
  Where valuePlace;                     // where it was written; nowhere when a panel set it
  // A size, condition, define, repeat, state or import depends on it: a change makes another plan, not other uniforms.
  bool structural = false;
};
struct ParameterSpec : ParameterState {
  ParameterDesc desc;
};

struct HistorySpec {  // per FlatResource with history > 0
  std::uint32_t resource = 0;
  Value first;
  FlatUse firstUse{.resource = kNone};  // what is read in its place; of no resource when `first` is a value
  std::vector<std::uint32_t> resetImports;    // imports whose change resets it ("@cut", camera)
  std::vector<std::uint32_t> resetResources;  // resources whose new version resets it
  std::vector<Value> resetValues;             // a change of any resets it
};

struct ClearSpec {
  std::uint32_t resource = 0;
  Value value;
};

struct DisabledPass {
  std::string name;
  std::string why;      // "--disable fxaa", "enabled: $bloom is false"
  bool absent = false;  // a level or layer that it uses is not there at this size
};

// A value of an import that parameters follow while the plan runs. In folded expressions its key is its index here plus the number
// of parameters.
struct WatchedValue {
  std::uint32_t import = 0, row = 0;
  std::uint32_t column = 0;         // into ImportType::columns
  std::uint8_t part = kWholeValue;  // as ImportValue
  Value shape;                      // any value of that type; of a part, a column
};

struct FlatGraph {
  // the compiler's input
  std::vector<FlatPass> passes;  // declared order
  std::vector<FlatUse> uses;     // grouped by pass, in slot order
  std::vector<FlatResource> resources;
  FlatUse present;               // resource kNone: nothing
  std::vector<FlatUse> outputs;  // read-backs; which read as passes do
  VersionLinks links;
  // names and places, parallel to passes and resources
  std::vector<std::string> passNames, resourceNames;
  std::vector<Place> resourcePlaces;  // of their declarations; may be empty
  // the executor's
  std::vector<PassSpec> specs;  // parallel to passes, or empty
  std::vector<SlotSpec> slots;
  std::vector<BorderColor> borders;  // of slots that have one
  std::vector<ImportSpec> imports;
  std::vector<ParameterSpec> parameters;
  std::vector<WatchedValue> watched;
  std::vector<HistorySpec> histories;
  std::vector<ClearSpec> clears;         // values of version zero
  std::vector<std::string> outputNames;  // parallel to outputs
  std::vector<DisabledPass> disabled;
  std::vector<AliasSpec> aliases;
  std::vector<std::string> files;  // to watch
  std::string name;
  std::uint32_t screenWidth = 0, screenHeight = 0;

  // The uses of a pass, as indices into `uses`.
  auto usesOf(std::uint32_t pass) const {
    return std::views::iota(passes[pass].firstUse, passes[pass].firstUse + passes[pass].useCount);
  }

  std::span<const SlotSpec> slotsOf(const PassSpec& spec) const {
    return std::span(slots).subspan(spec.firstSlot, spec.slotCount);
  }
  // Not an optional one that is empty.
  bool hasSlot(const PassSpec& spec, std::string_view called) const {
    return std::ranges::any_of(slotsOf(spec),
                               [&](const SlotSpec& s) { return s.useCount && s.name == called; });
  }

  // Calls f(use, source) for each pass that wrote some of what a use of `pass` sees.
  template <class F>
  void forEachSource(std::uint32_t pass, F&& f) const {
    for (const std::uint32_t u : usesOf(pass))
      links.forEachWriter(links.seen[u], [&](std::uint32_t writer) { f(u, links.passOf[writer]); });
  }

  BorderColor borderOf(const SlotSpec& slot) const {
    return slot.border == kNone ? BorderColor{} : borders[slot.border];
  }
};

}  // namespace weft::graph
