// Replaces the global operator new of the test executable.
#include "tests/runtime/frame_allocations.h"

#include <execinfo.h>

#include <cstdlib>
#include <new>

namespace {

thread_local bool counting = false;
thread_local std::size_t count = 0;

void* take(std::size_t size, std::size_t alignment) {
  if (counting && count++ == 0) {
    counting = false;
    void* frames[16];
    backtrace_symbols_fd(frames, backtrace(frames, 16), 2);
    counting = true;
  }
  void* memory = alignment ? std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment) : std::malloc(size);
  if (!memory) throw std::bad_alloc();
  return memory;
}

}  // namespace

namespace weft::runtime::test {

void startCountingAllocations() {
  void* frame[1];
  backtrace(frame, 1);  // loads libgcc now
  count = 0;
  counting = true;
}

std::size_t stopCountingAllocations() {
  counting = false;
  return count;
}

}  // namespace weft::runtime::test

void* operator new(std::size_t size) { return take(size, 0); }
void* operator new(std::size_t size, std::align_val_t alignment) { return take(size, static_cast<std::size_t>(alignment)); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
