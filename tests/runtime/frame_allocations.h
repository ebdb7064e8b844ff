// Counts calls of operator new on this thread between start and stop, and prints where the first came from.
#pragma once

#include <cstddef>

namespace weft::runtime::test {

void startCountingAllocations();
std::size_t stopCountingAllocations();

}  // namespace weft::runtime::test
