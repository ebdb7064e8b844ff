// Counts calls of operator new on this thread, for `weft bench --edit` and the viewer's `--stats`. The program's own
// operator new counts (allocation_counter.cpp is linked into weft alone, not into any library): a library
// cannot be asked how often it allocated, and mallinfo2() knows bytes in use, not calls. While nothing is
// counted it costs a look at one flag. What a driver written in C takes by malloc() is not counted. Under a
// sanitizer, which has an operator new of its own, there is no count.
#pragma once

#include <cstddef>
#include <optional>

namespace weft::app {

// Counts as long as it lives. Counts may lie in each other.
class AllocationCount {
 public:
  AllocationCount();
  ~AllocationCount();
  AllocationCount(const AllocationCount&) = delete;
  AllocationCount& operator=(const AllocationCount&) = delete;

  // Calls so far; nullopt where nothing counts.
  std::optional<std::size_t> taken() const;

 private:
  std::size_t before_;
};

}  // namespace weft::app
