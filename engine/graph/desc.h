// GraphDesc: what a graph file says, file by file, with the place of everything. Nothing is resolved, expanded or
// checked against anything outside the file. Plain aggregates. readGraph (read.h) makes it, expandGraph (expand.h)
// reads it.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/graph/language/expr.h"
#include "engine/text/diagnostic.h"

namespace weft::graph {

using text::Place;
using text::Where;

// How a pass touches a resource.
enum class Access : std::uint8_t { read, write, modify };
// What the hardware does with it: docs/graph-format.md, "References".
enum class Kind : std::uint8_t { sampled, image, uniform, storage, indirect, color, depth, copy };
enum class Cadence : std::uint8_t { always, on_change, once, every };

// What a lookup outside 0..1 finds: the texel at the edge, the texture again, its mirror image, or a BorderColor.
enum class Wrap : std::uint8_t { clamp, repeat, mirror, border };

enum class Compare : std::uint8_t {
  never,
  less,
  equal,
  less_equal,
  greater,
  not_equal,
  greater_equal,
  always
};
using BorderColor = std::array<float, 4>;

struct Sampler {
  bool linear = false;      // else nearest; with more than one level the levels are filtered the same way
  Wrap wrap = Wrap::clamp;  // in s, t and r
  bool compare = false;     // depth comparison; implies linear
  std::optional<Compare> function;  // of the comparison; absent: that of the depth test that made the map
  friend bool operator==(const Sampler&, const Sampler&) = default;
};

// `a..b` inside a selector; both ends inclusive; absent ends mean the first and the last.
struct SpanDesc {
  Expr first, last;
  bool range = false;  // false: `first` alone
};

// A reference: name, selectors, @-n, `as` words, `if` condition, ?
struct RefDesc {
  std::string text;  // as written
  Place place;
  std::string name;                                   // dotted, without the leading @
  bool import = false;                                // written with @
  std::optional<SpanDesc> mip, layer, face, element;  // the last, [k], is no range
  bool stencil = false;
  int history = 0;                           // n of @-n
  std::optional<Kind> kind;                  // `as depth`
  bool samples = false;                      // the words say how it is sampled:
  Sampler sampler;                           // `as linear wrap`
  BorderColor border{};                      // `as border(…)`
  Expr condition;                            // `if …` of an alternative; absent means true
  bool optional = false;                     // trailing ?, or what it names is an optional input
  std::uint32_t wordsAt = 0, wordsSize = 0;  // of "as linear wrap", in `text`
  std::string_view words() const { return std::string_view(text).substr(wordsAt, wordsSize); }
  bool selects() const { return mip || layer || face || element || stencil; }
};

struct ParameterDesc {
  enum class Type : std::uint8_t { boolean, integer, number, vec2, vec3, vec4, choice, file };
  std::string name;
  Place place;
  Type type = Type::number;
  Value initial;
  Place initialPlace;  // of the default's value, perhaps in an overlay
  std::optional<double> min, max, step;
  std::string label, doc;
  std::vector<std::string> choices;
  bool define = false;  // selects a variant instead of being a uniform
};

struct NamedExpr {
  std::string name;
  Place place;  // of the name
  Expr expr;
};

struct ImportDesc {
  std::string type;  // "probes", "camera", "draw_order"
  std::vector<NamedExpr> arguments;
};

struct ResourceDesc {
  enum class Kind : std::uint8_t { texture, buffer, import, input, alternatives };
  std::string name;
  Place place;
  Kind kind = Kind::texture;
  // texture
  Expr format;                  // its name, as a word
  Expr size;                    // number or list of 2 (or 3: a 3D texture), texels
  Expr mips;                    // absent: 1
  bool fullMips = false;        // "mips": "full"
  Expr layers, array, samples;  // absent: none
  std::string view;             // "", "2d_array", "cube", "cube_array", "3d"
  Place viewPlace;
  // buffer
  Expr bytes;
  // all but alternatives
  std::optional<RefDesc> sample;  // how, unless a slot says; of an input as written, "hdr as linear"
  // both; an input has history, first and reset
  Expr clear;                       // version zero
  Expr history;                     // depth n, absent: 0
  Expr first;                       // what @-n holds before n publications
  std::optional<RefDesc> firstRef;  // a texture or buffer that is read in its place until then
  std::vector<RefDesc> resetRefs;   // "@cut", "camera if $progressive"
  std::vector<Expr> resetValues;    // "size(hdr)"
  // others
  ImportDesc import;
  bool optional = false;  // of an input
  std::vector<RefDesc> alternatives;
};

// What a stanza says of a slot as it is.
struct SlotHead {
  std::string name;
  Place place;  // of its key
  Access access = Access::read;
  bool ofSet = false;  // other passes may have it, too
};

struct SlotDesc : SlotHead {
  RefDesc ref;
};

struct RangeDesc {
  std::string index;
  Place place;
  Expr first, last, step;  // step absent: 1
};

// A pass parameter is either a value computed by the graph or a parameter declared on the spot.
struct PassParameterDesc {
  std::string name;
  Place place;
  Expr value;               // when not declared
  std::vector<Expr> items;  // in its place: of an array, or the columns of a matrix
  std::optional<ParameterDesc> declared;
  // Its expressions, whichever it has.
  std::span<const Expr> values() const { return items.empty() ? std::span(&value, 1) : std::span(items); }
};

struct IncludeDesc {
  std::string file;  // as written, relative to the including file
  Place filePlace;
  std::string as;  // prefix; never empty after reading
  std::vector<std::pair<std::string, RefDesc>> binds;
  std::vector<Place> bindPlaces;                  // parallel: of the keys
  Expr screen;                                    // what `screen` is there; absent: as outside
  std::shared_ptr<const struct GraphDesc> graph;  // null when it could not be read
};

// A set that a pass names in "use": what it holds is among the slots, parameters, defines and state of the pass.
struct UsedSet {
  std::string name;
  Place place;     // in "use"
  Place declared;  // of its key under "sets"
};

// What a stanza says of a pass as it is: each instance of it has the same.
struct PassHead {
  Place place;  // of the stanza's opening brace
  std::string type;
  std::string shader;  // a path; of a draw the stem of two, or the fragment shader beside `vertexShader`
  std::string vertexShader;  // of a draw that names both
  Place shaderPlace;
  std::string list;      // draw list or ""
  std::string geometry;  // "quad", "mesh", "icosphere"
};

struct PassDesc : PassHead {
  std::string name;  // for an include: its prefix
  Place namePlace;
  std::vector<UsedSet> uses;
  std::optional<IncludeDesc> include;
  Place typePlace;
  Expr enabled;  // absent: true
  std::vector<RangeDesc> repeat;
  // Of the group that it stands in: its brace, and how many ranges are the group's, which come first. Neighbors of one group go
  // through those together.
  Place group{};
  std::size_t looped = 0;
  std::vector<SlotDesc> slots;  // in file order
  std::vector<PassParameterDesc> parameters;
  std::vector<NamedExpr> defines;
  std::vector<NamedExpr> state;  // "cull", "blend" (all slots), "blend.radiance" (one slot), …
  Cadence cadence = Cadence::always;
  Expr period;  // of Cadence::every: frames
  Expr slices, threads, instances, draws, raster, samples, screen;
  Place listPlace;
  std::vector<Expr> geometryArguments;
  Place geometryPlace;
  std::optional<RefDesc> view;
  bool feedback = false;
  bool sideEffect = false;
};

struct OutputDesc {
  std::string name;
  RefDesc ref;
};

// Where the value of a parameter was written.
enum class Origin : std::uint8_t { declaration, file, overlay, preset, command_line, panel };
// "preset", "command line".
constexpr const char* wordFor(Origin origin) {
  constexpr const char* kWords[] = {"default", "file", "overlay", "preset", "command line", "panel"};
  return kWords[static_cast<std::size_t>(origin)];
}

// A value that a file, or an overlay on it, gives to a parameter of its own or of a file that it includes.
struct SetDesc {
  std::string name;  // any unique suffix
  Origin origin = Origin::file;
  Place place;
  Place valuePlace;
  Value value;
};

// A pass or include that an overlay removed: a read of what it would write says so.
struct RemovedPass {
  std::string name;
  Place place;                      // in the overlay
  std::vector<std::string> writes;  // names of resources, as written
};

// What an overlay names to change it: a parameter, let or resource by a key, a pass or include by a string.
struct NamedDesc {
  std::string name;  // whole, from the file that the overlays lie over
  Place place;       // in the overlay, of the opening quote
  Place declared;    // of the opening quote of its declaration
};

// Files by path, as they were read.
using FileTexts = std::map<std::string, std::shared_ptr<const std::string>>;

// A file with what is laid over it.
struct FileDesc {
  std::string path;                  // as opened; "" for text without a file
  std::vector<std::string> files;    // itself, what it extends, its presets
  std::vector<RemovedPass> removed;  // by overlays
  std::vector<NamedDesc> named;      // by overlays
  std::string top;  // the overlay or preset that lies over all others; "" when nothing lies over this file
};

// Its `files` have all that is below, too: to watch.
struct GraphDesc : FileDesc {
  std::string name;
  Place place;
  std::vector<ParameterDesc> parameters;
  std::vector<NamedExpr> lets;
  std::vector<ResourceDesc> resources;
  std::vector<std::pair<std::string, Place>> slotSets;  // "sets", with the places of their keys
  std::vector<PassDesc> passes;
  std::optional<RefDesc> present;
  std::vector<OutputDesc> outputs;
  std::vector<SetDesc> sets;        // in order: the last wins
  std::vector<std::string> unread;  // declared names that were reported: a use is no second error
  FileTexts texts;                  // of the graph that was asked for: all its files; included ones: some
};

// What a person names to look at in a graph that runs: engine/graph/pick/pick.h.
struct Pick {
  std::string text;           // as written
  std::string name;           // of a resource, or any unique suffix: "hdr", "maps[2]"
  std::uint32_t version = 0;  // k of #k, from 1; 0: the last
  std::uint32_t mip = 0;
  std::uint32_t layer = 0;    // array layer, cube * 6 + face, or slice of a 3D texture
  std::uint32_t history = 0;  // n of @-n
  bool stencil = false;
  std::string pass;      // after which to look, or any unique suffix; "": the last that writes it
  std::string option{};  // that names it, for messages: "-o"
  friend bool operator==(const Pick&, const Pick&) = default;
};

}  // namespace weft::graph
