#include "tests/theory/lab.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <exception>

#include "engine/gl/context/debug.h"
#include "engine/graph/read/read.h"
#include "engine/runtime/frame/device.h"
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

// What runs one graph on a device of its own.
struct Lab::Bench {
  Bench(const std::string& path, scene::Scene scene)
      : graph(path), world(std::move(scene)), device(sharedContext(), {}, "") {}
  std::string graph;
  runtime::World world;
  std::shared_ptr<const assets::ImageF> environment{};  // from which the world's is made
  std::shared_ptr<const graph::GraphDesc> desc{};
  runtime::Device device;
  std::unique_ptr<runtime::Execution> execution{};
  bool keeps = true;  // what was made once serves others, too
};

std::vector<std::unique_ptr<Lab::Bench>>& Lab::idleBenches() {
  sharedContext();  // is destroyed after them
  static std::vector<std::unique_ptr<Bench>> idle;
  return idle;
}

void Lab::GiveBack::operator()(Bench* bench) const {
  constexpr std::size_t kMostIdle = 3;
  std::unique_ptr<Bench> done(bench);
  if (std::uncaught_exceptions() > 0) return;  // a case that failed leaves nothing
  std::vector<std::unique_ptr<Bench>>& idle = idleBenches();
  idle.push_back(std::move(done));
  if (idle.size() > kMostIdle) idle.erase(idle.begin());
}

std::unique_ptr<Lab::Bench, Lab::GiveBack> Lab::takeBench() {
  const std::string path = std::string(WEFT_SOURCE_DIR) + "/" + setup_.graph;
  std::vector<std::unique_ptr<Bench>>& idle = idleBenches();
  const auto found = std::ranges::find(idle, path, &Bench::graph);
  if (found == idle.end())
    return std::unique_ptr<Bench, GiveBack>(std::make_unique<Bench>(path, sceneOf(setup_)).release());
  std::unique_ptr<Bench, GiveBack> bench(found->release());
  idle.erase(found);
  mayKeep_ = bench->keeps && bench->execution && !bench->execution->remembers(bench->world);
  bench->world.setScene(sceneOf(setup_));
  return bench;
}

Lab::Lab(const Setup& setup) : setup_(setup), bench_(takeBench()) {
  static const std::shared_ptr<const assets::ImageF> kWhite = constantEnvironment(1, 1, 1);
  auto environment = setup.daylight ? nullptr : setup.environment ? setup.environment : kWhite;
  if (environment != bench_->environment)
    bench_->world.setEnvironment(
        environment ? std::make_shared<const assets::EnvironmentMap>(assets::toEnvironmentMap(*environment))
                    : nullptr);
  mayKeep_ = mayKeep_ && environment && environment == bench_->environment;
  bench_->environment = std::move(environment);
  make(!mayKeep_);
}

// As Renderer does it. `fresh`: with nothing of the lab before but programs.
void Lab::make(bool fresh) {
  runtime::Device& device = bench_->device;
  graph::Settings settings;
  settings.screenWidth = setup_.width;
  settings.screenHeight = setup_.height;
  settings.software = true;
  settings.sets = setup_.sets;
  settings.disables = setup_.disables;
  if (!bench_->desc) {
    bench_->desc = graph::readGraph(bench_->graph, diagnostics_);
    if (bench_->desc) device.sources.setRoots(runtime::shaderRootsOf(bench_->desc->files, WEFT_SOURCE_DIR));
  }
  INFO(diagnostics_.text());
  REQUIRE(bench_->desc);
  const graph::Registry registry =
      runtime::makeRegistry(device.plugIns, bench_->world.facts(), &device.imports.files());
  const auto flat = graph::expandGraph(*bench_->desc, registry, settings, diagnostics_);
  INFO(diagnostics_.text());
  REQUIRE(flat);
  REQUIRE_FALSE(diagnostics_.hasErrors());
  device.imports.prepare(*flat);
  if (fresh) bench_->execution.reset();
  bench_->execution = runtime::Execution::create(
      device, std::make_shared<const graph::Plan>(graph::compile(flat)), bench_->execution.get(),
      fresh ? runtime::ShaderFiles::read : runtime::ShaderFiles::keep, diagnostics_);
  INFO(diagnostics_.text());
  REQUIRE(bench_->execution);
}

void Lab::frame(std::uint32_t number, bool headless) {
  runtime::FrameInput input = runtime::headlessFrame(bench_->world, number, 60);
  input.headless = headless;
  runtime::FrameReport report = bench_->execution->frame(bench_->world, input, diagnostics_);
  // Something was made again, and has an age that it lacks in a first frame.
  if (mayKeep_ && report.slowRun > 0) {
    bench_->keeps = false;
    make(true);
    report = bench_->execution->frame(bench_->world, input, diagnostics_);
  }
  mayKeep_ = false;
  INFO(diagnostics_.text());
  REQUIRE_FALSE(diagnostics_.hasErrors());
}

const runtime::World& Lab::world() const {
  return bench_->world;
}

Picture Lab::read(const std::string& resource, std::uint32_t mip, std::uint32_t layer) {
  const std::uint32_t found = runtime::lastVersionOf(bench_->execution->plan(), resource);
  INFO(resource);
  REQUIRE(found != graph::kNone);
  const gl::TextureRef texture = bench_->execution->texture(found);
  const gl::Extent extent = gl::extentOf(texture.desc, mip);
  return {extent.width, extent.height, gl::clientFormatOf(texture.desc.format).channels,
          gl::readFloats(texture, mip, layer)};
}

std::vector<std::uint32_t> Lab::readBuffer(const std::string& resource, std::size_t words) {
  std::uint64_t offset = 0;
  const std::uint32_t found = runtime::lastVersionOf(bench_->execution->plan(), resource);
  INFO(resource);
  REQUIRE(found != graph::kNone);
  const runtime::BufferRef buffer = bench_->execution->buffer(found, offset);
  const std::vector<std::byte> bytes = gl::readBuffer(buffer.id, offset, words * 4);
  std::vector<std::uint32_t> out(words);
  std::memcpy(out.data(), bytes.data(), bytes.size());
  return out;
}

std::string Lab::passNames() const {
  std::string names;
  const graph::Plan& plan = bench_->execution->plan();
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
  const runtime::FrameInput input = runtime::headlessFrame(bench_->world, number, 60);
  return scene::makeView(
      {.pose = input.pose, .previousPose = input.previousPose, .viewport = {setup_.width, setup_.height}});
}

}  // namespace weft::theory
