// An import that the engine does not know, registered from outside: what its provider says is what happens.
#include <array>
#include <memory>
#include <span>

#include "tests/runtime/stage.h"

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
  gl::TextureRef texture(const imports::Frame&, base::Diagnostics& diagnostics) override {
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
  base::Diagnostics diagnostics;
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
  CHECK(without.diagnostics.contains(base::Code::unknownImport));
}
