// Sets of frames, as --frames takes them: "7", "1:100", "1-100x3,200".
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace weft::app {

// Reads one: ascending, each frame once. Returns "", or what is wrong with it.
std::string takeFrames(const std::string& text, std::vector<std::uint32_t>& frames);

// The other way round: "1-100x3,200".
std::string framesText(std::span<const std::uint32_t> frames);

}  // namespace weft::app
