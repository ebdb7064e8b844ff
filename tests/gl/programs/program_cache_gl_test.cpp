#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>

#include "engine/gl/programs/program_cache.h"
#include "engine/glsl/interface.h"
#include "tests/gl/documented.h"
#include "tests/gl/gl_test.h"
#include "tests/skip.h"
#include "tests/temporary_folder.h"

using namespace weft::gl;
using namespace weft::glsl;
using weft::gl::test::CleanScope;
using weft::gl::test::context;
using weft::text::Code;
using weft::text::Diagnostics;
namespace fs = std::filesystem;

namespace {

constexpr const char* kShader =
    "layout(local_size_x = 1) in;\nlayout(std430) buffer result { uint value; };\n"
    "void main() {\n#ifdef N\n  value = uint(N);\n#endif\n}\n";

ProgramRequest variantOf(int n) {
  ProgramRequest request;
  request.stages = {{GL_COMPUTE_SHADER, "n.comp.glsl", ""}};
  request.defines = {{"N", std::to_string(n)}};
  request.label = "variant " + std::to_string(n);
  request.pass = "count";
  return request;
}

std::uint32_t runVariant(const Variant& variant) {
  Diagnostics diagnostics;
  const std::uint32_t zero = 0;
  auto buffer = Buffer::create(4, 0, "result", diagnostics, &zero);
  REQUIRE(buffer);
  const Block* block = variant.program.reflection().findStorageBlock("result");
  REQUIRE(block);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, block->binding, buffer->id());
  glUseProgram(variant.program.id());
  glDispatchCompute(1, 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glUseProgram(0);
  std::uint32_t value = 0;
  const auto bytes = readBuffer(buffer->id(), 0, 4);
  std::memcpy(&value, bytes.data(), 4);
  return value;
}

std::vector<fs::path> filesIn(const std::string& folder) {
  std::vector<fs::path> files;
  if (fs::exists(folder))
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  return files;
}

bool hasBinaries() {
  return context().device().hasProgramBinaries;
}

void skipBinaries() {
  weft::test::skipCase("the driver offers no program binaries; Mesa offers them with its shader cache on");
}

struct Fixture {
  CleanScope clean;
  TemporaryFolder folder;
  SourceLoader loader{{folder.path().string()}};
  Diagnostics diagnostics;
  Fixture() { folder.write("n.comp.glsl", kShader); }
};

}  // namespace

TEST_CASE_FIXTURE(Fixture, "when there is no room, what nobody holds goes, and counters are exact") {
  ProgramCache cache(context().device(), loader, {.capacity = 2, .folder = ""});
  const auto one = cache.get(variantOf(1), diagnostics);
  REQUIRE_MESSAGE(one, diagnostics.text());
  REQUIRE(cache.get(variantOf(2), diagnostics));
  CHECK(cache.get(variantOf(1), diagnostics) == one);
  REQUIRE(cache.get(variantOf(3), diagnostics));  // 2 goes
  CHECK(cache.get(variantOf(1), diagnostics) == one);
  CHECK(cache.stats().hits == 2);
  CHECK(cache.stats().misses == 3);
  CHECK(cache.stats().compilations == 3);
  REQUIRE(cache.get(variantOf(2), diagnostics));  // 3 goes
  CHECK(cache.stats().compilations == 4);
  CHECK(cache.stats().binaryLoads + cache.stats().binaryRejects + cache.stats().binaryWrites == 0);
  CHECK(runVariant(*one) == 1);
  CHECK(diagnostics.empty());
}

TEST_CASE_FIXTURE(Fixture, "what somebody holds is not made again, however many are in use") {
  ProgramCache cache(context().device(), loader, {.capacity = 2, .folder = ""});
  std::vector<std::shared_ptr<const Variant>> held;
  for (int n = 0; n < 4; ++n) held.push_back(cache.get(variantOf(n), diagnostics));
  for (int n = 0; n < 4; ++n)
    CHECK(cache.get(variantOf(n), diagnostics) == held[static_cast<std::size_t>(n)]);
  CHECK(cache.stats().compilations == 4);
  CHECK(cache.stats().misses == 4);
  held.clear();
  REQUIRE(cache.get(variantOf(4), diagnostics));  // the others go
  REQUIRE(cache.get(variantOf(0), diagnostics));
  CHECK(cache.stats().compilations == 6);
}

TEST_CASE_FIXTURE(Fixture, "an evicted variant comes back from disk without a compile, also in a new cache" *
                               doctest::test_suite("binaries")) {
  if (!hasBinaries()) return skipBinaries();
  const std::string disk = folder.at("cache/binaries");
  {
    ProgramCache cache(context().device(), loader, {.capacity = 1, .folder = disk});
    for (const int n : {1, 2, 1, 2}) {
      const auto variant = cache.get(variantOf(n), diagnostics);
      REQUIRE(variant);
      CHECK(runVariant(*variant) == static_cast<std::uint32_t>(n));
    }
    CHECK(cache.stats().compilations == 2);
    CHECK(cache.stats().binaryWrites == 2);
    CHECK(cache.stats().binaryLoads == 2);
    CHECK(cache.stats().binaryRejects == 0);
  }
  CHECK(filesIn(disk).size() == 2);
  ProgramCache warm(context().device(), loader, {.capacity = 32, .folder = disk});
  REQUIRE(warm.get(variantOf(1), diagnostics));
  CHECK(warm.stats().compilations == 0);
  CHECK(warm.stats().binaryLoads == 1);
}

TEST_CASE_FIXTURE(Fixture, "a damaged or foreign binary is a miss, is written anew, and is no error" *
                               doctest::test_suite("binaries")) {
  if (!hasBinaries()) return skipBinaries();
  const std::string disk = folder.at("cache");
  const auto fill = [&] {
    ProgramCache cache(context().device(), loader, {.capacity = 4, .folder = disk});
    const auto variant = cache.get(variantOf(7), diagnostics);
    REQUIRE(variant);
    CHECK(runVariant(*variant) == 7);
    return cache.stats();
  };
  fill();
  const auto files = filesIn(disk);
  REQUIRE(files.size() == 1);
  std::string good(fs::file_size(files[0]), '\0');
  std::ifstream(files[0], std::ios::binary).read(good.data(), static_cast<std::streamsize>(good.size()));
  std::vector<std::string> bad{"", good.substr(0, 20), good.substr(0, good.size() / 2), good + "x",
                               std::string(good.size(), '\xff')};
  std::string flipped = good;
  flipped[flipped.size() - 100] = static_cast<char>(flipped[flipped.size() - 100] ^ 0x10);
  bad.push_back(flipped);
  std::string foreignFormat = good;
  foreignFormat[0] = static_cast<char>(foreignFormat[0] ^ 0x55);  // the format in the header
  bad.push_back(foreignFormat);
  for (const std::string& bytes : bad) {
    std::ofstream(files[0], std::ios::binary | std::ios::trunc) << bytes;
    const ProgramCacheStats stats = fill();
    CHECK(stats.binaryRejects == 1);
    CHECK(stats.binaryLoads == 0);
    CHECK(stats.compilations == 1);
    CHECK(stats.binaryWrites == 1);
    const ProgramCacheStats again = fill();
    CHECK(again.binaryLoads == 1);
    CHECK(again.compilations == 0);
  }
  fs::remove(files[0]);
  fs::create_directory(files[0]);  // neither readable nor writable as a file
  const ProgramCacheStats stats = fill();
  CHECK(stats.compilations == 1);
  CHECK(stats.binaryWrites == 0);
  CHECK(diagnostics.empty());
}

TEST_CASE_FIXTURE(Fixture, "a binary of another driver or backend is not even looked at" *
                               doctest::test_suite("binaries")) {
  if (!hasBinaries()) return skipBinaries();
  const std::string disk = folder.at("cache");
  ProgramCache(context().device(), loader, {.capacity = 4, .folder = disk}).get(variantOf(1), diagnostics);
  DeviceInfo other = context().device();
  other.driverKey = "0123456789abcdef";
  ProgramCache cache(other, loader, {.capacity = 4, .folder = disk});
  REQUIRE(cache.get(variantOf(1), diagnostics));
  CHECK(cache.stats().binaryLoads + cache.stats().binaryRejects == 0);
  CHECK(cache.stats().compilations == 1);
}

TEST_CASE_FIXTURE(
    Fixture, "a variant that does not compile says why, every time, compiles once, and heals with its file") {
  ProgramCache cache(context().device(), loader, {.capacity = 4, .folder = ""});
  const auto good = cache.get(variantOf(1), diagnostics);
  REQUIRE(good);
  folder.write("n.comp.glsl", "layout(local_size_x = 1) in;\nvoid main() {\n  broken\n}\n");
  for (int i = 0; i < 2; ++i) {
    Diagnostics errors;
    CHECK_FALSE(cache.get(variantOf(1), errors));
    REQUIRE(errors.contains(Code::shaderDoesNotCompile));
    CHECK(*errors.items()[0].place.file == folder.at("n.comp.glsl"));
    CHECK(errors.items()[0].pass == "count");
  }
  CHECK(runVariant(*good) == 1);  // the last good one is still there for who holds it
  CHECK(cache.stats().compilations == 2);
  CHECK(cache.stats().failures == 1);
  folder.write("n.comp.glsl", kShader);
  CHECK(cache.get(variantOf(1), diagnostics) == good);
  fs::remove(folder.at("n.comp.glsl"));
  Diagnostics missing;
  CHECK_FALSE(cache.get(variantOf(1), missing));
  CHECK(missing.contains(Code::unreadableShader));
  CHECK(missing.items()[0].pass == "count");
}

TEST_CASE_FIXTURE(Fixture, "ten thousand random requests compile each combination once" *
                               doctest::test_suite("binaries")) {
  if (!hasBinaries()) return skipBinaries();
  ProgramCache cache(context().device(), loader, {.capacity = 8, .folder = folder.at("cache")});
  std::mt19937 random(7);
  std::set<int> asked;
  for (int i = 0; i < 10000; ++i) {
    // Mostly a few favorites, now and then one of twelve.
    const int n = static_cast<int>(random() % 50 == 0 ? random() % 12 : random() % 6);
    asked.insert(n);
    REQUIRE(cache.get(variantOf(n), diagnostics));
  }
  const ProgramCacheStats& s = cache.stats();
  CHECK(s.compilations == asked.size());
  CHECK(s.hits + s.misses == 10000);
  CHECK(s.misses == s.compilations + s.binaryLoads);
  CHECK(s.binaryRejects == 0);
}

TEST_CASE_FIXTURE(Fixture, "names are held against the source, not against what the linker kept") {
  folder.write("used.comp.glsl",
               "layout(local_size_x = 1) in;\nuniform sampler2D unused_slot;\nvoid main() {}\n");
  ProgramCache cache(context().device(), loader, {});
  ProgramRequest request;
  request.stages = {{GL_COMPUTE_SHADER, "used.comp.glsl", ""}};
  const auto variant = cache.get(request, diagnostics);
  REQUIRE(variant);
  CHECK_FALSE(variant->program.reflection().findSampler("unused_slot"));
  const weft::glsl::Interface& interface = variant->stages[0].source->interfaceWith(variant->defines);
  CHECK(interface.find("unused_slot"));
  CHECK_FALSE(interface.find("no_slot"));
}

namespace {

ProgramRequest fragmentOf(const std::string& text) {
  ProgramRequest request;
  request.stages = {{GL_VERTEX_SHADER, "triangle", "void main() { gl_Position = vec4(0.0); }\n"},
                    {GL_FRAGMENT_SHADER, "paint.frag.glsl", text}};
  request.outputs = {"result"};
  request.pass = "paint";
  return request;
}

constexpr const char* kUnusual =
    "out vec4 result;\nvoid main() {\n  float a[200];\n  result = vec4(a[int(gl_FragCoord.x)]);\n}\n";

}  // namespace

TEST_CASE_FIXTURE(Fixture, "what is too large is not compiled, and reported again without counting") {
  ProgramCache cache(context().device(), loader, {.capacity = 2, .folder = ""});
  std::string sum = "out vec4 result;\nvoid main() {\n  float a = 1.0;\n  result = vec4(";
  for (int i = 0; i < 50000; ++i) sum += "a + ";
  for (int i = 0; i < 2; ++i) {
    Diagnostics said;
    CHECK_FALSE(cache.get(fragmentOf(sum + "a);\n}\n"), said));
    REQUIRE(said.size() == 1);
    CHECK(said.items()[0].code == Code::shaderTooLarge);
    CHECK(said.items()[0].place.line == 4);
    CHECK(said.items()[0].pass == "paint");
  }
  CHECK(cache.stats().compilations == 0);
  CHECK(cache.stats().refusals == 1);
  CHECK(cache.stats().hits == 1);
}

TEST_CASE_FIXTURE(Fixture, "a process that dies over a program is reported, one that cannot be had is not") {
  const ProgramRequest request = fragmentOf(kUnusual);
  // Says that it has opened a context, takes its input, and dies.
  ProgramCache dies(
      context().device(), loader,
      {.capacity = 2, .folder = "", .trial = {"/bin/sh", "-c", "printf o; cat >/dev/null; kill -SEGV $$"}});
  CHECK_FALSE(dies.get(request, diagnostics));
  REQUIRE(diagnostics.size() == 1);
  const weft::text::Diagnostic& told = diagnostics.items()[0];
  CHECK(told.code == Code::driverDied);
  CHECK(told.message == "the driver did not survive compiling this shader");
  CHECK(*told.place.file == "paint.frag.glsl");
  CHECK(told.found.starts_with("signal 11"));
  CHECK(dies.stats().trials == 1);
  CHECK(dies.stats().refusals == 1);
  CHECK(dies.stats().compilations == 0);
  Diagnostics again;
  CHECK_FALSE(dies.get(request, again));
  CHECK(again.contains(Code::driverDied));
  CHECK(dies.stats().trials == 1);
  for (const std::vector<std::string>& trial :
       {std::vector<std::string>{"/no/such/program"}, {"/bin/false"}, {}}) {
    ProgramCache unknown(context().device(), loader, {.capacity = 2, .folder = "", .trial = trial});
    Diagnostics none;
    CHECK(unknown.get(request, none));
    CHECK_MESSAGE(none.empty(), none.text());
    CHECK(unknown.stats().trials == (trial.empty() ? 0 : 1));
  }
  // A usual one is not tried.
  Diagnostics none;
  CHECK(dies.get(fragmentOf("out vec4 result;\nvoid main() { result = vec4(1.0); }\n"), none));
  CHECK(dies.stats().trials == 1);
}

TEST_CASE_FIXTURE(Fixture, "a process that does not come to an end is ended") {
  ProgramCache cache(context().device(), loader,
                     {.capacity = 2,
                      .folder = "",
                      .trial = {"/bin/sh", "-c", "printf o; cat >/dev/null; exec sleep 1000"},
                      .trialSeconds = 1});
  CHECK_FALSE(cache.get(fragmentOf(kUnusual), diagnostics));
  CHECK(diagnostics.contains(Code::driverDied));
}

TEST_CASE_FIXTURE(
    Fixture,
    "each of many programs has its own time, of the processor: no verdict hangs on others or on load") {
  // Each takes 0.6 of its one second, and waits for longer than that.
  const char* const kBusy =
      "printf o; cat >/dev/null; sleep 1.1\n"
      "while read -r _ _ _ _ _ _ _ _ _ _ _ _ _ user system _ </proc/$$/stat && [ $((user + system)) -lt 60 "
      "]; do :; done\n"
      "printf d";
  ProgramCache cache(context().device(), loader,
                     {.capacity = 8, .folder = "", .trial = {"/bin/sh", "-c", kBusy}, .trialSeconds = 1});
  for (const int size : {200, 201}) {
    const std::string text = fmt::format(
        "out vec4 result;\nvoid main() {{\n  float a[{}];\n  result = vec4(a[int(gl_FragCoord.x)]);\n}}\n",
        size);
    CHECK(cache.get(fragmentOf(text), diagnostics));
  }
  CHECK_MESSAGE(diagnostics.empty(), diagnostics.text());
  CHECK(cache.stats().trials == 2);
}

TEST_CASE_FIXTURE(Fixture, "functions in a circle are reported where they stand") {
  SourceLoader bad({"tests/bad_shaders"});
  ProgramCache cache(context().device(), bad, {.capacity = 2, .folder = ""});
  ProgramRequest request = fragmentOf("");
  request.stages[1] = {GL_FRAGMENT_SHADER, "w104_circle.frag.glsl", ""};
  request.pass = "";
  CHECK_FALSE(cache.get(request, diagnostics));
  CHECK(diagnostics.size() == 1);
  weft::gl::test::checkDocumented(diagnostics, Code::shaderDoesNotCompile);
}

TEST_CASE_FIXTURE(Fixture, "the folder of binaries is brought below its limit, and what is used stays in it" *
                               doctest::test_suite("binaries")) {
  if (!hasBinaries()) return skipBinaries();
  const std::string disk = folder.at("bounded");
  std::uint64_t each = 0;
  {
    ProgramCache cache(context().device(), loader, {.folder = disk});
    REQUIRE(cache.get(variantOf(0), diagnostics));
    each = fs::file_size(filesIn(disk).at(0));
  }
  const fs::path first = filesIn(disk).at(0);
  for (int n = 1; n <= 40; ++n) {
    ProgramCache cache(context().device(), loader, {.folder = disk, .folderBytes = 8 * each + each / 2});
    REQUIRE(cache.get(variantOf(n), diagnostics));
    REQUIRE(cache.get(variantOf(0), diagnostics));
    CHECK(cache.stats().binaryLoads == 1);
    // Files of one moment have one time: those before are made older.
    for (const fs::path& file : filesIn(disk))
      fs::last_write_time(file, fs::last_write_time(file) - std::chrono::seconds(file == first ? 1 : 10));
    CHECK(filesIn(disk).size() <= 9);
  }
  CHECK(fs::exists(first));
}
