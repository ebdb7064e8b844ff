// Texts that stand in for files: what an editor has open and has not saved. Every file that is read by readFile (file.h) is
// looked for here first, so that graphs, what they include and shaders are read as the person sees them. Belongs to the
// process; safe from any thread; costs one load of a number while there is none. Does not: write, or widen what may be read.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace weft::text {

// Paths are compared as absolute ones, without following links.
void overlayFile(const std::string& path, std::string text);
void dropOverlay(const std::string& path);

struct Overlay {
  std::shared_ptr<const std::string> text;
  std::uint64_t generation = 0;  // another one for every text
};
std::optional<Overlay> overlayOf(const std::string& path);

}  // namespace weft::text
