// ISF files with their headers, and user shaders of mpv: what is taken is a graph that can be read and expanded.
#define DOCTEST_CONFIG_DISABLE
#include "tests/convert/converted.h"
#include "tests/fuzz/fuzz.h"

namespace weft::fuzz {

void fuzz(std::string_view input) {
  text::Diagnostics said;
  const auto made = WEFT_FUZZ_KIND[1] == 'f' ? importing::test::convertIsfText(input, said)
                                             : importing::test::convertMpvText(input, said);
  expectAnswer(made.has_value(), said);
  std::string why;
  expect(!made || importing::test::isSound(*made, why, true), why.c_str(), said);
}

}  // namespace weft::fuzz
