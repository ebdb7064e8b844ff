// An import that the engine does not know, registered from outside: what its provider says is what happens.
#include <array>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "engine/runtime/prepare/prepared_pass.h"
#include "tests/runtime/stage.h"
#include "tests/temporary_folder.h"

namespace own_import_test {

using namespace weft;
using namespace weft::runtime;
using namespace weft::runtime::test;

namespace {

// What the test tells the provider, and what it sees of it.
struct Told {
  std::uint8_t value = 10;
  std::uint64_t generation = 1;
  bool still = true, remembers = false, pending = false;
  int providers = 0;  // made so far
};

class PulseProvider : public imports::Provider {
 public:
  explicit PulseProvider(const Told& told) : told_(told) {}
  gl::TextureRef texture(const imports::Frame&, text::Diagnostics& diagnostics) override {
    if (!texture_) {
      auto made = gl::Texture::create({.width = 2, .height = 2}, "pulse", diagnostics);
      REQUIRE(made);
      texture_ = std::move(*made);
    }
    std::array<std::uint8_t, 16> texels;
    texels.fill(told_.value);
    gl::uploadTexture(texture_.ref(), 0, 0, GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(texels)));
    return texture_.ref();
  }
  std::uint64_t generation(const imports::Frame&) override { return told_.generation; }
  bool isStill(const World&) const override { return told_.still; }
  bool remembers(const World&) const override { return told_.remembers; }
  bool isPending(const World&) const override { return told_.pending; }

 private:
  const Told& told_;
  gl::Texture texture_;
};

class Pulse : public imports::Import {
 public:
  explicit Pulse(Told& told) : told_(told) {}
  graph::ImportType reflect() const override { return {.name = "pulse", .doc = "as the test says"}; }
  graph::ImportFacts facts(const graph::ImportRequest&, const WorldFacts&, imports::Files&) const override {
    return {.exists = true, .format = graph::Format::rgba8, .width = 2, .height = 2};
  }
  std::unique_ptr<imports::Provider> provide(const graph::ImportRequest&) const override {
    ++told_.providers;
    return std::make_unique<PulseProvider>(told_);
  }

 private:
  Told& told_;
};

struct Bench {
  Told told;
  World world = worldOf();
  text::Diagnostics diagnostics;
  Renderer renderer{context(),
                    sourcePath("tests/imports/graphs/pulse.json"),
                    {.dataFolder = WEFT_SOURCE_DIR, .plugIns = plugIns(told)}};

  static PlugIns plugIns(Told& told) {
    auto registry = std::make_shared<imports::ImportRegistry>(imports::ImportRegistry::builtin());
    registry->add(std::make_unique<Pulse>(told));
    return {.imports = std::move(registry)};
  }
  bool load() { return renderer.load({.screenWidth = 2, .screenHeight = 2}, world, diagnostics); }
  // Passes that ran.
  std::uint32_t run(std::uint32_t frame) {
    const auto report = renderer.frame(world, headlessFrame(world, frame, 60), diagnostics);
    CHECK_MESSAGE(diagnostics.empty(), diagnostics.text());
    return report.passesRun;
  }
  int picture() { return renderer.readPresented8()->texels.at(0); }
};

}  // namespace

TEST_CASE("a pass that runs on change follows the generation that the provider says") {
  context();
  const CleanScope scope;
  Bench bench;
  REQUIRE_MESSAGE(bench.load(), bench.diagnostics.text());
  CHECK(bench.run(0) == 1);
  CHECK(bench.picture() == 10);
  bench.told.value = 20;  // nobody is told
  CHECK(bench.run(1) == 0);
  CHECK(bench.picture() == 10);
  bench.told.generation = 2;
  CHECK(bench.run(2) == 1);
  CHECK(bench.picture() == 20);
}

TEST_CASE(
    "frames depend on those before them when the provider remembers, or moves and a kept texture is made of "
    "it") {
  context();
  const CleanScope scope;
  Bench bench;
  REQUIRE_MESSAGE(bench.load(), bench.diagnostics.text());
  const auto remembers = [&] { return bench.renderer.execution()->remembers(bench.world); };
  CHECK_FALSE(remembers());
  bench.told.remembers = true;
  CHECK(remembers());
  bench.told.remembers = false;
  bench.told.still = false;
  CHECK(remembers());
}

TEST_CASE("pictures are black while the provider says that it is on its way") {
  context();
  const CleanScope scope;
  Bench bench;
  bench.told.pending = true;
  REQUIRE_MESSAGE(bench.load(), bench.diagnostics.text());
  CHECK(bench.run(0) == 0);
  CHECK(bench.picture() == 0);
  bench.told.pending = false;
  CHECK(bench.run(1) == 1);
  CHECK(bench.picture() == 10);
}

TEST_CASE(
    "a provider in use stays when the graph is loaded again; a device without the import refuses the graph") {
  context();
  const CleanScope scope;
  Bench bench;
  for (std::uint32_t frame = 0; frame < 3; ++frame) {
    REQUIRE_MESSAGE(bench.load(), bench.diagnostics.text());
    bench.run(frame);
  }
  CHECK(bench.told.providers == 1);
  Stage without("tests/imports/graphs/pulse.json");
  CHECK_FALSE(without.load());
  CHECK(without.diagnostics.contains(text::Code::unknownImport));
}

namespace {

// Three layers of two levels; each layer is of one value, ten apart. Another generation is another texture.
class SheetsProvider : public imports::Provider {
 public:
  explicit SheetsProvider(const Told& told) : told_(told) {}
  gl::TextureRef texture(const imports::Frame&, text::Diagnostics& diagnostics) override {
    if (texture_ && made_ == told_.generation) return texture_.ref();
    texture_ = {};
    auto made =
        gl::Texture::create({.target = GL_TEXTURE_2D_ARRAY, .width = 4, .height = 4, .layers = 3, .mips = 2},
                            "sheets", diagnostics);
    REQUIRE(made);
    texture_ = std::move(*made);
    made_ = told_.generation;
    for (std::uint32_t layer = 0; layer < 3; ++layer) {
      std::array<std::uint8_t, 64> texels;
      texels.fill(static_cast<std::uint8_t>(told_.value + 10 * layer));
      for (std::uint32_t mip = 0; mip < 2; ++mip)
        gl::uploadTexture(texture_.ref(), mip, layer, GL_RGBA, GL_UNSIGNED_BYTE,
                          std::as_bytes(std::span(texels)).first(mip == 0 ? 64 : 16));
    }
    return texture_.ref();
  }
  std::uint64_t generation(const imports::Frame&) override { return told_.generation; }

 private:
  const Told& told_;
  gl::Texture texture_;
  std::uint64_t made_ = 0;
};

class Sheets : public imports::Import {
 public:
  explicit Sheets(const Told& told) : told_(told) {}
  graph::ImportType reflect() const override { return {.name = "sheets", .doc = "as the test says"}; }
  graph::ImportFacts facts(const graph::ImportRequest&, const WorldFacts&, imports::Files&) const override {
    return {.exists = true, .format = graph::Format::rgba8, .width = 4, .height = 4, .layers = 3, .mips = 2};
  }
  std::unique_ptr<imports::Provider> provide(const graph::ImportRequest&) const override {
    return std::make_unique<SheetsProvider>(told_);
  }

 private:
  const Told& told_;
};

}  // namespace

TEST_CASE(
    "a layer of an import is a plain texture, some layers are an array, also after another texture came") {
  context();
  const CleanScope scope;
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.at("shaders"));
  folder.write("shaders/look.frag.glsl",
               "uniform sampler2D one;\nuniform sampler2DArray some;\nout vec4 result;\nvoid main() {\n"
               "  float texel = texelFetch(one, ivec2(0), 0).r;\n"
               "  float last = texelFetch(some, ivec3(0, 0, textureSize(some, 0).z - 1), 0).r;\n"
               "  result = vec4(texel, last, vec2(textureSize(one, 0).x * 10 + textureQueryLevels(one),\n"
               "                textureSize(some, 0).z * 10 + textureQueryLevels(some)) / 255.0);\n}\n");
  folder.write("graph.json", R"json({ "resources": { "seen": { "texture": "rgba8", "size": 1 } },
    "passes": [ { "name": "look", "type": "fullscreen", "shader": "look.frag.glsl",
                  "read": { "one": "@sheets.mip[1].layer[1]", "some": "@sheets.layer[0..1]" },
                  "write": { "result": "seen" } } ], "present": "seen" })json");
  Told told;
  auto registry = std::make_shared<imports::ImportRegistry>(imports::ImportRegistry::builtin());
  registry->add(std::make_unique<Sheets>(told));
  World world = worldOf();
  text::Diagnostics diagnostics;
  Renderer renderer(context(), folder.at("graph.json"),
                    {.dataFolder = WEFT_SOURCE_DIR, .plugIns = {.imports = std::move(registry)}});
  REQUIRE_MESSAGE(renderer.load({.screenWidth = 2, .screenHeight = 2}, world, diagnostics),
                  diagnostics.text());
  for (std::uint32_t frame = 0; frame < 4; ++frame) {
    CAPTURE(frame);
    told.generation = 1 + frame / 2;
    told.value = static_cast<std::uint8_t>(10 + 100 * (frame / 2));
    renderer.frame(world, headlessFrame(world, frame, 60), diagnostics);
    CHECK_MESSAGE(diagnostics.empty(), diagnostics.text());
    const std::uint8_t layer = static_cast<std::uint8_t>(told.value + 10);
    CHECK(renderer.readPresented8()->texels == std::vector<std::uint8_t>{layer, layer, 21, 22});
  }
}

TEST_CASE(
    "the view of a part is kept, until another texture may have the name; what is not there is the last "
    "there is") {
  context();
  const CleanScope scope;
  text::Diagnostics diagnostics;
  const auto texture = gl::Texture::create({.width = 4, .height = 2, .mips = 2}, "whole", diagnostics);
  const auto texel = gl::Texture::create({}, "texel", diagnostics);
  REQUIRE((texture && texel));
  ImportPart part({.mip = 1, .mips = 1}, "whole");
  CHECK(part.viewOf({}, 1, diagnostics) == 0);
  const GLuint view = part.viewOf(texture->ref(), 1, diagnostics);
  GLint width = 0;
  glGetTextureLevelParameteriv(view, 0, GL_TEXTURE_WIDTH, &width);
  CHECK(width == 2);
  CHECK(part.viewOf(texture->ref(), 1, diagnostics) == view);
  CHECK(part.viewOf(texture->ref(), 2, diagnostics) != view);
  const GLuint last = part.viewOf(texel->ref(), 2, diagnostics);
  glGetTextureLevelParameteriv(last, 0, GL_TEXTURE_WIDTH, &width);
  CHECK(width == 1);
  CHECK_MESSAGE(diagnostics.empty(), diagnostics.text());
}

}  // namespace own_import_test
