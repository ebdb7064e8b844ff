// The import `image` in a running graph: a save shows, a broken save leaves what was there, and a sequence runs what reads it only when its
// picture changes; a part of it is bound alone. tests/app/commands/images.py has the formats.
#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

#include "engine/assets/images/image.h"
#include "tests/runtime/stage.h"
#include "tests/temporary_folder.h"

namespace image_test {

using namespace weft;
using namespace weft::runtime;
using namespace weft::runtime::test;

namespace {

void save(const std::string& path, int width, int height, std::uint8_t level) {
  text::Diagnostics diagnostics;
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
  CHECK(stage.diagnostics.items()[0].code == text::Code::unreadableImage);
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

namespace {

// Four columns: two of `left`, two of `right`.
void saveHalves(const std::string& path, std::uint8_t left, std::uint8_t right) {
  text::Diagnostics diagnostics;
  std::vector<std::uint8_t> texels;
  for (int y = 0; y < 4; ++y) texels.insert(texels.end(), {left, left, right, right});
  REQUIRE(assets::savePng8(path, 4, 4, 1, texels, diagnostics));
}

// Passes that each say of what they see: width, height, levels, and the last texel of level 0.
constexpr const char* kParts = R"json({
  "resources": {
    "picture": { "import": "image", "file": "FILE", "mips": true },
    "half":    { "texture": "rgba8", "size": 2, "history": 1, "first": "picture.mip[1]" },
    "chain":   { "texture": "rgba8", "size": 4, "mips": 3, "history": 1, "first": "picture" },
    "level": { "texture": "rgba32f", "size": 1 }, "levels": { "texture": "rgba32f", "size": 1 },
    "stored": { "texture": "rgba32f", "size": 1 }, "before": { "texture": "rgba32f", "size": 1 },
    "before_level": { "texture": "rgba32f", "size": 1 }, "whole": { "texture": "rgba32f", "size": 1 } },
  "passes": [
    { "name": "level", "type": "fullscreen", "shader": "look.frag.glsl", "side_effect": true, "update": "on_change",
      "read": { "source": "picture.mip[1]" }, "write": { "result": "level" } },
    { "name": "levels", "type": "fullscreen", "shader": "look.frag.glsl", "side_effect": true, "update": "on_change",
      "read": { "source": "picture.mip[1..]" }, "write": { "result": "levels" } },
    { "name": "stored", "type": "fullscreen", "shader": "load.frag.glsl", "side_effect": true, "update": "on_change",
      "read": { "source": "picture.mip[2] as image" }, "write": { "result": "stored" } },
    { "name": "before", "type": "fullscreen", "shader": "look.frag.glsl", "side_effect": true, "update": "on_change",
      "read": { "source": "half@-1" }, "write": { "result": "before" } },
    { "name": "before_level", "type": "fullscreen", "shader": "look.frag.glsl", "side_effect": true, "update": "on_change",
      "read": { "source": "chain.mip[2]@-1" }, "write": { "result": "before_level" } },
    { "name": "copy", "type": "blit", "read": { "source": "picture.mip[1]" }, "write": { "destination": "half" } },
    { "name": "fill", "type": "fullscreen", "shader": "look.frag.glsl", "repeat": { "i": [0, 2] },
      "read": { "source": "picture" }, "write": { "result": "chain.mip[i]" } },
    { "name": "whole", "type": "fullscreen", "shader": "look.frag.glsl",
      "read": { "source": "picture" }, "write": { "result": "whole" } } ],
  "present": "whole" })json";

void writeParts(const TemporaryFolder& folder, const std::string& file) {
  std::filesystem::create_directories(folder.at("shaders"));
  folder.write(
      "shaders/look.frag.glsl",
      "uniform sampler2D source;\nout vec4 result;\n"
      "void main() {\n  ivec2 size = textureSize(source, 0);\n"
      "  result = vec4(size, textureQueryLevels(source), 255.0 * texelFetch(source, size - 1, 0).r);\n}\n");
  folder.write(
      "shaders/load.frag.glsl",
      "layout(rgba8) uniform readonly image2D source;\nout vec4 result;\n"
      "void main() { result = vec4(imageSize(source), 0.0, 255.0 * imageLoad(source, ivec2(0)).r); }\n");
  std::string graph = kParts;
  folder.write("graph.json", graph.replace(graph.find("FILE"), 4, file));
}

// A texel of look.frag.glsl: "width height levels value".
std::string seen(Stage& stage, const std::string& resource) {
  const std::vector<float> texel = stage.read(resource);
  return fmt::format("{} {} {} {:.0f}", texel[0], texel[1], texel[2], texel[3]);
}

}  // namespace

TEST_CASE(
    "a part of an imported picture is all that its reader sees: sampled, as an image, and as a first value") {
  context();
  const CleanScope scope;
  const TemporaryFolder folder;
  saveHalves(folder.at("a.png"), 0, 200);
  writeParts(folder, "a.png");
  Stage stage(folder.at("graph.json"), 8, 8);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  std::uint32_t frame = 0;
  const auto check = [&](int right, int mean) {
    stage.run(frame++);
    CHECK(seen(stage, "whole") == fmt::format("4 4 3 {}", right));
    CHECK(seen(stage, "level") == fmt::format("2 2 1 {}", right));
    CHECK(seen(stage, "levels") == fmt::format("2 2 2 {}", right));
    CHECK(seen(stage, "stored") == fmt::format("1 1 0 {}", mean));
  };
  check(200, 100);
  CHECK(seen(stage, "before") == "2 2 1 200");
  CHECK(seen(stage, "before_level") == "1 1 1 100");
  check(200, 100);
  // Another picture of that size, and one that has a texture of its own.
  saveHalves(folder.at("a.png"), 40, 80);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  check(80, 60);
  save(folder.at("a.png"), 8, 8, 9);
  CHECK_FALSE(stage.load());  // of another size than what it is the first value of
  saveHalves(folder.at("a.png"), 20, 220);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  check(220, 120);
}

TEST_CASE("a part of a sequence that plays is that of the picture that is shown") {
  context();
  const CleanScope scope;
  const TemporaryFolder folder;
  saveHalves(folder.at("s.1.png"), 0, 200);
  saveHalves(folder.at("s.2.png"), 40, 80);
  writeParts(folder, "s.%d.png");
  Stage stage(folder.at("graph.json"), 8, 8);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  for (std::uint32_t frame = 0; frame < 4; ++frame) {
    stage.run(frame);
    CHECK(seen(stage, "level") == std::string(frame % 2 == 0 ? "2 2 1 200" : "2 2 1 80"));
    CHECK(seen(stage, "stored") == std::string(frame % 2 == 0 ? "1 1 0 100" : "1 1 0 60"));
  }
}

}  // namespace image_test
