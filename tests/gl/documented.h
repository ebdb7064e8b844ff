// Whether a code was reported, and has its section in docs/errors.md.
#pragma once

#include <doctest/doctest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "engine/base/diagnostic.h"

namespace weft::gl::test {

// The text of "## W104: …" up to the next section, or "".
inline std::string sectionOf(base::Code code) {
  std::ifstream in(std::string(WEFT_SOURCE_DIR) + "/docs/errors.md");
  std::stringstream all;
  all << in.rdbuf();
  const std::string text = all.str();
  const std::size_t start = text.find("## " + base::nameOf(code) + ": " + base::titleOf(code) + "\n");
  if (start == std::string::npos) return {};
  return text.substr(start, text.find("\n## ", start) - start);
}

inline void checkDocumented(const base::Diagnostics& diagnostics, base::Code code) {
  bool found = false;
  for (const base::Diagnostic& d : diagnostics.items()) found = found || d.code == code;
  CHECK_MESSAGE(!sectionOf(code).empty(), "docs/errors.md lacks " << base::nameOf(code));
  CHECK_MESSAGE(found, base::nameOf(code) << " was not reported: " << diagnostics.text());
}

}  // namespace weft::gl::test
