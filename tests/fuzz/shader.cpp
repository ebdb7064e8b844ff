// GLSL: what a shader declares and uses.
#include "engine/glsl/interface.h"
#include "tests/fuzz/fuzz.h"

namespace weft::fuzz {

void fuzz(std::string_view input) {
  text::Diagnostics said;
  glsl::SourceLoader loader({GivenFile::pathOf("bad_shaders")});
  const auto source = loader.loadText(input, "x.frag.glsl", said);
  expectAnswer(source != nullptr, said);
  if (!source) return;
  const glsl::Define defines[] = {{"HAS_SOURCE", "1"}, {"COUNT", "4"}};
  glsl::isUnusual(source->interfaceWith(defines));
  glsl::checkShaderSize(source->ofAllBranches().size, *source, said);
  glsl::clampShared(source->text);
  expectAnswer(true, said);
}

}  // namespace weft::fuzz
