// Work of a frame on several threads, by oneTBB. What is split must not depend on where it is split: then the bytes are the same
// on any number of threads. Private to the room.
#pragma once

#include <tbb/parallel_for.h>

#include <cstddef>

namespace weft::scene {

// Calls `run(from, to)` for ranges that make up 0 to `count`; for one, on this thread, where `count` is at most `few`.
template <class Run>
void forRanges(std::size_t count, std::size_t few, const Run& run) {
  if (count == 0) return;
  if (count <= few) return run(0, count);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, few / 16 + 1),
                    [&](const auto& range) { run(range.begin(), range.end()); });
}

}  // namespace weft::scene
