// Manifests of sequences.
#include "app/output/manifest.h"

#include "tests/fuzz/fuzz.h"

namespace weft::fuzz {

void fuzz(std::string_view input) {
  static const std::string picture = GivenFile::pathOf("fuzz/seeds/png/palette.png");
  const GivenFile file("fuzz/seeds/manifest/two.frames.jsonl", input);  // a plain file there is asked for
  text::Diagnostics said;
  app::Manifest manifest(file.path(), "ab", {});
  const bool good = manifest.read(said);
  expectAnswer(good, said);
  for (std::uint32_t frame = 0; good && frame < 4; ++frame)
    expect(!manifest.isDone(frame, {&picture, 1}) || !manifest.hasOther(frame), "one or the other");
}

}  // namespace weft::fuzz
