// Where the tests take OpenGL from: the environment variable WEFT_TEST_BACKEND, OSMesa when it is absent.
#pragma once

#include <cstdlib>

#include "engine/gl/context/context.h"

namespace weft::gl::test {

inline Backend wantedBackend() {
  const char* name = std::getenv("WEFT_TEST_BACKEND");
  return findBackend(name ? name : "osmesa").value();
}

}  // namespace weft::gl::test
