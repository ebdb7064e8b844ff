// Libraries of materials.
#include "engine/scene/files/scene_file.h"
#include "tests/fuzz/fuzz.h"

namespace weft::fuzz {

void fuzz(std::string_view input) {
  text::Diagnostics said;
  expectAnswer(scene::readMaterialLibrary(input, "x.json", said).has_value(), said);
}

}  // namespace weft::fuzz
