// Replaces the global operator new of the test executable.
#include "tests/runtime/frame_allocations.h"

#include <execinfo.h>

#include <cstdlib>
#include <new>

namespace {

thread_local bool counting = false;
thread_local std::size_t count = 0;

void* takeOrNull(std::size_t size, std::size_t alignment) noexcept {
  if (counting && count++ == 0) {
    counting = false;
    void* frames[16];
    backtrace_symbols_fd(frames, backtrace(frames, 16), 2);
    counting = true;
  }
  return alignment ? std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment)
                   : std::malloc(size);
}

void* take(std::size_t size, std::size_t alignment) {
  if (void* memory = takeOrNull(size, alignment)) return memory;
  throw std::bad_alloc();
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

void* operator new(std::size_t size) {
  return take(size, 0);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return take(size, static_cast<std::size_t>(alignment));
}
// The library's own nothrow forms would come from elsewhere under a sanitizer, and not match the delete below.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return takeOrNull(size, 0);
}
void* operator new(std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return takeOrNull(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
