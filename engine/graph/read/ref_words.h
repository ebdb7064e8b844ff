// The words after `as` in a reference: a kind ("depth") and filters ("linear border(0, 0, 0, 1)"). Does not know what the
// reference names.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "engine/graph/desc.h"

namespace weft::graph {

// The words that may follow `as`, besides kKindNames (subresource.h).
constexpr std::array<std::string_view, 7> kSamplerWords = {"linear", "nearest", "wrap",   "clamp",
                                                           "mirror", "border",  "compare"};

struct WordMistake {
  std::size_t at = 0;  // into the text
  std::string message, hint;
};

// Reads the words that stand in `text` from `at` on, up to `if` or the end, into the kind and the sampler of `ref`, and moves
// `at` behind them. Stops at the first mistake and returns it.
std::optional<WordMistake> parseAsWords(std::string_view text, std::size_t& at, RefDesc& ref);

}  // namespace weft::graph
