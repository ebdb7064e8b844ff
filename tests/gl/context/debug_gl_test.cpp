#include <doctest/doctest.h>

#include "engine/gl/context/debug.h"
#include "engine/gl/objects/timers.h"
#include "tests/gl/gl_test.h"

using namespace weft::gl;
using weft::gl::test::CleanScope;
using weft::gl::test::context;
using weft::text::Code;
using weft::text::Diagnostics;
using weft::text::Severity;

TEST_CASE("a driver's error arrives once with a count and the name of the pass") {
  CleanScope clean;
  DebugLog& log = context().debugLog();
  {
    const DebugGroup outer(log, "frame");
    const DebugGroup inner(log, "bloom.glow_down[3]");
    for (int i = 0; i < 5; ++i) glEnable(GL_TEXTURE_2D_ARRAY);  // no capability
  }
  CHECK(takeErrors() == "GL_INVALID_ENUM");
  Diagnostics diagnostics;
  log.drain(diagnostics);
  REQUIRE_MESSAGE(diagnostics.size() == 1, diagnostics.text());
  const auto& message = diagnostics.items()[0];
  CHECK(message.code == Code::driverMessage);
  CHECK(message.severity == Severity::error);
  CHECK(message.pass == "bloom.glow_down[3]");
  CHECK(message.message.find("seen 5 times") != std::string::npos);
  Diagnostics nothing;
  log.drain(nothing);
  CHECK(nothing.empty());
  clean.forgive();
}

TEST_CASE("groups raise no message, and neither does how a driver came to its speed") {
  CleanScope clean;
  { const DebugGroup group(context().debugLog(), "quiet"); }
  for (const GLenum type : {GL_DEBUG_TYPE_PERFORMANCE, GL_DEBUG_TYPE_OTHER})
    for (const GLenum severity : {GL_DEBUG_SEVERITY_LOW, GL_DEBUG_SEVERITY_MEDIUM, GL_DEBUG_SEVERITY_HIGH})
      glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, type, 1, severity, -1, "moved");
  Diagnostics nothing;
  context().debugLog().drain(nothing);
  CHECK_MESSAGE(nothing.empty(), nothing.text());
}

TEST_CASE("severities become errors and warnings") {
  DebugLog log;
  log.record(GL_DEBUG_TYPE_PORTABILITY, GL_DEBUG_SEVERITY_MEDIUM, "slow\n");
  log.record(GL_DEBUG_TYPE_ERROR, GL_DEBUG_SEVERITY_LOW, "wrong");
  log.record(GL_DEBUG_TYPE_PORTABILITY, GL_DEBUG_SEVERITY_MEDIUM, "slow");
  Diagnostics said;
  log.drain(said);
  REQUIRE(said.size() == 2);
  CHECK(said.items()[0].severity == Severity::warning);
  CHECK(said.items()[0].message == "OpenGL: slow (seen 2 times)");
  CHECK(said.items()[1].severity == Severity::error);
}

TEST_CASE("enums have names") {
  CHECK(enumName(GL_RGBA16F) == "GL_RGBA16F");
  CHECK(enumName(GL_COLOR_ATTACHMENT0) == "GL_COLOR_ATTACHMENT0");
  CHECK(enumName(0x1234) == "0x1234");
}

TEST_CASE("timers are off until enabled, then give one time per pass that ran") {
  CleanScope clean;
  // Both ways of measuring work here; that queries lie on this rasterizer does not matter to their
  // bookkeeping.
  for (const bool hardware : {false, true}) {
    DeviceInfo device = context().device();
    device.software = !hardware;
    device.hasTimerQueries = hardware;
    PassTimers timers(device);
    CHECK(timers.usesQueries() == hardware);
    timers.beginFrame(2);
    timers.begin(0);
    timers.end(0);
    timers.endFrame();
    CHECK(timers.results().empty());
    timers.setEnabled(true);
    for (int frame = 1; frame <= 9; ++frame) {
      timers.beginFrame(3);
      for (const std::uint32_t pass : {0u, 2u}) {
        timers.begin(pass);
        glFlush();
        timers.end(pass);
      }
      timers.endFrame();
    }
    timers.finish();
    REQUIRE(timers.results().size() == 3);
    CHECK(timers.results()[0].ran);
    CHECK_FALSE(timers.results()[1].ran);
    CHECK(timers.results()[1].gpu == 0);
    CHECK(timers.results()[2].ran);
    CHECK(timers.results()[2].cpu >= 0);
    CHECK(timers.results()[2].gpu >= 0);
    if (!hardware) CHECK(timers.results()[2].gpu >= timers.results()[2].cpu);
  }
}
