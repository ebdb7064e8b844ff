// An ISF file on its way to a graph: what its JSON header says, the names that its things get, and its translated shaders.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "app/import/text.h"

namespace weft::importing {

struct IsfInput {
  enum class Type : std::uint8_t { boolean, event, integer, number, point, color, image };
  std::string name;  // as the shader knows it
  Type type = Type::number;
  std::string label;
  std::vector<double> initial, min, max;  // as many numbers as the type has; empty: not said
  std::vector<double> values;             // of an integer
  std::vector<std::string> labels;        // as many as values, or none
};

struct IsfPass {
  PlacedText target;  // "": the picture
  bool persistent = false, floats = false;
  PlacedText width, height;  // expressions; "": that of the picture
  bool isScaled() const { return !width.text.empty() || !height.text.empty(); }
};

struct IsfImported {
  std::string name;
  PlacedText path;
};

struct IsfHeader {
  std::string description, credit;
  std::vector<IsfInput> inputs;
  std::vector<IsfPass> passes;  // at least one
  std::vector<IsfImported> imported;
};

// Words of GLSL 4.5 that GLSL 1.20 and GLSL ES 1.00 leave to the author.
constexpr std::array<std::string_view, 19> kNewWords{
    "sample",   "buffer",    "shared",     "patch",    "precise",      "coherent", "restrict",
    "readonly", "writeonly", "subroutine", "centroid", "smooth",       "resource", "flat",
    "filter",   "partition", "active",     "common",   "noperspective"};

// Mistakes of form are W002 to W013 and W220; what Weft has no counterpart for is W221.
std::optional<IsfHeader> readIsfHeader(std::string_view text, const std::shared_ptr<const std::string>& file,
                                       text::Diagnostics& diagnostics);

// What the things of an ISF file are called in the graph and in the shader. Names that Weft or GLSL 4.5 keep for themselves get
// a '_' behind them.
class IsfNames {
 public:
  explicit IsfNames(const IsfHeader& header);
  const std::string& of(std::string_view name) const { return names_.find(name)->second; }
  const std::map<std::string, std::string, std::less<>>& all() const { return names_; }
  // A name for something of the graph alone, that nothing else has.
  std::string fresh(std::string_view wanted);

 private:
  std::map<std::string, std::string, std::less<>> names_;
  std::set<std::string, std::less<>> used_;
};

}  // namespace weft::importing
