// The words of a GLSL text with their byte ranges, what it declares for its pass, and what it includes: engine/glsl's reading of the
// text as it stands, without macros, and with all branches of every #if.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "app/lsp/text/positions.h"
#include "engine/glsl/interface.h"

namespace weft::app::lsp {

struct GlslWord {
  std::string_view text;
  Range range;
  bool member = false;  // behind a dot
};

struct GlslName {
  std::optional<glsl::Role> role;  // nothing: a define
  std::string_view name;
  Range range;                 // of the name
  std::string_view block{};    // of a member
  std::string_view statement;  // the declaration; of a block up to its '{'
};

struct GlslInclude {
  std::string_view path;
  Range range;
};

// The text must outlive it.
struct GlslOutline {
  explicit GlslOutline(std::string_view text);
  const GlslName* find(std::string_view name) const;
  const GlslWord* wordAt(std::size_t offset) const;

  std::vector<GlslWord> words;
  std::vector<GlslName> names;
  std::vector<GlslInclude> includes;
};

}  // namespace weft::app::lsp
