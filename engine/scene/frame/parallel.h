// Work of a frame on several threads, by oneTBB. What is split must not depend on where it is split: then the bytes are the same
// on any number of threads. Private to the room.
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <map>
#include <mutex>
#include <utility>

namespace weft::scene {

// Whether forRanges() and both() may use other threads, on this thread and for now.
inline thread_local bool mayFork = false;

template <class Work>
void withForks(bool fork, const Work& work) {
  const bool before = std::exchange(mayFork, fork);
  work();
  mayFork = before;
}

// For so many threads; 0: as many as the machine has. One for all work of a frame, whose threads are awake for the next.
inline tbb::task_arena& arenaOf(int threads) {
  static std::mutex mutex;
  static std::map<int, tbb::task_arena> arenas;
  const std::lock_guard lock(mutex);
  return arenas.try_emplace(threads, threads == 0 ? int{tbb::task_arena::automatic} : threads).first->second;
}

// Runs `work`, in which forRanges() and both() use at most `threads` threads, this one among them; 0: all of the machine.
template <class Work>
void onThreads(int threads, const Work& work) {
  if (threads == 1) return withForks(false, work);
  arenaOf(threads).execute([&] { withForks(true, work); });
}

template <class First, class Second>
void both(const First& first, const Second& second) {
  if (mayFork) {
    tbb::parallel_invoke([&] { withForks(true, first); }, [&] { withForks(true, second); });
  } else {
    first();
    second();
  }
}

// Calls `run(from, to)` for ranges of at least `least` that make up 0 to `count`; outside of onThreads() all at once.
template <class Run>
void forRanges(std::size_t count, std::size_t least, const Run& run) {
  if (count == 0) return;
  if (!mayFork || count <= least) return run(0, count);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, least),
                    [&](const auto& range) { run(range.begin(), range.end()); });
}

}  // namespace weft::scene
