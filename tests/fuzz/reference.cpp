// References, and calls such as "icosphere($subdivision)".
#include "engine/graph/read/ref_parse.h"
#include "tests/fuzz/fuzz.h"

namespace weft::fuzz {

void fuzz(std::string_view input) {
  text::Diagnostics of, called;
  graph::looksLikeRef(input);
  expectAnswer(graph::parseRef(input, {"x.json", 1, 1}, of).has_value(), of);
  expectAnswer(graph::parseCallText(input, {"x.json", 1, 1}, called).has_value(), called);
}

}  // namespace weft::fuzz
