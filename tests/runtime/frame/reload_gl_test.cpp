// A running graph and its file: reordering, changed parameters, resizing, broken files.
#include <glad/gl.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "tests/runtime/stage.h"
#include "tests/temporary_folder.h"

namespace frame_reload_test {

using namespace weft;
using namespace weft::runtime::test;

namespace {

// A graph file beside tests/runtime/graphs' shaders, in a folder of its own that goes with it.
class TemporaryGraph {
 public:
  TemporaryGraph() {
    std::filesystem::copy(sourcePath("tests/runtime/shaders"), folder_.path() / "shaders",
                          std::filesystem::copy_options::recursive);
  }
  std::string path() const { return folder_.at("graph.json"); }
  void write(const std::string& text) const { std::ofstream(path()) << text; }
  void writeShader(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.at("shaders/" + name)) << text;
  }

 private:
  TemporaryFolder folder_;
};

const std::string kHead =
    R"({ "name": "chain", "resources": { "sum": { "texture": "r32f", "size": 4 } }, "passes": [
  { "name": "start", "type": "fullscreen", "shader": "math/constant.frag.glsl", "write": { "result": "sum" },
    "parameters": { "amount": 3 } })";
const std::string kAdd =
    R"(,
  { "name": "add", "type": "fullscreen", "shader": "math/add.frag.glsl", "read": { "source": "sum" }, "write": { "result": "sum" },
    "parameters": { "amount": 2 } })";
const std::string kScale =
    R"(,
  { "name": "scale", "type": "fullscreen", "shader": "math/scale.frag.glsl", "read": { "source": "sum" }, "write": { "result": "sum" },
    "parameters": { "amount": 10 } })";
const std::string kTail = R"( ], "present": "sum" })";

// In place of GL's functions, which this process calls through pointers: makes one of the next calls that make or map a
// buffer fail, as if the device had no memory left.
class BufferFailure {
 public:
  explicit BufferFailure(int callsBefore) {
    callsBefore_ = callsBefore;
    hit_ = pending_ = false;
    storage_ = std::exchange(glad_glNamedBufferStorage, &makeStorage);
    map_ = std::exchange(glad_glMapNamedBufferRange, &map);
    error_ = std::exchange(glad_glGetError, &takeError);
  }
  ~BufferFailure() {
    glad_glNamedBufferStorage = storage_;
    glad_glMapNamedBufferRange = map_;
    glad_glGetError = error_;
  }
  BufferFailure(const BufferFailure&) = delete;
  BufferFailure& operator=(const BufferFailure&) = delete;
  bool hit() const { return hit_; }

 private:
  static bool isNext() {
    const bool next = callsBefore_-- == 0;
    hit_ |= next;
    return next;
  }
  static void makeStorage(GLuint buffer, GLsizeiptr size, const void* data, GLbitfield flags) {
    if (isNext())
      pending_ = true;
    else
      storage_(buffer, size, data, flags);
  }
  static void* map(GLuint buffer, GLintptr offset, GLsizeiptr length, GLbitfield access) {
    return isNext() ? nullptr : map_(buffer, offset, length, access);
  }
  static GLenum takeError() { return std::exchange(pending_, false) ? GLenum{GL_OUT_OF_MEMORY} : error_(); }

  static inline int callsBefore_ = 0;
  static inline bool hit_ = false, pending_ = false;
  static inline PFNGLNAMEDBUFFERSTORAGEPROC storage_ = nullptr;
  static inline PFNGLMAPNAMEDBUFFERRANGEPROC map_ = nullptr;
  static inline PFNGLGETERRORPROC error_ = nullptr;
};

}  // namespace

TEST_CASE("reload: a color table is watched, and taken up when its file changed") {
  const CleanScope clean;
  const TemporaryGraph file;
  const std::string path = file.path() + ".cube";
  const auto write = [&](const char* rows) { std::ofstream(path) << "LUT_1D_SIZE 2\n" << rows; };
  Stage stage("tests/runtime/graphs/toggle.json", 16, 9);
  stage.settings.sets = {{"lut", path}};
  const auto watched = [&] {
    const auto files = stage.renderer().files();
    return std::ranges::count(files, path) > 0;
  };
  CHECK(!stage.load());  // not there yet
  CHECK(watched());
  write("0 0 0\n1 1 1\n");
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  CHECK(watched());
  stage.run(0);
  const auto same = stage.pixels();
  REQUIRE(stage.load());
  stage.run(1);
  CHECK(stage.pixels() == same);
  write("1.0 1.0 1.0\n0 0 0\n");
  REQUIRE(stage.load());
  stage.run(2);
  CHECK(stage.pixels() != same);
  write("no table");
  CHECK(!stage.load());
  CHECK(watched());
  write("0 0 0\n1 1 1\n");
  REQUIRE(stage.load());
  stage.run(3);
  CHECK(stage.pixels() == same);
}

TEST_CASE("reload: two effects swapped in the file give the other result, without an edit of a slot") {
  const CleanScope clean;
  const TemporaryGraph file;
  file.write(kHead + kAdd + kScale + kTail);
  Stage stage(file.path());
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(0);
  CHECK(stage.value() == 50);
  file.write(kHead + kScale + kAdd + kTail);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(1);
  CHECK(stage.value() == 32);
  stage.settings.disables = {"scale"};
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(2);
  CHECK(stage.value() == 5);
}

TEST_CASE("reload: after a toggle the passes that do not differ have the uniforms that they had") {
  const CleanScope clean;
  const TemporaryGraph file;
  file.write(R"({ "name": "toggled", "resources": {
    "a": { "texture": "r32f", "size": 4 }, "b": { "texture": "r32f", "size": 4 },
    "extra": { "texture": "r16f", "size": 4 }, "sum": { "texture": "rgba32f", "size": 4 } }, "passes": [
  { "name": "extra", "type": "fullscreen", "shader": "math/constant.frag.glsl", "write": { "result": "extra" },
    "parameters": { "amount": 11 } },
  { "name": "a", "type": "fullscreen", "shader": "math/constant.frag.glsl", "write": { "result": "a" }, "parameters": { "amount": 22 } },
  { "name": "b", "type": "fullscreen", "shader": "math/constant.frag.glsl", "write": { "result": "b" }, "parameters": { "amount": 33 } },
  { "name": "sum", "type": "fullscreen", "shader": "math/sum.frag.glsl",
    "read": { "a": "a", "b": "b", "c": "extra?" }, "write": { "result": "sum" } } ], "present": "sum" })");
  Stage stage(file.path());
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(0);
  CHECK(stage.value() == 66);
  stage.settings.disables = {"extra"};
  REQUIRE_MESSAGE(stage.apply(), stage.diagnostics.text());
  CHECK(stage.execution().passesPrepared() == 1);
  stage.run(1);
  CHECK(stage.value() == 55);
  stage.settings.disables.clear();
  REQUIRE_MESSAGE(stage.apply(), stage.diagnostics.text());
  CHECK(stage.execution().passesPrepared() == 2);
  stage.run(2);
  CHECK(stage.value() == 66);
}

TEST_CASE("reload: a broken file or shader leaves the running execution as it is") {
  const CleanScope clean;
  const TemporaryGraph file;
  file.write(kHead + kAdd + kTail);
  Stage stage(file.path());
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(0);
  const auto before = stage.pixels();
  const runtime::Execution* running = &stage.execution();
  std::string shaderless = kAdd, uncompilable = kAdd, unknown = kAdd;
  shaderless.replace(shaderless.find("math/add"), 8, "math/nil");
  uncompilable.replace(uncompilable.find("math/add"), 8, "math/bad");
  unknown.replace(unknown.find("\"source\": \"sum\""), 15, "\"source\": \"som\"");
  const std::pair<std::string, text::Code> broken[] = {
      {kHead, text::Code::notJson},
      {"", text::Code::notJson},
      {kHead + unknown + kTail, text::Code::unknownResource},
      {kHead + shaderless + kTail, text::Code::unreadableShader},
      {kHead + uncompilable + kTail, text::Code::shaderDoesNotCompile},
  };
  std::uint32_t frame = 1;
  for (const auto& [text, code] : broken) {
    INFO(text::nameOf(code));
    file.write(text);
    CHECK_FALSE(stage.load());
    CHECK_MESSAGE(stage.diagnostics.contains(code), stage.diagnostics.text());
    CHECK(&stage.execution() == running);
    stage.run(frame++);
    CHECK(stage.value() == 5);
    CHECK(stage.pixels() == before);
  }
  std::filesystem::remove(file.path());
  CHECK_FALSE(stage.load());
  CHECK(stage.diagnostics.contains(text::Code::unreadableFile));
  file.write(kHead + kScale + kTail);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(frame);
  CHECK(stage.value() == 30);
}

TEST_CASE("reload: buffers that cannot be made leave the running execution as it is") {
  const CleanScope clean;
  const TemporaryGraph file;
  const std::string own = kHead + kAdd + R"( ], "outputs": { "sum": "sum" }, "present": "sum" })";
  std::string next;
  int buffers = 0;  // made or mapped
  SUBCASE("of uniforms") {
    next = kHead + kAdd + kScale + R"( ], "outputs": { "sum": "sum" }, "present": "sum" })";
    buffers = 1;
  }
  SUBCASE("of uniforms and of read-backs") {
    next = kHead + kAdd + kScale + R"( ], "outputs": { "sum": "sum", "again": "sum" }, "present": "sum" })";
    buffers = 1 + 2 * static_cast<int>(runtime::ReadBack::kRing);
  }
  file.write(own);
  Stage stage(file.path());
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  std::uint32_t frame = 0;
  stage.run(frame++);
  const auto before = stage.pixels();
  const runtime::Execution* running = &stage.execution();
  int refused = 0;
  for (; refused <= buffers; ++refused) {
    CAPTURE(refused);
    file.write(next);
    bool loaded = false;
    {
      const BufferFailure failure(refused);
      loaded = stage.load();
      REQUIRE(loaded == !failure.hit());
    }
    if (loaded) break;
    CHECK_MESSAGE(stage.diagnostics.contains(text::Code::bufferNotCreated), stage.diagnostics.text());
    REQUIRE(&stage.execution() == running);
    // It runs, its read-backs arrive, and it can be gone on from: all its passes are where they were.
    stage.run(frame);
    CHECK(stage.value() == 5);
    CHECK(stage.pixels() == before);
    runtime::ReadBack& readBack = stage.execution().readBack();
    readBack.finish();
    REQUIRE(readBack.find("sum"));
    CHECK(readBack.find("sum")->frame == frame++);
    CHECK(readBack.find("sum")->number(0) == 5);
    file.write(own);
    REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
    running = &stage.execution();
    CHECK(running->passesPrepared() == 0);
    stage.run(frame++);
    CHECK(stage.pixels() == before);
  }
  CHECK(refused == buffers);
  stage.run(frame);
  CHECK(stage.value() == 50);
}

TEST_CASE("reload: what a shader declares is looked at again when it was edited") {
  const CleanScope clean;
  const TemporaryGraph file;
  const std::string block = "layout(std140) uniform Parameters { float amount; };\n";
  const auto shader = [&](const std::string& declared) {
    file.writeShader("math/own.frag.glsl",
                     declared + "out vec4 result;\nvoid main() { result = vec4(7.0); }\n");
  };
  shader(block);
  file.write(R"({ "name": "own", "resources": { "sum": { "texture": "r32f", "size": 4 } }, "passes": [
  { "name": "own", "type": "fullscreen", "shader": "math/own.frag.glsl", "write": { "result": "sum" },
    "parameters": { "amount": 3 } } ], "present": "sum" })");
  Stage stage(file.path());
  // Nothing uses the block, so the program is the same with and without it: only the text says whether it is declared.
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  shader("");
  CHECK_FALSE(stage.load());
  CHECK_MESSAGE(stage.diagnostics.contains(text::Code::parameterNotInShader), stage.diagnostics.text());
  shader(block);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  shader("// amount\n");
  CHECK_FALSE(stage.load());
  shader(block);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(0);
  CHECK(stage.value() == 7);
}

TEST_CASE("reload: changed parameters rerun what they reach and keep the rest") {
  const CleanScope clean;
  Stage stage(withSmallMaps("graphs/studio.json"));
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(0);
  const auto first = stage.pixels();
  CHECK(stage.ran("ibl.brdf_table"));

  stage.settings.sets = {{"exposure", "1.5"}};
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(1);
  CHECK(stage.pixels() != first);
  for (const char* kept :
       {"ibl.brdf_table", "ibl.daylight.daylight_sky", "ibl.irradiance_map", "ibl.specular_prefilter[1]"})
    CHECK_MESSAGE(!stage.ran(kept), kept);

  stage.settings.sets = {{"exposure", "1.5"}, {"sun_elevation", "10"}};
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(2);
  CHECK_FALSE(stage.ran("ibl.brdf_table"));
  for (const char* again : {"ibl.daylight.daylight_sky", "ibl.daylight.daylight_mips[2]",
                            "ibl.irradiance_map", "ibl.specular_prefilter[1]"})
    CHECK_MESSAGE(stage.ran(again), again);

  // What was made anew fades in for a quarter of a second of 60 frames, and only then is made again.
  constexpr std::uint32_t kFade = 15;
  for (std::uint32_t frame = 3; frame <= 2 + kFade; ++frame) stage.run(frame);
  stage.settings.sets = {};
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  for (std::uint32_t frame = 3 + kFade; frame <= 3 + 2 * kFade; ++frame) stage.run(frame);
  CHECK(stage.pixels() == first);
}

TEST_CASE("reload: a resize reruns what depends on the size, and only that") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/sizes.json", 16, 8, "scenes/empty.json");
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(0);
  CHECK(stage.value() == 16 + 100);
  CHECK(stage.ran("screen_once"));
  CHECK(stage.ran("screen_on_change"));
  CHECK(stage.ran("fixed_once"));
  stage.run(1);
  CHECK_FALSE(stage.ran("screen_once"));
  CHECK_FALSE(stage.ran("screen_on_change"));
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());  // nothing changed
  stage.run(2);
  CHECK_FALSE(stage.ran("screen_once"));
  CHECK_FALSE(stage.ran("fixed_once"));
  CHECK(stage.value() == 16 + 100);
  stage.settings.screenWidth = 32;
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(3);
  CHECK(stage.ran("screen_once"));
  CHECK(stage.ran("screen_on_change"));
  CHECK_FALSE(stage.ran("fixed_once"));
  CHECK(stage.value() == 32 + 100);
  stage.settings.disables = {"fixed_once"};  // its storage goes; on its return it must run again
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(4);
  CHECK(stage.value() == 32);
  stage.settings.disables = {};
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(5);
  CHECK(stage.ran("fixed_once"));
  CHECK(stage.value() == 32 + 100);
}

}  // namespace frame_reload_test
