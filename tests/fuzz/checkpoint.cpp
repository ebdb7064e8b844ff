// States of checkpoints: the input changes the first bytes of a true one. It is refused, or the next frame can be drawn.
#include "engine/gl/context/context.h"
#include "engine/runtime/frame/execution.h"
#include "engine/runtime/frame/renderer.h"
#include "engine/scene/files/scene_file.h"
#include "tests/fuzz/fuzz.h"

namespace weft::fuzz {

namespace {

struct Run {
  text::Diagnostics said;
  runtime::World world{sceneOf(said)};
  std::unique_ptr<gl::Context> context;
  std::unique_ptr<runtime::Renderer> renderer;
  std::string state;

  static scene::Scene sceneOf(text::Diagnostics& said) {
    for (const char* folder : {"/shaders", "/scenes"})
      text::allowFolder(WEFT_SOURCE_DIR + std::string(folder));
    auto scene = scene::loadScene(WEFT_SOURCE_DIR "/scenes/empty.json", said);
    expect(scene.has_value(), "a scene", said);
    return *std::move(scene);
  }

  Run() {
    context = gl::createContext({.backend = gl::Backend::osmesa}, said);
    expect(context != nullptr, "a context", said);
    renderer =
        std::make_unique<runtime::Renderer>(*context, GivenFile::pathOf("runtime/graphs/checkpoint.json"),
                                            runtime::Renderer::Options{.dataFolder = WEFT_SOURCE_DIR});
    graph::Settings settings;
    settings.screenWidth = settings.screenHeight = 8;
    settings.software = true;
    expect(renderer->load(settings, world, said), "a graph", said);
    for (std::uint32_t frame = 0; frame < 5; ++frame)
      renderer->frame(world, runtime::headlessFrame(world, frame, 60), said);
    state = renderer->execution()->save(said).value_or("");
    expect(!state.empty() && !said.hasErrors(), "a state", said);
  }
};

}  // namespace

void fuzz(std::string_view input) {
  static Run* const run = new Run;  // the driver's threads outlive what is static
  std::string bytes = run->state;
  for (std::size_t i = 0; i < std::min(bytes.size(), input.size()); ++i)
    bytes[i] = static_cast<char>(bytes[i] ^ input[i]);
  text::Diagnostics said;
  runtime::Execution& execution = *run->renderer->execution();
  if (!execution.restore(bytes, run->world, runtime::headlessFrame(run->world, 4, 60), said)) return;
  for (std::uint32_t frame = 5; frame < 7; ++frame)
    run->renderer->frame(run->world, runtime::headlessFrame(run->world, frame, 60), said);
  expect(!said.hasErrors() && execution.save(said), "frames after a state that was taken", said);
}

}  // namespace weft::fuzz
