// Whether a code was reported, and has its section in docs/errors.md.
#pragma once

#include <doctest/doctest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "engine/text/diagnostic.h"

namespace weft::gl::test {

// The text of "## W104: …" up to the next section, or "".
inline std::string sectionOf(text::Code code) {
  std::ifstream in(std::string(WEFT_SOURCE_DIR) + "/docs/errors.md");
  std::stringstream all;
  all << in.rdbuf();
  const std::string text = all.str();
  const std::size_t start = text.find("## " + text::nameOf(code) + ": " + text::titleOf(code) + "\n");
  if (start == std::string::npos) return {};
  return text.substr(start, text.find("\n## ", start) - start);
}

inline void checkDocumented(const text::Diagnostics& diagnostics, text::Code code) {
  bool found = false;
  for (const text::Diagnostic& d : diagnostics.items()) found = found || d.code == code;
  CHECK_MESSAGE(!sectionOf(code).empty(), "docs/errors.md lacks " << text::nameOf(code));
  CHECK_MESSAGE(found, text::nameOf(code) << " was not reported: " << diagnostics.text());
}

}  // namespace weft::gl::test
