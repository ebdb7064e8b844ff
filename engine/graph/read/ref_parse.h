// Reference strings of graph files: `name{.mip[..]|.layer[..]|.face[..]|[k]|.stencil} @-n as words if
// condition ?`. Errors carry the column of the offending character and the fix.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/graph/desc.h"
#include "engine/text/diagnostic.h"

namespace weft::graph {

// The words that may follow `as`, besides kKindNames (subresource.h): two filters, those of Wrap in its order, a comparison.
constexpr std::array<std::string_view, 7> kSamplerWords = {"linear", "nearest", "clamp",  "wrap",
                                                           "mirror", "border",  "compare"};

// `text` stands at `place`. Empty after one Code::badReference, or Code::badExpression inside an index or a condition.
std::optional<RefDesc> parseRef(std::string_view text, const Place& place, text::Diagnostics& diagnostics);

// Tells "@cut" and "camera if $progressive" from "size(hdr)" and "$taa ? 1 : 0", which both may stand at "reset".
bool looksLikeRef(std::string_view text);

// "quad", "icosphere($subdivision)": a word and its arguments. Empty after Code::badExpression or Code::badReference.
struct CallText {
  std::string name;
  std::vector<Expr> arguments;
};
std::optional<CallText> parseCallText(std::string_view text, const Place& place,
                                      text::Diagnostics& diagnostics);

}  // namespace weft::graph
