// The JSON header of an ISF file (Interactive Shader Format, versions 1 and 2): what it says, with places in the
// file. Mistakes of form are reported (W003, W005, W009, W011, W012, W220); what Weft has no counterpart for is W221.
// Does not: read pictures or look into the shader.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/diagnostic.h"

namespace weft::convert {

struct IsfInput {
  enum class Type : std::uint8_t { boolean, event, integer, number, point, color, image };
  std::string name;  // as the shader knows it
  Type type = Type::number;
  base::Place place;
  std::string label;
  std::vector<double> initial, min, max;  // 1, 2 or 4 numbers; empty: not said
  std::vector<double> values;             // of an integer
  std::vector<std::string> labels;        // as many as values, or none
};

struct IsfPass {
  std::string target;  // empty: the picture
  bool persistent = false, floats = false;
  std::string width, height;  // expressions; empty: that of the picture
  base::Place place, widthPlace, heightPlace;
};

struct IsfImported {
  std::string name, path;
  base::Place place;
};

struct IsfHeader {
  std::string description, credit;
  std::vector<IsfInput> inputs;
  std::vector<IsfPass> passes;  // at least one
  std::vector<IsfImported> imported;
};

// Whether the text begins with a comment that holds an object, perhaps behind comments of //.
bool looksLikeIsf(std::string_view text);

std::optional<IsfHeader> readIsfHeader(std::string_view text, const std::shared_ptr<const std::string>& file,
                                       base::Diagnostics& diagnostics);

}  // namespace weft::convert
