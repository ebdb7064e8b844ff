// The entry point of every target: libFuzzer calls it, or replay.cpp does.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/fuzz.h"

namespace weft::fuzz {

void expect(bool holds, const char* promise, const text::Diagnostics& said) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s\n%s", promise, said.text().c_str());
  std::abort();
}

void expectAnswer(bool made, const text::Diagnostics& said) {
  expect(made || said.hasErrors(), "a result or an error", said);
  expect(said.empty() || !said.text().empty(), "a message", said);
}

}  // namespace weft::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const bool confined = [] {
    weft::text::allowFolder(WEFT_SOURCE_DIR "/graphs");
    return !weft::text::confineTo(WEFT_SOURCE_DIR "/tests");
  }();
  weft::fuzz::expect(confined, "a folder of tests");
  weft::fuzz::fuzz({reinterpret_cast<const char*>(data), size});
  return 0;
}
