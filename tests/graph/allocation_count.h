// Counts calls of the global operator new in a test executable that links allocation_count.cpp.
#pragma once

#include <cstddef>

namespace weft::graph {

std::size_t allocationCount();

}  // namespace weft::graph
