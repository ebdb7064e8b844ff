// OSMesa: llvmpipe into memory. It is loaded when the first context is made, never linked: libOSMesa brings LLVM, and relocating
// these takes most of the time of a command that draws nothing. glad's header comes first: it is in place of the GL/gl.h that
// osmesa.h includes.
// clang-format off
#include "engine/gl/context/context_backends.h"

#ifndef GLAPI
#define GLAPI extern
#endif
#include <GL/osmesa.h>
// clang-format on

#include <dlfcn.h>
#include <fmt/format.h>

#include <vector>

namespace weft::gl {

namespace {

// Of framebuffer 0, which nobody draws to: the engine renders to textures only.
constexpr int kSide = 16;

// Loaded once, and kept until the process ends: Mesa's threads may outlive a context.
void* library() {
  static void* const kLibrary = ::dlopen(WEFT_OSMESA_NAME, RTLD_NOW | RTLD_LOCAL);
  return kLibrary;
}

// A function of the library, which must be there.
template <class Function>
Function find(const char* name) {
  return reinterpret_cast<Function>(::dlsym(library(), name));
}

class OsmesaContext final : public Context {
 public:
  explicit OsmesaContext(OSMesaContext context) : context_(context), memory_(kSide * kSide * 4) {}
  ~OsmesaContext() override { find<decltype(&OSMesaDestroyContext)>("OSMesaDestroyContext")(context_); }

  bool makeCurrent() {
    const auto make = find<decltype(&OSMesaMakeCurrent)>("OSMesaMakeCurrent");
    return make(context_, memory_.data(), GL_UNSIGNED_BYTE, kSide, kSide) == GL_TRUE;
  }

 private:
  OSMesaContext context_;
  std::vector<unsigned char> memory_;
};

}  // namespace

OpenedContext openOsmesa(const ContextOptions&, std::vector<std::string>& failures) {
  if (!library()) {
    const char* why = ::dlerror();
    failures.push_back(fmt::format("OSMesa: cannot be loaded: {}", why ? why : WEFT_OSMESA_NAME));
    return {};
  }
  const auto create = find<decltype(&OSMesaCreateContextAttribs)>("OSMesaCreateContextAttribs");
  static const auto kFind = find<decltype(&OSMesaGetProcAddress)>("OSMesaGetProcAddress");
  // clang-format off
  const int attributes[] = {OSMESA_FORMAT, OSMESA_RGBA, OSMESA_DEPTH_BITS, 0, OSMESA_STENCIL_BITS, 0, OSMESA_ACCUM_BITS, 0,
                            OSMESA_PROFILE, OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION, 4, OSMESA_CONTEXT_MINOR_VERSION, 5, 0};
  // clang-format on
  const OSMesaContext raw = create ? create(attributes, nullptr) : nullptr;
  if (!raw) {
    failures.emplace_back("OSMesa: gives no OpenGL 4.5 core context");
    return {};
  }
  auto context = std::make_unique<OsmesaContext>(raw);
  if (!context->makeCurrent()) {
    failures.emplace_back("OSMesa: OSMesaMakeCurrent failed");
    return {};
  }
  return {std::move(context), [](const char* name) { return kFind(name); }, "OSMesa"};
}

}  // namespace weft::gl
