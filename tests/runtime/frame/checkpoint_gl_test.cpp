// Execution::save() and restore(): a run that begins with the state of another draws what that goes on to draw, and has its state,
// byte for byte. Equal states are equal bytes, so whatever a frame may depend on is compared, also what no picture shows.
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "engine/graph/language/format.h"
#include "engine/imports/import.h"
#include "engine/runtime/storage/formats.h"
#include "tests/runtime/stage.h"
#include "tests/temporary_folder.h"

namespace frame_checkpoint_test {

using namespace weft;
using namespace weft::runtime::test;

namespace {

std::string stateOf(Stage& stage) {
  const auto state = stage.execution().save(stage.diagnostics);
  REQUIRE(state);
  return *state;
}

// The bits of the presented values, which have no upper bound.
std::vector<std::uint32_t> pictureOf(Stage& stage) {
  const auto picture = stage.renderer().readPresentedFloat();
  REQUIRE(picture);
  std::vector<std::uint32_t> bits(picture->texels.size());
  std::memcpy(bits.data(), picture->texels.data(), bits.size() * sizeof bits[0]);
  return bits;
}

constexpr std::size_t kNone = ~std::size_t{0};

std::size_t firstDifference(const std::string& a, const std::string& b) {
  const auto [x, y] = std::ranges::mismatch(a, b);
  return a == b ? kNone : static_cast<std::size_t>(x - a.begin());
}

struct Run {
  std::uint32_t before = 4, after = 4;  // frames
  bool headless = true;                 // else time-sliced groups run one slice in a frame
};

runtime::FrameInput inputOf(const Stage& stage, const Run& run, std::uint32_t frame) {
  runtime::FrameInput input = runtime::headlessFrame(stage.world, frame, 60);
  input.headless = run.headless;
  return input;
}

// Runs `before` frames and keeps the state; then `after` more, beside a second run that begins with that.
void check(Stage& whole, Stage& rest, const Run& run) {
  constexpr std::uint32_t kBeat = 6;  // the frame in which a parameter changes
  REQUIRE_MESSAGE(whole.load(), whole.diagnostics.text());
  REQUIRE_MESSAGE(rest.load(), rest.diagnostics.text());
  const auto next = [&](Stage& stage, std::uint32_t frame) {
    if (frame == kBeat) stage.renderer().setParameter("beat", graph::Value::number(3));
    stage.run(inputOf(stage, run, frame));
  };
  for (std::uint32_t frame = 0; frame < run.before; ++frame) next(whole, frame);
  if (run.before > kBeat) rest.renderer().setParameter("beat", graph::Value::number(3));
  const std::string state = stateOf(whole);
  REQUIRE(rest.execution().restore(state, rest.world, inputOf(rest, run, run.before - 1), rest.diagnostics));
  CHECK(firstDifference(stateOf(rest), state) == kNone);
  for (std::uint32_t frame = run.before; frame < run.before + run.after; ++frame) {
    CAPTURE(frame);
    next(whole, frame);
    next(rest, frame);
    CHECK(pictureOf(whole) == pictureOf(rest));
    CHECK(firstDifference(stateOf(whole), stateOf(rest)) == kNone);
  }
}

void check(const std::string& graph, const Run& run, const std::string& scene = "scenes/spheres.json") {
  CAPTURE(graph);
  CAPTURE(run.before);
  CAPTURE(run.headless);
  const CleanScope clean;
  Stage whole(graph, 64, 36, scene), rest(graph, 64, 36, scene);
  check(whole, rest, run);
}

}  // namespace

// Every value of depth16 and depth24, random bits of the others.
std::vector<std::byte> texelsFor(graph::Format format, std::size_t count) {
  const runtime::ExactTexel texel = runtime::exactTexelOf(format);
  std::vector<std::byte> bytes(count * gl::texelBytes(texel.format, texel.type));
  std::mt19937 random(7);
  for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
  const float steps = format == graph::Format::depth16 ? 65535.0f : 16777215.0f;
  for (std::size_t i = 0; i < count && texel.type == GL_FLOAT; ++i) {
    const float depth = std::min(static_cast<float>(i), steps) / steps;
    std::memcpy(&bytes[i * 4], &depth, 4);
  }
  for (std::size_t i = 0; i < bytes.size() && texel.type == GL_FLOAT_32_UNSIGNED_INT_24_8_REV; i += 8) {
    const float depth = static_cast<float>(i) / static_cast<float>(bytes.size());
    std::memcpy(&bytes[i], &depth, 4);
    std::fill_n(&bytes[i + 5], 3, std::byte{0});
  }
  return bytes;
}

TEST_CASE("checkpoint: texels of every format come back to the bit") {
  const CleanScope clean;
  for (int i = 1; i < static_cast<int>(graph::Format::count_); ++i) {
    const auto format = static_cast<graph::Format>(i);
    CAPTURE(graph::infoOf(format).name);
    const std::uint32_t side = format == graph::Format::depth24   ? 4096
                               : format == graph::Format::depth16 ? 256
                                                                  : 37;
    const runtime::ExactTexel texel = runtime::exactTexelOf(format);
    text::Diagnostics diagnostics;
    const auto texture = gl::Texture::create(
        {.format = runtime::glFormatOf(format), .width = side, .height = side}, "texels", diagnostics);
    REQUIRE(texture);
    const auto view = gl::Texture::create(texture->ref(), {.format = texel.view}, "bits", diagnostics);
    REQUIRE(view);
    std::vector<std::byte> bytes = texelsFor(format, std::size_t{side} * side);
    gl::uploadTexture(view->ref(), 0, 0, texel.format, texel.type, bytes);
    CHECK(gl::readTexture(view->ref(), 0, 0, texel.format, texel.type) == bytes);
  }
}

TEST_CASE("checkpoint: any frame of a graph with everything that is remembered") {
  for (const bool headless : {true, false})
    for (std::uint32_t before = 1; before <= 12; ++before)
      check("tests/runtime/graphs/checkpoint.json", {before, 5, headless}, "scenes/empty.json");
}

TEST_CASE(
    "checkpoint: imports that follow from the frame wake passes and reset histories as in the whole run") {
  const TemporaryFolder folder;
  for (int i = 1; i <= 4; ++i)
    std::filesystem::copy(sourcePath("tests/convert/references/mosaic.png"),
                          folder.at("film.000" + std::to_string(i) + ".png"));
  const std::string graph = folder.write("imports.json", R"json({
    // A film that has another picture in every third frame, a camera that stands and one that turns, spheres that move.
    "resources": {
      "film":   { "import": "image", "file": "film.####.png", "fps": 20 },
      "stands": { "import": "camera", "position": [0, 0, 30], "target": [0, 0, 0] },
      "turns":  { "import": "camera" },
      "frozen": { "texture": "rgba32f", "size": 1 },
      "still":  { "texture": "depth32f", "size": 16, "clear": 0 },
      "moving": { "texture": "depth32f", "size": 16, "clear": 0 },
      "place":  { "texture": "rgba32f", "size": 1 },
      "sum":    { "texture": "rgba32f", "size": 1, "history": 1, "first": 0, "reset": ["film"] },
      "total":  { "texture": "rgba32f", "size": 1, "history": 1, "first": 0, "reset": ["stands", "frozen"] },
      "shown":  { "texture": "rgba32f", "size": 1 }
    },
    "passes": [
      { "name": "freeze", "type": "fullscreen", "shader": "math/add.frag.glsl", "update": "on_change",
        "read": { "source": "film" }, "write": { "result": "frozen" }, "parameters": { "amount": 1 } },
      { "name": "place", "type": "fullscreen", "shader": "math/constant.frag.glsl", "update": "on_change",
        "write": { "result": "place" }, "parameters": { "amount": "@camera.position.x" } },
      { "name": "still", "shader": "shadow/sphere", "list": "spheres", "geometry": "icosphere(1)", "view": "stands",
        "update": "on_change", "modify": { "depth": "still" } },
      { "name": "moving", "shader": "shadow/sphere", "list": "spheres", "geometry": "icosphere(1)", "view": "turns",
        "update": "on_change", "modify": { "depth": "moving" } },
      { "name": "sum", "type": "fullscreen", "shader": "math/add.frag.glsl",
        "read": { "source": "sum@-1" }, "write": { "result": "sum" }, "parameters": { "amount": 1 } },
      { "name": "total", "type": "fullscreen", "shader": "math/sum.frag.glsl",
        "read": { "a": "total@-1", "b": "still", "c": "moving" }, "write": { "result": "total" } },
      { "name": "show", "type": "fullscreen", "shader": "math/sum.frag.glsl",
        "read": { "a": "sum", "b": "frozen", "c": "total" }, "write": { "result": "shown" } }
    ],
    "present": "shown"
  })json");
  std::filesystem::create_directory_symlink(sourcePath("tests/runtime/shaders"), folder.at("shaders"));
  for (std::uint32_t before = 1; before <= 7; ++before) check(graph, {before, 7}, "docs/gallery/moving.json");
}

TEST_CASE("checkpoint: bytes that are no state are refused, wherever they are wrong") {
  const CleanScope clean;
  Stage whole("tests/runtime/graphs/checkpoint.json", 8, 8, "scenes/empty.json"),
      rest("tests/runtime/graphs/checkpoint.json", 8, 8, "scenes/empty.json");
  REQUIRE(whole.load());
  REQUIRE(rest.load());
  for (std::uint32_t frame = 0; frame < 3; ++frame) whole.run(frame);
  const std::string state = stateOf(whole);
  const auto restores = [&](const std::string& bytes) {
    return rest.execution().restore(bytes, rest.world, runtime::headlessFrame(rest.world, 2, 60),
                                    rest.diagnostics);
  };
  for (std::size_t size = 0; size < state.size(); size += size < 64 ? 1 : 97)
    CHECK_FALSE(restores(state.substr(0, size)));
  CHECK_FALSE(restores(state + '\0'));
  // Any byte may be another: what is restored can be run.
  std::size_t refused = 0;
  for (std::size_t at = 0; at < state.size(); at += at < 4096 ? 5 : 601) {
    std::string bytes = state;
    bytes[at] = static_cast<char>(~bytes[at]);
    if (restores(bytes))
      rest.execution().frame(rest.world, runtime::headlessFrame(rest.world, 3, 60), rest.diagnostics);
    else
      ++refused;
  }
  CHECK(refused > 0);
  REQUIRE(restores(state));
  whole.run(3);
  rest.run(3);
  CHECK(stateOf(whole) == stateOf(rest));
}

TEST_CASE("checkpoint: a texture with samples that is kept cannot be saved, and is named") {
  const CleanScope clean;
  const TemporaryFolder folder;
  folder.write("shaders/keep.frag.glsl", R"(// write   result   a number
out vec4 result;
void main() { result = vec4(1); }
)");
  const std::string graph = folder.write("samples.json", R"({
    "resources": { "kept": { "texture": "rgba8", "size": 4, "samples": 4 }, "shown": { "texture": "rgba8", "size": 4 } },
    "passes": [
      { "name": "keep", "type": "fullscreen", "shader": "keep.frag.glsl", "update": "once", "write": { "result": "kept" } },
      { "name": "show", "type": "blit", "read": { "source": "kept" }, "write": { "destination": "shown" } }
    ],
    "present": "shown"
  })");
  Stage stage(graph, 8, 8, "scenes/empty.json");
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  CHECK_FALSE(stage.execution().canSave(stage.world, stage.diagnostics));
  CHECK(stage.diagnostics.text().find("'kept' is kept from frame to frame and has samples") !=
        std::string::npos);
}

TEST_CASE("checkpoint: bundled graphs that remember") {
  struct Bundled {
    std::string graph, scene = "tests/golden/moving.json";
    std::vector<graph::Setting> sets{};
  };
  const std::string cookbook = "graphs/cookbook/";
  const TemporaryFolder programs;
  assets::ImageF sky{16, 8, 3, std::vector<float>(16 * 8 * 3, 0.5f)};
  const auto environment = std::make_shared<const assets::EnvironmentMap>(assets::toEnvironmentMap(sky));
  for (const Bundled& each : {
           Bundled{
               "graphs/studio.json",
               "tests/golden/moving.json",
               {{"taa", "true"}, {"motion_blur", "true"}, {"auto_exposure", "true"}, {"ibl.sliced", "true"}}},
           Bundled{"graphs/studio_gi.json"},
           Bundled{"graphs/deferred_gi.json"},
           Bundled{"graphs/deferred_gi.json", "docs/gallery/walk.json"},
           Bundled{"docs/tutorials/trail.json"},
           Bundled{cookbook + "culling/culling.json"},
           Bundled{cookbook + "denoise/denoise.json"},
           Bundled{cookbook + "particles/particles.json"},
           Bundled{cookbook + "reflections/reflections.json"},
           Bundled{cookbook + "smoke/smoke.json"},
           Bundled{cookbook + "spots/spots.json"},
           Bundled{cookbook + "voxels/voxels.json"},
       }) {
    CAPTURE(each.graph);
    const CleanScope clean;
    Stage whole(withSmallMaps(each.graph), 32, 18, each.scene, programs.at("cache")),
        rest(withSmallMaps(each.graph), 32, 18, each.scene, programs.at("cache"));
    whole.settings.sets = rest.settings.sets = each.sets;
    if (!each.sets.empty())
      for (Stage* stage : {&whole, &rest}) stage->world.setEnvironment(environment);
    check(whole, rest, {});
    CHECK(whole.execution().remembers(whole.world));
  }
}

}  // namespace frame_checkpoint_test
