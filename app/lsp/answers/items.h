// Completion items, and the part of completion that is about GLSL. A part of completion.cpp, not for others.
#pragma once

#include "app/lsp/answers/features.h"

namespace weft::app::lsp {

// Kinds of items of the protocol.
enum class ItemKind {
  text = 1,
  function = 3,
  field = 5,
  variable = 6,
  module = 9,
  property = 10,
  value = 12,
  keyword = 14,
  file = 17
};

Json completionInGlsl(const Context& context, const Text& text, std::size_t offset);

}  // namespace weft::app::lsp
