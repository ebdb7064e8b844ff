#include "tests/runtime/stage.h"

#include "engine/scene/files/scene_file.h"
#include "tests/backend.h"
#include "tests/load_image.h"
#include "tests/skip.h"
#include "tests/temporary_folder.h"

namespace weft::runtime::test {

gl::Context& context() {
  static const std::unique_ptr<gl::Context> opened = [] {
    text::Diagnostics diagnostics;
    auto made = gl::createContext({.backend = gl::test::wantedBackend()}, diagnostics);
    if (!made) weft::test::skipAll("no context\n" + diagnostics.text());
    return made;
  }();
  return *opened;
}

std::string sourcePath(const std::string& relative) {
  return relative.starts_with('/') ? relative : std::string(WEFT_SOURCE_DIR) + "/" + relative;
}

std::string withSmallMaps(const std::string& graph) {
  static const TemporaryFolder folder;
  static const bool made = [] {
    const auto size = [](const char* file, const std::string& from, const std::string& to) {
      std::ifstream in(folder.path() / "graphs" / file);
      std::string text{std::istreambuf_iterator<char>(in), {}};
      const std::size_t at = text.find(from);
      REQUIRE_MESSAGE(at != std::string::npos, file << " has no " << from);
      folder.write(std::string("graphs/") + file, text.replace(at, from.size(), to));
    };
    std::filesystem::copy(sourcePath("graphs"), folder.path() / "graphs",
                          std::filesystem::copy_options::recursive);
    size("ibl.json", "\"size\": 512", "\"size\": 32");
    size("ibl.json", "\"size\": [1024, 512]", "\"size\": [128, 64]");
    size("daylight.json", "\"size\": [512, 256]", "\"size\": [128, 64]");
    return true;
  }();
  return made && graph.starts_with("graphs/") ? folder.at(graph) : graph;
}

std::shared_ptr<const assets::ImageF> realEnvironment() {
  const std::string path = sourcePath("scenes/environments/spiaggia_di_mondello_1k.hdr");
  text::Diagnostics diagnostics;
  auto image = assets::loadEnvironment(path, diagnostics);
  REQUIRE_MESSAGE(image.has_value(), diagnostics.text());
  return std::make_shared<const assets::ImageF>(std::move(*image));
}

World worldOf(const std::string& scene) {
  text::Diagnostics diagnostics;
  auto loaded = scene::loadScene(sourcePath(scene), diagnostics);
  REQUIRE_MESSAGE(loaded.has_value(), diagnostics.text());
  return World(std::move(*loaded));
}

CleanScope::~CleanScope() {
  CHECK(gl::takeErrors() == "");
  text::Diagnostics diagnostics;
  context().debugLog().drain(diagnostics);
  CHECK_MESSAGE(diagnostics.empty(), diagnostics.text());
  CHECK_MESSAGE(gl::liveObjects() == before_, "alive: " << gl::liveObjects());
  context().debugLog().clear();
}

Stage::Stage(const std::string& graph, std::uint32_t width, std::uint32_t height, const std::string& scene,
             const std::string& cacheFolder, std::vector<std::string> presets)
    : world(worldOf(scene)) {
  settings.screenWidth = width;
  settings.screenHeight = height;
  settings.software = true;
  renderer_ = std::make_unique<Renderer>(
      context(), sourcePath(graph),
      Renderer::Options{
          .dataFolder = WEFT_SOURCE_DIR, .cacheFolder = cacheFolder, .presets = std::move(presets)});
}

bool Stage::load() {
  diagnostics.clear();
  return renderer_->load(settings, world, diagnostics);
}

bool Stage::apply() {
  diagnostics.clear();
  return renderer_->apply(settings, world, diagnostics);
}

void Stage::run(std::uint32_t frame) {
  run(headlessFrame(world, frame, 60));
}

void Stage::run(const FrameInput& input) {
  diagnostics.clear();
  REQUIRE(renderer_->execution());
  renderer_->frame(world, input, diagnostics);
  context().debugLog().drain(diagnostics);
  REQUIRE_MESSAGE(diagnostics.empty(), diagnostics.text());
}

bool Stage::ran(std::string_view pass) {
  const graph::Plan& plan = execution().plan();
  for (std::size_t step = 0; step < plan.steps.size(); ++step)
    if (plan.graph->passNames[plan.steps[step].pass] == pass) return execution().steps().ran(step);
  return false;
}

gl::TextureRef Stage::texture(std::string_view name) {
  const std::uint32_t resource = lastVersionOf(execution().plan(), name);
  return resource == graph::kNone ? gl::TextureRef() : execution().texture(resource);
}

BufferRef Stage::buffer(std::string_view name, std::uint64_t& offset) {
  const std::uint32_t resource = lastVersionOf(execution().plan(), name);
  return resource == graph::kNone ? BufferRef() : execution().buffer(resource, offset);
}

std::vector<float> Stage::read(const std::string& resource, std::uint32_t mip) {
  const gl::TextureRef found = texture(resource);
  REQUIRE_MESSAGE(found.id != 0, resource);
  return gl::readFloats(found, mip);
}

std::vector<std::uint8_t> Stage::pixels() {
  const auto image = renderer_->readPresented8();
  REQUIRE(image.has_value());
  return image->texels;
}

}  // namespace weft::runtime::test
