// .cube tables.
#include "engine/assets/cube_lut.h"
#include "tests/fuzz/fuzz.h"

namespace weft::fuzz {

void fuzz(std::string_view input) {
  text::Diagnostics said;
  const auto lut = assets::readCubeLut(input, "x.cube", said);
  expectAnswer(lut.has_value(), said);
  std::size_t texels = 1;
  for (int axis = 0; lut && axis < lut->dimensions; ++axis) texels *= static_cast<std::size_t>(lut->size);
  expect(!lut || lut->texels.size() == 3 * texels, "as many entries as it says");
}

}  // namespace weft::fuzz
