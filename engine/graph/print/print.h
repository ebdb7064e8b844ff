// The forms in which a plan is printed. Equal plans give equal text.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/graph/compile/compile.h"
#include "engine/graph/plan.h"
#include "engine/graph/registry.h"
#include "engine/text/diagnostic.h"

namespace weft::graph {

// The canonical text of a plan: order, barrier bits, clears, framebuffers, storage and who shares it, bytes, culled passes.
// Fit to be committed as a golden and to be read by a person. With `explain`, each pass, barrier bit and storage says why
// (Explainer); that form is for reading, not for goldens.
std::string dumpText(const Plan& plan, bool explain = false);

// JSON for tools: {"name", "bytes", "steps", "culled", "storages", "resources", "final_barriers"}. With `explain`, passes,
// barriers and resources have a "why".
std::string dumpJson(const Plan& plan, bool explain = false);

// A Graphviz graph, for `dot -Tsvg`: passes as boxes, those of an include in a box of its own and repeats as one, culled ones gray;
// an ellipse for each version of a resource, green for what no pass makes; histories dashed. With `effects`, each include of the graph
// is one box, with the versions that others read.
std::string dumpDot(const Plan& plan, bool effects = false);

// A line for each difference: passes added, removed and moved, barrier bits, textures and bytes; "" when the plans do the
// same. Passes and resources are the same when their names are. Pictures and shaders are not compared.
std::string diffText(const Plan& before, const Plan& after);

// Everything that `name` means: the pass or its repeats, the resource and its versions, the parameter. `name` is any unique
// suffix. Nothing after a report: unknown (W045, with the nearest) or ambiguous (W046).
std::optional<std::string> describe(const Plan& plan, std::string_view name, text::Diagnostics& diagnostics);
// What a pass, called by its whole name without an index, does with a slot, parameter or define; "" when it has none.
std::string describeInPass(const Plan& plan, std::string_view pass, std::string_view name);

// What a texture of a format can be used for in a graph, as OpenGL 4.5 promises.
struct FormatUses {
  bool attachment = false;  // a pass renders to it, as color or depth
  bool blended = false;     // with "blend"
  bool filtered = false;    // "as linear"
  bool image = false;       // image load and store; the layout qualifier of GLSL is the format's name
};
FormatUses usesOf(Format format);

// A line for each format that a graph may name, below a heading: name, bytes of a texel, channels, what they hold, uses; of an image
// the layout qualifier.
std::string formatTable();

// Why a plan is as it is: why a pass runs or was culled, why a barrier has its bits, why two textures share. Computed when
// asked, from the plan alone. Also the words that all printed forms share. Sentences are for people, and equal for equal
// plans.

class Explainer {
 public:
  // `plan` must outlive the explainer.
  explicit Explainer(const Plan& plan);

  // "runs: 'composite' reads 'hdr'" / "culled: nobody reads 'velocity'" …
  std::string whyPass(std::uint32_t pass) const;
  // "after 'sky' (reads 'hdr'), 'sort' (reads 'keys')": what must run before it, "" when nothing
  std::string whyHere(std::uint32_t pass) const;
  // "shared with 'a' (steps 0..2)" / "its own: history of 1" …
  std::string whyStorage(std::uint32_t resource) const;
  // "image_access: 'a' writes 'x' as image, then 'b' reads 'x' as image": one text for each bit of the barriers of a step
  std::vector<std::string> whyBarriers(std::uint32_t step, bool afterClears) const;

 private:
  const Plan& plan_;
  const FlatGraph& graph_;
  std::vector<Dependency> edges_;  // over all passes, culled ones too
  std::vector<BarrierReason> reasons_;
};

// "hdr.mip[2]", "maps.layer[0..3]", "depth.stencil", "taa@-1": a use as a person would write it.
std::string textOf(const FlatGraph& graph, const FlatUse& use);
// What an import is, its arguments and its columns: "@lamps", then a line each, two spaces further in.
std::string textOf(const ImportType& type);
nlohmann::ordered_json jsonOf(const Value& value);
// "texture rgba16f 64x64, 3 levels, 32768 bytes"
std::string shapeText(const FlatResource& resource);
const char* nameOf(Target target);
// "on_change", "every(4)".
std::string updateOf(const FlatPass& pass);

// Adds a line, two spaces further in per `depth`, and nothing that a terminal obeys.
void addPlainLine(std::string& text, std::size_t depth, std::string_view line);
template <class... Args>
void addLine(std::string& text, std::size_t depth, fmt::format_string<Args...> format, Args&&... args) {
  addPlainLine(text, depth, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace weft::graph
