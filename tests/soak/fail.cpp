// Preloaded into weft by faults.py: the n-th allocation, thread or OpenGL object of the program fails. What drivers do inside of themselves is
// not counted. Environment: WEFT_FAIL, "new", "thread" or "gl"; WEFT_FAIL_AT, which one, from 1 (0: none); WEFT_FAIL_COUNT, a file that gets
// how many there were. WEFT_FAIL_AFTER: a file; only what happens when it is there counts.
#include <dlfcn.h>
#include <errno.h>
#include <link.h>
#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

namespace {

std::atomic<long> made{0};
const char *what = nullptr, *after = nullptr;
long failing = 0;
std::uintptr_t begin = 0, end = 0;  // of the program itself

int findProgram(dl_phdr_info* info, std::size_t, void*) {
  for (int i = 0; i < info->dlpi_phnum; ++i)
    if (info->dlpi_phdr[i].p_type == PT_LOAD && (info->dlpi_phdr[i].p_flags & PF_X)) {
      begin = info->dlpi_addr + info->dlpi_phdr[i].p_vaddr;
      end = begin + info->dlpi_phdr[i].p_memsz;
    }
  return 1;  // the first is the program
}

__attribute__((constructor)) void start() {
  dl_iterate_phdr(findProgram, nullptr);
  what = std::getenv("WEFT_FAIL");
  after = std::getenv("WEFT_FAIL_AFTER");
  const char* at = std::getenv("WEFT_FAIL_AT");
  failing = at ? std::atol(at) : 0;
}

__attribute__((destructor)) void finish() {
  const char* path = std::getenv("WEFT_FAIL_COUNT");
  if (std::FILE* file = path ? std::fopen(path, "w") : nullptr) {
    std::fprintf(file, "%ld\n", made.load());
    std::fclose(file);
  }
}

// Whether this call, of one kind, is the one that fails.
bool fails(const char* kind) {
  if (!what || std::strcmp(what, kind) != 0 || (after && access(after, F_OK) != 0)) return false;
  return ++made == failing;
}

bool isProgram(const void* caller) {
  const auto at = reinterpret_cast<std::uintptr_t>(caller);
  return at >= begin && at < end;
}

// ---- OpenGL: loaded by name, by a function that is itself loaded by name ----

using Address = void* (*)(const char*);
Address osmesa = nullptr, egl = nullptr;
bool outOfMemory = false;
constexpr unsigned kOutOfMemory = 0x0505;

template <int N>
void* real = nullptr;

unsigned failedError() {
  if (outOfMemory) return outOfMemory = false, kOutOfMemory;
  return reinterpret_cast<unsigned (*)()>(real<0>)();
}

// What fails has no effect, gives 0, and leaves GL_OUT_OF_MEMORY.
template <int N, class Result, class... Args>
struct Wrapped {
  static Result call(Args... args) {
    if (!fails("gl")) return reinterpret_cast<Result (*)(Args...)>(real<N>)(args...);
    outOfMemory = true;
    return Result();
  }
};

using U = unsigned;
using I = int;
using S = std::ptrdiff_t;
struct Entry {
  const char* name;
  void** real;
  void* wrapped;
};
#define WRAP(n, result, name, ...) \
  { name, &real<n>, reinterpret_cast<void*>(&Wrapped<n, result, __VA_ARGS__>::call) }
const Entry kEntries[] = {{"glGetError", &real<0>, reinterpret_cast<void*>(&failedError)},
                          WRAP(1, void, "glTextureStorage2D", U, I, U, I, I),
                          WRAP(2, void, "glTextureStorage3D", U, I, U, I, I, I),
                          WRAP(3, void, "glTextureStorage2DMultisample", U, I, U, I, I, unsigned char),
                          WRAP(4, void, "glNamedBufferStorage", U, S, const void*, U),
                          WRAP(5, void*, "glMapNamedBufferRange", U, S, S, U),
                          WRAP(6, U, "glCreateShader", U),
                          WRAP(7, void*, "glFenceSync", U, U),
                          WRAP(8, void, "glTexStorage2D", U, I, U, I, I),
                          WRAP(9, void, "glTexStorage3D", U, I, U, I, I, I),
                          WRAP(10, void, "glNamedBufferData", U, S, const void*, U),
                          {"glCreateProgram", &real<11>, reinterpret_cast<void*>(&Wrapped<11, U>::call)}};

void* wrap(const char* name, void* found) {
  for (const Entry& entry : kEntries)
    if (found && std::strcmp(name, entry.name) == 0) return *entry.real = found, entry.wrapped;
  return found;
}
void* osmesaAddress(const char* name) {
  return wrap(name, osmesa(name));
}
void* eglAddress(const char* name) {
  return wrap(name, egl(name));
}

}  // namespace

void* operator new(std::size_t size) {
  if (isProgram(__builtin_return_address(0)) && fails("new")) throw std::bad_alloc();
  if (void* memory = std::malloc(size ? size : 1)) return memory;
  throw std::bad_alloc();
}
void* operator new[](std::size_t size) {
  if (isProgram(__builtin_return_address(0)) && fails("new")) throw std::bad_alloc();
  if (void* memory = std::malloc(size ? size : 1)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* with, void* (*run)(void*),
                              void* argument) {
  static const auto next =
      reinterpret_cast<decltype(&pthread_create)>(dlvsym(RTLD_NEXT, "pthread_create", "GLIBC_2.34"));
  Dl_info caller{};
  // std::thread of the program, and of libraries that begin threads as it does; drivers are C.
  const bool own = dladdr(__builtin_return_address(0), &caller) && caller.dli_fname &&
                   std::strstr(caller.dli_fname, "libstdc++");
  return own && fails("thread") ? EAGAIN : next(thread, with, run, argument);
}

extern "C" void* dlsym(void* library, const char* name) {
  static const auto next =
      reinterpret_cast<void* (*)(void*, const char*)>(dlvsym(RTLD_NEXT, "dlsym", "GLIBC_2.34"));
  void* found = next(library, name);
  if (!found || !what || std::strcmp(what, "gl") != 0) return found;
  if (std::strcmp(name, "OSMesaGetProcAddress") == 0)
    return osmesa = reinterpret_cast<Address>(found), reinterpret_cast<void*>(&osmesaAddress);
  if (std::strcmp(name, "eglGetProcAddress") == 0)
    return egl = reinterpret_cast<Address>(found), reinterpret_cast<void*>(&eglAddress);
  return wrap(name, found);
}
