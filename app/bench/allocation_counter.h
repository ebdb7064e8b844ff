// Counts calls of operator new on this thread between start and stop, for `weft bench`. The program's own
// operator new counts (allocation_counter.cpp is linked into weft alone, not into any library): a library
// cannot be asked how often it allocated, and mallinfo2() knows bytes in use, not calls. While nothing is
// counted it costs a look at one flag. What a driver written in C takes by malloc() is not counted. Under a
// sanitizer, which has an operator new of its own, there is no count.
#pragma once

#include <cstddef>
#include <optional>

namespace weft::app {

void startCountingAllocations();
// Calls since then; nullopt where nothing counts.
std::optional<std::size_t> stopCountingAllocations();

}  // namespace weft::app
