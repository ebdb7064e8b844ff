// Numbered pictures: which files a name with #### or %04d stands for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/text/diagnostic.h"

namespace weft::imports {

// "clouds/####.png" in its parts. The number stands in the file's name, not in a folder's.
struct SequencePattern {
  std::string text;           // as written
  std::string before, after;  // "clouds/", ".png"
  std::size_t digits = 1;     // at least; filled up with zeros
  std::string nameOf(std::uint32_t number) const;
};

// Nothing when `file` is the name of one file: without two or more # in a row, and without %d, %4d or %04d.
std::optional<SequencePattern> sequencePatternOf(const std::string& file);

// The numbers of the files that are there, ascending. Empty after an error: there is none (unreadableImage), or the folder lies
// outside those that may be read (outsideConfinement).
std::vector<std::uint32_t> numbersOf(const SequencePattern& pattern, text::Diagnostics& diagnostics);

}  // namespace weft::imports
