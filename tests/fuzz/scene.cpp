// Scene files, with the models beside them.
#include "engine/scene/files/scene_file.h"
#include "tests/fuzz/fuzz.h"

namespace weft::fuzz {

void fuzz(std::string_view input) {
  const GivenFile file("runtime/scenes/fuzz.json", input);
  text::Diagnostics said;
  scene::namesModels(file.path());
  expectAnswer(scene::loadScene(file.path(), said).has_value(), said);
}

}  // namespace weft::fuzz
