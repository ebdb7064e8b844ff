// What a file is by its first bytes, for messages about one that was given where another kind was wanted. Does not: decode,
// or look at the file's name.
#pragma once

#include <optional>
#include <string_view>

namespace weft::base {

struct FileKind {
  std::string_view what;  // "a PNG picture"
  std::string_view hint;  // what takes such a file
};

// Nothing for text, and for what is not known.
std::optional<FileKind> kindOfFile(std::string_view bytes);

}  // namespace weft::base
