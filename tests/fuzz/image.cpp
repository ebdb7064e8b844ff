// Pictures of the kind WEFT_FUZZ_KIND.
#include "engine/assets/images/image.h"

#include "tests/fuzz/fuzz.h"

namespace weft::fuzz {

void fuzz(std::string_view input) {
  const GivenFile file("fuzz" WEFT_FUZZ_KIND, input);
  text::Diagnostics ofHeader, ofTexels;
  assets::loadHeader(file.path(), ofHeader);
  const auto image = assets::isEnvironmentName(file.path())
                         ? assets::decodeEnvironment(input, file.path(), ofTexels)
                         : assets::decodeImage(input, file.path(), ofTexels);
  expectAnswer(image.has_value(), ofTexels);
  expect(!image || image->texels.size() == std::size_t{1} * image->width * image->height * image->channels,
         "as many texels as it says");
}

}  // namespace weft::fuzz
