#include "tests/graph/allocation_count.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<std::size_t> count{0}, bytes{0};
}

namespace weft::graph {
std::size_t allocationCount() {
  return count;
}
std::size_t allocatedBytes() {
  return bytes;
}
}  // namespace weft::graph

void* operator new(std::size_t size) {
  ++count;
  bytes += size;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
// The library's own nothrow form would come from elsewhere under a sanitizer, and not match the delete below.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++count;
  bytes += size;
  return std::malloc(size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
