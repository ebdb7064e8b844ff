// Work of a frame on several threads, by oneTBB, where it is `many`; else on this thread. What is split must not depend on where it
// is split: then the bytes are the same on any number of threads. Private to the room.
#pragma once

#include <tbb/parallel_for.h>

#include <cstddef>

namespace weft::scene {

// Calls `run(from, to)` for ranges of at least `least` that make up 0 to `count`.
template <class Run>
void forRanges(bool many, std::size_t count, std::size_t least, const Run& run) {
  if (count == 0) return;
  if (!many || count <= least) return run(0, count);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, least),
                    [&](const auto& range) { run(range.begin(), range.end()); });
}

}  // namespace weft::scene
