// OSMesa: llvmpipe into memory. glad's header comes first: it stands in for the GL/gl.h that osmesa.h
// includes.
// clang-format off
#include "engine/gl/context/context_backends.h"

#ifndef GLAPI
#define GLAPI extern
#endif
#include <GL/osmesa.h>
// clang-format on

#include <vector>

namespace weft::gl {

namespace {

// Framebuffer 0 is a stand-in of this size: the engine renders to textures only.
constexpr int kStandIn = 16;

class OsmesaContext final : public Context {
 public:
  OsmesaContext(OSMesaContext context, Size size)
      : context_(context), size_(size), memory_(kStandIn * kStandIn * 4) {}
  ~OsmesaContext() override { OSMesaDestroyContext(context_); }

  bool makeCurrent() override {
    return OSMesaMakeCurrent(context_, memory_.data(), GL_UNSIGNED_BYTE, kStandIn, kStandIn) == GL_TRUE;
  }
  Size framebufferSize() const override { return size_; }

 private:
  OSMesaContext context_;
  Size size_;
  std::vector<unsigned char> memory_;
};

}  // namespace

OpenedContext openOsmesa(const ContextOptions& options, std::vector<std::string>& failures) {
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_DEPTH_BITS,
                            0,
                            OSMESA_STENCIL_BITS,
                            0,
                            OSMESA_ACCUM_BITS,
                            0,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            4,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            5,
                            0};
  const OSMesaContext raw = OSMesaCreateContextAttribs(attributes, nullptr);
  if (!raw) {
    failures.emplace_back("OSMesa: gives no OpenGL 4.5 core context");
    return {};
  }
  auto context = std::make_unique<OsmesaContext>(raw, Size{options.width, options.height});
  if (!context->makeCurrent()) {
    failures.emplace_back("OSMesa: OSMesaMakeCurrent failed");
    return {};
  }
  return {std::move(context), [](const char* name) { return OSMesaGetProcAddress(name); }, "OSMesa"};
}

}  // namespace weft::gl
