// Counts calls of the global operator new, and the bytes they ask for, in a test executable that links allocation_count.cpp.
#pragma once

#include <cstddef>

namespace weft::graph {

std::size_t allocationCount();
std::size_t allocatedBytes();

}  // namespace weft::graph
