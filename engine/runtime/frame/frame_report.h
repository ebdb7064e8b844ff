// What a frame did.
#pragma once

#include <cstdint>

namespace weft::runtime {

struct FrameReport {
  std::uint32_t passesRun = 0, passesSkipped = 0, barriers = 0;
  std::uint32_t slowRun = 0;  // how many of passesRun are not `always`
};

}  // namespace weft::runtime
