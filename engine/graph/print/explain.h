// Why a plan is as it is: why a pass runs or was culled, why a barrier has its bits, why two textures share. Computed when
// asked, from the plan alone. Also the words that all printed forms share. Sentences are for people, and equal for equal
// plans.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "engine/graph/compile/compile.h"
#include "engine/graph/plan.h"
#include "engine/graph/registry.h"
#include "engine/text/printable.h"

namespace weft::graph {

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
// ".mip[2]" or ".mip[2..4]"
std::string spanText(const char* part, std::uint32_t first, std::uint32_t count);
// What an import is, its arguments and its columns: "@lamps", then a line each, two spaces further in.
std::string textOf(const ImportType& type);
nlohmann::ordered_json jsonOf(const Value& value);
// "texture rgba16f 64x64, 3 levels, 32768 bytes"
std::string shapeText(const FlatResource& resource);
const char* nameOf(Target target);
// "on_change", "every(4)".
std::string updateOf(const FlatPass& pass);

// Adds a line, two spaces further in per `depth`, and nothing that a terminal obeys.
template <class... Args>
void addLine(std::string& text, std::size_t depth, fmt::format_string<Args...> format, Args&&... args) {
  text +=
      std::string(2 * depth, ' ') + text::printable(fmt::format(format, std::forward<Args>(args)...)) + '\n';
}

}  // namespace weft::graph
