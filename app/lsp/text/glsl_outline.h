// The words of a GLSL text with their byte ranges, what it declares for its pass, and what it includes: engine/glsl's reading of the
// text as it stands, without macros, and with all branches of every #if. Does not: report.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "app/lsp/text/positions.h"

namespace weft::app::lsp {

struct GlslWord {
  std::string_view text;
  Range range;
  bool member = false;  // behind a dot
};

struct GlslName {
  enum class Kind : std::uint8_t {
    sampler,
    image,
    uniform_block,
    storage_block,
    member,
    output,
    input,
    define
  };
  Kind kind = Kind::sampler;
  std::string_view name;
  Range range;                        // of the name
  std::string_view block;             // of a member
  Range statement;                    // the declaration; of a block up to its '{'
  bool reads = true, writes = false;  // of images and storage blocks, by their qualifiers
};

struct GlslInclude {
  std::string_view path;
  Range range;
};

// The text must outlive it.
class GlslOutline {
 public:
  explicit GlslOutline(std::string_view text);
  const std::vector<GlslWord>& words() const { return words_; }
  const std::vector<GlslName>& names() const { return names_; }
  const std::vector<GlslInclude>& includes() const { return includes_; }
  const GlslName* find(std::string_view name) const;
  const GlslWord* wordAt(std::size_t offset) const;

 private:
  std::vector<GlslWord> words_;
  std::vector<GlslName> names_;
  std::vector<GlslInclude> includes_;
};

}  // namespace weft::app::lsp
