#include "tests/theory/lab.h"

#include <doctest/doctest.h>

#include <cstring>

#include "engine/gl/context/debug.h"
#include "tests/backend.h"
#include "tests/skip.h"

namespace weft::theory {

namespace {

gl::Context& sharedContext() {
  static std::unique_ptr<gl::Context> context = [] {
    text::Diagnostics diagnostics;
    auto made = gl::createContext({.backend = gl::test::wantedBackend()}, diagnostics);
    if (!made) weft::test::skipAll("no context\n" + diagnostics.text());
    return made;
  }();
  return *context;
}

scene::Scene sceneOf(const Setup& setup) {
  scene::Scene scene;
  scene.cameras.add({.name = "camera",
                     .pose = setup.camera,
                     .orbitDegreesPerSecond = setup.orbitDegreesPerSecond,
                     .path = setup.path});
  scene.sun = setup.sun;
  scene.ground = setup.ground;
  for (const Ball& ball : setup.balls) {
    const auto material = scene.materials.add(
        {.name = "", .albedo = ball.albedo, .metallic = ball.metallic, .roughness = ball.roughness});
    scene.spheres.add(
        {.center = ball.center, .radius = ball.radius, .velocity = ball.velocity, .material = material});
  }
  return scene;
}

}  // namespace

Lab::Lab(const Setup& setup) : setup_(setup), world_(sceneOf(setup)) {
  if (!setup.daylight)
    world_.setEnvironment(std::make_shared<const assets::EnvironmentMap>(
        assets::toEnvironmentMap(setup.environment ? *setup.environment : *constantEnvironment(1, 1, 1))));
  renderer_ = std::make_unique<runtime::Renderer>(
      sharedContext(), std::string(WEFT_SOURCE_DIR) + "/" + setup.graph,
      runtime::Renderer::Options{.dataFolder = WEFT_SOURCE_DIR, .cacheFolder = ""});
  graph::Settings settings;
  settings.screenWidth = setup.width;
  settings.screenHeight = setup.height;
  settings.software = true;
  settings.sets = setup.sets;
  settings.disables = setup.disables;
  const bool loaded = renderer_->load(settings, world_, diagnostics_);
  INFO(diagnostics_.text());
  REQUIRE(loaded);
}

void Lab::frame(std::uint32_t number, bool headless) {
  runtime::FrameInput input = runtime::headlessFrame(world_, number, 60);
  input.headless = headless;
  renderer_->frame(world_, input, diagnostics_);
  INFO(diagnostics_.text());
  REQUIRE_FALSE(diagnostics_.hasErrors());
}

Picture Lab::read(const std::string& resource, std::uint32_t mip, std::uint32_t layer) {
  const gl::TextureRef texture = renderer_->execution()->texture(resource);
  INFO(resource);
  REQUIRE(texture.id != 0);
  const gl::Extent extent = gl::extentOf(texture.desc, mip);
  return {extent.width, extent.height, gl::clientFormatOf(texture.desc.format).channels,
          gl::readFloats(texture, mip, layer)};
}

std::vector<std::uint32_t> Lab::readBuffer(const std::string& resource, std::size_t words) {
  std::uint64_t offset = 0;
  const runtime::BufferRef buffer = renderer_->execution()->buffer(resource, offset);
  INFO(resource);
  REQUIRE(buffer.id != 0);
  const std::vector<std::byte> bytes = gl::readBuffer(buffer.id, offset, words * 4);
  std::vector<std::uint32_t> out(words);
  std::memcpy(out.data(), bytes.data(), bytes.size());
  return out;
}

std::string Lab::passNames() const {
  std::string names;
  const graph::Plan& plan = renderer_->execution()->plan();
  for (const auto& step : plan.steps) names += plan.graph->passNames[step.pass] + "\n";
  return names;
}

std::string Lab::reports() {
  sharedContext().debugLog().drain(diagnostics_);
  // A test looks at a part of a graph, and so culls the rest.
  text::Diagnostics told;
  for (const text::Diagnostic& d : diagnostics_.items())
    if (d.code != text::Code::culledUnread) told.add(d);
  return told.text();
}

scene::ViewData Lab::view() const {
  return scene::makeView(
      {.pose = setup_.camera, .previousPose = setup_.camera, .viewport = {setup_.width, setup_.height}});
}

scene::ViewData Lab::viewAt(std::uint32_t number) const {
  const runtime::FrameInput input = runtime::headlessFrame(world_, number, 60);
  return scene::makeView(
      {.pose = input.pose, .previousPose = input.previousPose, .viewport = {setup_.width, setup_.height}});
}

}  // namespace weft::theory
