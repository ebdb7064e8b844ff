// The generation of an import moves when its value does, and only then: all that are built in, one by one.
#include "engine/imports/import.h"
#include "tests/runtime/stage.h"
#include "tests/temporary_folder.h"

namespace generation_test {

using namespace weft;
using namespace weft::runtime::test;

namespace {

constexpr const char* kEverything = "tests/runtime/scenes/everything.json";

// A request with the defaults of the type, but for `file`.
graph::ImportSpec specOf(const graph::ImportType& type, const std::string& file) {
  graph::ImportSpec spec;
  spec.request.type = type.name;
  for (const graph::ImportArgument& each : type.arguments) {
    const bool takesFile = each.name == "file";
    spec.request.arguments.emplace_back(each.name, takesFile ? graph::Value::text(file) : each.initial);
  }
  spec.key = graph::keyOf(spec.request);
  return spec;
}

std::string cubeOf(const std::string& last) {
  return "LUT_3D_SIZE 2\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 " + last + "\n";
}

// A TGA of one texel.
std::string pixelOf(char gray) {
  std::string bytes("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x18\0", 18);
  return bytes + gray + gray + gray;
}

std::shared_ptr<const assets::EnvironmentMap> blackMap() {
  auto map = std::make_shared<assets::EnvironmentMap>();
  map->width = 4;
  map->height = 2;
  map->texels.assign(32, 0x3c00);
  return map;
}

struct Moment {
  runtime::World world = worldOf(kEverything);
  runtime::FrameInput input = runtime::headlessFrame(world, 0, 60);
};

}  // namespace

TEST_CASE("an import has one generation as long as nothing of it changes, and another when something does") {
  const CleanScope clean;
  TemporaryFolder folder;
  Stage stage("graphs/glow.json", 16, 9, kEverything);
  REQUIRE(stage.load());
  runtime::Imports& imports = stage.renderer().device().imports;
  for (const graph::ImportType& type : imports::ImportRegistry::builtin().reflect()) {
    CAPTURE(type.name);
    const bool lut = type.name == "cube_lut";
    const std::string file = folder.write(lut ? "a.cube" : "a.tga", lut ? cubeOf("1") : pixelOf('a'));
    const graph::ImportSpec spec = specOf(type, file);
    graph::FlatGraph uses;
    uses.imports.push_back(spec);
    Moment moment;
    moment.world.setEnvironment(blackMap());
    const auto generation = [&] {
      text::Diagnostics said;
      ++moment.input.frame;  // a frame later, of the same moment
      imports.beginFrame(moment.world, moment.input);
      if (type.kind == graph::ImportKind::texture) imports.texture(spec, said);
      CHECK_MESSAGE(said.empty(), said.text());
      return imports.generation(spec);
    };
    imports.prepare(uses);
    generation();
    const std::uint64_t first = generation();
    CHECK(generation() == first);
    imports.prepare(uses);
    CHECK(generation() == first);
    const auto moves = [&](const char* what) {
      CAPTURE(what);
      const std::uint64_t before = generation();
      return [&, before] {
        const std::uint64_t after = generation();
        CHECK(after != before);
        CHECK(generation() == after);
      };
    };
    if (type.name == "cut") {
      const auto check = moves("a cut");
      ++moment.input.cutGeneration;
      check();
    } else if (type.name == "mouse") {
      const auto check = moves("the mouse");
      moment.input.pointer.position.x += 1;
      check();
    } else if (type.name == "environment") {
      const auto check = moves("another map");
      moment.world.setEnvironment(blackMap());
      check();
    } else if (lut || type.name == "image") {
      const auto check = moves("the file");
      folder.write(lut ? "a.cube" : "a.tga", lut ? cubeOf("0") : pixelOf('b'));
      imports.prepare(uses);
      check();
    } else {
      // Views, and what is made for the eye.
      if (type.name == "camera" || type.name == "draw_order") {
        const auto check = moves("the camera");
        moment.input.pose.position.y += 1;
        check();
      }
      if (type.name != "camera") {
        const auto check = moves("the scene");
        scene::Scene other = moment.world.scene();
        for (std::size_t row = 0; row < other.spheres.size(); ++row)
          other.spheres.edit(other.spheres.idOf(row)).radius *= 1.5f;
        moment.world.setScene(std::move(other));
        check();
      }
    }
  }
}

TEST_CASE("a sun without a map stands still while what it lights moves") {
  const CleanScope clean;
  Stage stage("graphs/glow.json", 16, 9, kEverything);
  REQUIRE(stage.load());
  runtime::Imports& imports = stage.renderer().device().imports;
  scene::Scene scene;
  scene.cameras.add({.name = "front"});
  scene.sun = scene::Sun{.direction = {0, 1, 0}};
  scene.spheres.add({.velocity = {1, 0, 0},
                     .material = scene.materials.add({.name = ""}),
                     .lists = scene::maskOf(scene::DrawList::shadow_casters)});
  const runtime::World world(std::move(scene));
  for (const double texels : {0.0, 2048.0}) {
    graph::ImportSpec spec;
    for (const graph::ImportType& type : imports::ImportRegistry::builtin().reflect())
      if (type.name == "sun") spec = specOf(type, "");
    for (auto& [name, given] : spec.request.arguments)
      if (name == "texels") given = graph::Value::number(texels);
    spec.key = graph::keyOf(spec.request);
    graph::FlatGraph uses;
    uses.imports.push_back(spec);
    imports.prepare(uses);
    const auto generationAt = [&](std::uint32_t frame) {
      imports.beginFrame(world, runtime::headlessFrame(world, frame, 60));
      return imports.generation(spec);
    };
    generationAt(0);
    const std::uint64_t before = generationAt(1);
    CAPTURE(texels);
    CHECK((generationAt(90) == before) == (texels == 0));
  }
}

TEST_CASE("what a camera resets begins again when it moves, and not by its jitter") {
  const CleanScope clean;
  TemporaryFolder folder;
  folder.write("shaders/count.frag.glsl",
               "uniform sampler2D before;\nout vec4 result;\nvoid main() { result = texelFetch(before, "
               "ivec2(0), 0) + 1.0; }\n");
  const std::string path = folder.write("graph.json", R"J({
  "resources": {
    "camera": { "import": "camera", "jitter": 16 },
    "frames": { "texture": "r32f", "size": 4, "history": 1, "first": 0, "reset": ["camera"] }
  },
  "passes": [
    { "name": "count", "type": "fullscreen", "shader": "count.frag.glsl", "read": { "before": "frames@-1" }, "write": { "result": "frames" } }
  ],
  "present": "frames"
})J");
  Stage stage(path, 4, 4);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  runtime::FrameInput input = runtime::headlessFrame(stage.world, 0, 60);
  const auto frame = [&] {
    ++input.frame;
    input.time += input.deltaTime;
    stage.run(input);
    return stage.value();
  };
  for (int n = 1; n <= 9; ++n) CHECK(frame() == static_cast<float>(n));
  input.pose.position.x += 1;
  CHECK(frame() == 1);
  CHECK(frame() == 2);
}

}  // namespace generation_test
