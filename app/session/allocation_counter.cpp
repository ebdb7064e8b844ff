#include "app/session/allocation_counter.h"

#include <cstdlib>
#include <new>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define WEFT_COUNTS_ALLOCATIONS 0
#else
#define WEFT_COUNTS_ALLOCATIONS 1
#endif

namespace {

thread_local int counting = 0;  // how many count
thread_local std::size_t count = 0;

}  // namespace

namespace weft::app {

AllocationCount::AllocationCount() : before_(count) {
  ++counting;
}

AllocationCount::~AllocationCount() {
  --counting;
}

std::optional<std::size_t> AllocationCount::taken() const {
  if (!WEFT_COUNTS_ALLOCATIONS) return std::nullopt;
  return count - before_;
}

}  // namespace weft::app

#if WEFT_COUNTS_ALLOCATIONS

namespace {

void* takeOrNull(std::size_t size, std::size_t alignment) noexcept {
  count += counting > 0 ? 1 : 0;
  if (size == 0) size = 1;
  return alignment ? std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment)
                   : std::malloc(size);
}

void* take(std::size_t size, std::size_t alignment) {
  while (true) {
    if (void* memory = takeOrNull(size, alignment)) return memory;
    const std::new_handler handler = std::get_new_handler();
    if (!handler) throw std::bad_alloc();
    handler();
  }
}

}  // namespace

void* operator new(std::size_t size) {
  return take(size, 0);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return take(size, static_cast<std::size_t>(alignment));
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

#endif
