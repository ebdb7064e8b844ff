// A context for one test executable, and the check every GL test ends with: no GL error, no message above
// notification.
#pragma once

#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>
#include <memory>

#include "engine/gl/context/context.h"
#include "engine/gl/context/debug.h"
#include "engine/gl/objects/objects.h"
#include "tests/backend.h"

namespace weft::gl::test {

// The executable's context, opened once. Exits with an error when there is none.
inline Context& context() {
  static const std::unique_ptr<Context> opened = [] {
    text::Diagnostics diagnostics;
    auto made = createContext({.backend = wantedBackend()}, diagnostics);
    if (!made) {
      std::fprintf(stderr, "%s", diagnostics.text().c_str());
      std::exit(1);
    }
    return made;
  }();
  return *opened;
}

// Put first in a test case: opens the context, and at the end of the scope holds GL to "no error, nothing
// leaked".
class CleanScope {
 public:
  CleanScope() : log_(context().debugLog()), before_(liveObjects()) {}
  ~CleanScope() {
    CHECK(takeErrors() == "");
    text::Diagnostics diagnostics;
    log_.drain(diagnostics);
    CHECK_MESSAGE(diagnostics.empty(), diagnostics.text());
    CHECK_MESSAGE(liveObjects() == before_, "alive: " << liveObjects());
    log_.clear();
  }
  // For tests that provoke errors: forgets those seen so far.
  void forgive() {
    takeErrors();
    log_.clear();
  }

 private:
  DebugLog& log_;
  std::string before_;
};

}  // namespace weft::gl::test
