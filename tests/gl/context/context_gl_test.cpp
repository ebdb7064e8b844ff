// One backend per process: the backend is the environment variable WEFT_TEST_BACKEND (osmesa when absent).
#include <doctest/doctest.h>

#include <string>

#include "engine/gl/context/context.h"
#include "engine/gl/context/debug.h"
#include "engine/gl/objects/objects.h"
#include "tests/backend.h"

using namespace weft::gl;
using weft::text::Code;
using weft::text::Diagnostics;

namespace {

const auto wanted = weft::gl::test::wantedBackend;

}  // namespace

TEST_CASE("names of backends go both ways") {
  for (const Backend b : {Backend::automatic, Backend::osmesa, Backend::egl, Backend::glfw})
    CHECK(findBackend(nameOf(b)) == b);
  CHECK_FALSE(findBackend("vulkan"));
}

TEST_CASE("a context opens, knows its device, keeps the conventions and can be opened again") {
  for (int round = 0; round < 2; ++round) {
    Diagnostics diagnostics;
    const auto context = createContext({.backend = wanted(), .width = 320, .height = 200}, diagnostics);
    REQUIRE_MESSAGE(context, diagnostics.text());
    const DeviceInfo& device = context->device();
    MESSAGE(device.platform << ": " << device.renderer << ", " << device.version);
    CHECK(device.backend != Backend::automatic);
    if (wanted() != Backend::automatic) CHECK(device.backend == wanted());
    CHECK(device.driverKey.size() == 16);
    CHECK(device.computeGroups[0] >= 65535);
    if (device.renderer.find("llvmpipe") != std::string::npos) {
      CHECK(device.software);
      CHECK_FALSE(device.hasTimerQueries);
    }
    CHECK((context->window() != nullptr) == (device.backend == Backend::glfw));
    CHECK(context->framebufferSize().width == (device.backend == Backend::glfw ? 320u : 0u));
    CHECK(context->framebufferSize().height == (device.backend == Backend::glfw ? 200u : 0u));
    CHECK(context->contentScale() > 0);

    GLint depthMode = 0, origin = 0, pack = 0;
    glGetIntegerv(GL_CLIP_DEPTH_MODE, &depthMode);
    glGetIntegerv(GL_CLIP_ORIGIN, &origin);
    glGetIntegerv(GL_PACK_ALIGNMENT, &pack);
    CHECK(depthMode == GL_ZERO_TO_ONE);
    CHECK(origin == GL_LOWER_LEFT);
    CHECK(pack == 1);
    CHECK_FALSE(glIsEnabled(GL_FRAMEBUFFER_SRGB));
    CHECK(glIsEnabled(GL_TEXTURE_CUBE_MAP_SEAMLESS));

    // It renders: clear through a framebuffer and read back.
    {
      auto texture = Texture::create({.format = GL_RGBA16F, .width = 8, .height = 4}, "target", diagnostics);
      REQUIRE(texture);
      const Attachment attachment{.texture = texture->id()};
      auto framebuffer = Framebuffer::create({&attachment, 1}, "target", diagnostics);
      REQUIRE(framebuffer);
      const float color[] = {0.25f, 0.5f, 2.0f, 1.0f};
      glClearNamedFramebufferfv(framebuffer->id(), GL_COLOR, 0, color);
      const auto texels = readFloats(texture->ref());
      REQUIRE(texels.size() == 8 * 4 * 4);
      CHECK(texels[4 * 31 + 2] == 2.0f);
    }
    CHECK(liveObjects() == "none");
    CHECK(takeErrors() == "");
    Diagnostics messages;
    context->debugLog().drain(messages);
    CHECK_MESSAGE(messages.empty(), messages.text());
  }
}

// Left out where GLFW has a display (CMakeLists.txt).
TEST_CASE("a backend that cannot be opened says what was tried" * doctest::test_suite("no_display")) {
  // GLFW without a display; taken from the environment of this process only.
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
  Diagnostics diagnostics;
  CHECK_FALSE(createContext({.backend = Backend::glfw}, diagnostics));
  REQUIRE(diagnostics.size() == 1);
  const auto& error = diagnostics.items()[0];
  CHECK(error.code == Code::noContext);
  CHECK(error.found.find("GLFW: ") == 0);
  CHECK(error.hint.find("xvfb-run") != std::string::npos);
}
