#pragma once
// What loading a broken model says.
#include <doctest/doctest.h>

#include <string>

#include "engine/assets/models/model_file.h"
#include "tests/temporary_folder.h"

namespace weft::test {

// What is said of a file: exactly one error, with everything that a person needs.
inline text::Diagnostic failureOf(const std::string& path) {
  text::Diagnostics diagnostics;
  CHECK_FALSE(assets::loadModel(path, diagnostics));
  REQUIRE_MESSAGE(diagnostics.errorCount() == 1, diagnostics.text());
  for (const text::Diagnostic& d : diagnostics.items())
    if (d.severity == text::Severity::error) {
      CHECK(d.place.file);
      CHECK_MESSAGE((!d.expected.empty() || !d.hint.empty()), text::format(d));
      return d;
    }
  return {};
}

inline text::Diagnostic failureOf(const TemporaryFolder& folder, const std::string& name,
                                  const std::string& bytes) {
  return failureOf(folder.write(name, bytes));
}

}  // namespace weft::test
