// The import `image` in a running graph: a save shows, a broken save leaves what was there, and a sequence runs what reads it only when its
// picture changes. tests/app/commands/images.py has the formats.
#include <filesystem>
#include <string>
#include <vector>

#include "engine/assets/images/image.h"
#include "tests/runtime/stage.h"
#include "tests/temporary_folder.h"

using namespace weft;
using namespace weft::runtime;
using namespace weft::runtime::test;

namespace {

void save(const std::string& path, int width, int height, std::uint8_t level) {
  base::Diagnostics diagnostics;
  const std::vector<std::uint8_t> texels(static_cast<std::size_t>(width * height), level);
  REQUIRE(assets::savePng8(path, width, height, 1, texels, diagnostics));
}

std::string copyOf(const std::string& import) {
  return R"json({ "resources": { "picture": { "import": "image", )json" + import + R"json( },
    "kept": { "texture": "rgba8", "size": "size(picture)" } },
    "passes": [ { "name": "keep", "type": "blit", "update": "on_change",
                  "read": { "source": "picture" }, "write": { "destination": "kept" } } ],
    "present": "kept" })json";
}

}  // namespace

TEST_CASE("a save of the file shows, with another size too; a broken one leaves the picture and says why") {
  context();
  const CleanScope scope;
  const TemporaryFolder folder;
  save(folder.at("a.png"), 3, 2, 50);
  Stage stage(folder.write("graph.json", copyOf(R"("file": "a.png")")), 8, 8);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  CHECK(stage.renderer().files().size() >= 2);
  stage.run(0);
  CHECK(stage.pixels() == std::vector<std::uint8_t>{50, 50, 50, 255, 50, 50, 50, 255, 50, 50, 50, 255,
                                                    50, 50, 50, 255, 50, 50, 50, 255, 50, 50, 50, 255});
  CHECK(stage.ran("keep"));
  stage.run(1);
  CHECK_FALSE(stage.ran("keep"));
  save(folder.at("a.png"), 1, 2, 90);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(2);
  CHECK(stage.pixels() == std::vector<std::uint8_t>{90, 90, 90, 255, 90, 90, 90, 255});
  folder.write("a.png", "no picture");
  CHECK_FALSE(stage.load());
  REQUIRE(stage.diagnostics.items().size() == 1);
  CHECK(stage.diagnostics.items()[0].code == base::Code::unreadableImage);
  stage.run(3);
  CHECK(stage.pixels() == std::vector<std::uint8_t>{90, 90, 90, 255, 90, 90, 90, 255});
}

TEST_CASE("two imports of one file each have their texture; sRGB is decoded where it is asked for") {
  context();
  const CleanScope scope;
  const TemporaryFolder folder;
  save(folder.at("a.png"), 1, 1, 188);
  std::filesystem::create_directories(folder.at("shaders"));
  folder.write("shaders/look.frag.glsl",
               "uniform sampler2D source;\nout vec4 result;\n"
               "void main() { result = texelFetch(source, ivec2(0), 0); }\n");
  const std::string graph = R"json({ "parameters": { "first": { "default": true } },
    "resources": { "raw": { "import": "image", "file": "a.png" },
      "linear": { "import": "image", "file": "a.png", "srgb": true },
      "chosen": ["raw if $first", "linear"], "kept": { "texture": "rgba32f", "size": 1 } },
    "passes": [ { "name": "keep", "type": "fullscreen", "shader": "look.frag.glsl", "read": { "source": "chosen" },
                  "write": { "result": "kept" } } ],
    "present": "kept" })json";
  Stage stage(folder.write("graph.json", graph), 8, 8);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(0);
  CHECK(stage.value() == doctest::Approx(188 / 255.0));
  stage.settings.sets.emplace_back("first", "false");
  REQUIRE_MESSAGE(stage.apply(), stage.diagnostics.text());
  stage.run(1);
  CHECK(stage.value() == doctest::Approx(0.5029).epsilon(0.005));  // IEC 61966-2-1 of 188 / 255
}

TEST_CASE("a sequence runs its readers when its picture is another, and only then") {
  context();
  const CleanScope scope;
  const TemporaryFolder folder;
  save(folder.at("s.1.png"), 1, 1, 10);
  save(folder.at("s.3.png"), 1, 1, 30);  // 2 is missing
  Stage stage(folder.write("graph.json", copyOf(R"("file": "s.%d.png")")), 8, 8);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  const bool runs[] = {true, false, true, true, false, true};
  const std::uint8_t levels[] = {10, 10, 30, 10, 10, 30};
  for (std::uint32_t frame = 0; frame < 6; ++frame) {
    CAPTURE(frame);
    stage.run(frame);
    CHECK(stage.ran("keep") == runs[frame]);
    CHECK(stage.pixels()[0] == levels[frame]);
  }
}
