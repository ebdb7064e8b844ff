#include "engine/assets/loading/loader.h"

#include <Imath/half.h>
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <semaphore>
#include <sstream>
#include <stop_token>
#include <thread>

#include "engine/assets/images/image.h"
#include "engine/text/files/file.h"
#include "tests/assets/images/save_hdr.h"
#include "tests/load_image.h"
#include "tests/temporary_folder.h"

using namespace weft;
using namespace weft::assets;

static ImageF makeSky(int width, int height, float scale) {
  ImageF image{width, height, 3, {}};
  for (int i = 0; i < width * height * 3; ++i) image.texels.push_back(scale * static_cast<float>(i % 97));
  return image;
}

static std::string writeHdr(const TemporaryFolder& folder, const std::string& name, int width, int height,
                            float scale = 0.25f) {
  text::Diagnostics diagnostics;
  REQUIRE(saveHdr(folder.at(name), makeSky(width, height, scale), diagnostics));
  return folder.at(name);
}

// Holds the loader thread, before or after its first load, until it is let go.
struct Gate {
  bool after = false;
  std::binary_semaphore reached{0}, go{0};
  std::atomic<bool> used{false};
  void pass(bool loaded) {
    if (loaded != after || used.exchange(true)) return;
    reached.release();
    go.acquire();
  }
};

// What a window's loader of environments does. `gate` may be null.
static LoadJob environmentJob(Gate* gate = nullptr) {
  return [gate](const std::string& path, text::Diagnostics& diagnostics,
                const std::stop_token& stop) -> std::shared_ptr<const void> {
    if (gate) gate->pass(false);
    auto map = loadEnvironmentMap(path, diagnostics, stop);
    if (gate) gate->pass(true);
    return map ? std::make_shared<const EnvironmentMap>(std::move(*map)) : nullptr;
  };
}

static Loader::Result waitFor(Loader& loader) {
  for (;;) {
    if (auto result = loader.poll()) return std::move(*result);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

static Loader::Result load(Loader& loader, const std::string& path) {
  loader.request(path);
  return waitFor(loader);
}

static void checkSame(const EnvironmentMap& map, const ImageF& image) {
  CHECK(map.width == static_cast<std::uint32_t>(image.width));
  CHECK(map.height == static_cast<std::uint32_t>(image.height));
  std::vector<std::uint16_t> expected(image.texels.size());
  for (std::size_t i = 0; i < expected.size(); ++i) expected[i] = imath_float_to_half(image.texels[i]);
  CHECK(map.texels == expected);
}

TEST_CASE("a loaded environment is what the synchronous path gives, rounded to halves, for .hdr and .exr") {
  const TemporaryFolder folder;
  text::Diagnostics diagnostics;
  const std::string exr = folder.at("a.exr");
  ImageF odd = makeSky(67, 33, 700.0f);  // beyond 65504 in places
  odd.texels[5] = -1;
  REQUIRE(saveExr(exr, odd, diagnostics));
  Loader loader(environmentJob());
  for (const std::string& path : {writeHdr(folder, "a.hdr", 512, 300), exr}) {
    const auto result = load(loader, path);
    REQUIRE(result.as<EnvironmentMap>());
    text::Diagnostics said;
    const auto image = loadEnvironment(path, said);
    REQUIRE(image);
    checkSame(*result.as<EnvironmentMap>(), *image);
    CHECK(result.path == path);
    CHECK(result.diagnostics.text() == said.text());
  }
  const std::string real = std::string(WEFT_SOURCE_DIR) + "/scenes/environments/spiaggia_di_mondello_1k.hdr";
  checkSame(*load(loader, real).as<EnvironmentMap>(), *loadEnvironment(real, diagnostics));
}

TEST_CASE("an RGB picture in memory becomes the same map as its file") {
  const TemporaryFolder folder;
  text::Diagnostics diagnostics;
  const auto image = loadImage(writeHdr(folder, "a.hdr", 40, 20), diagnostics);
  REQUIRE(image->channels == 3);
  CHECK(toEnvironmentMap(*image).texels == loadEnvironmentMap(folder.at("a.hdr"), diagnostics)->texels);
}

TEST_CASE("a request replaces the one before, whether it waits, runs or is finished") {
  const TemporaryFolder folder;
  const std::string a = writeHdr(folder, "a.hdr", 16, 8), b = writeHdr(folder, "b.hdr", 24, 8),
                    c = writeHdr(folder, "c.hdr", 32, 8);
  for (const bool after : {false, true}) {
    Gate gate{.after = after};
    Loader loader(environmentJob(&gate));
    loader.request(a);
    gate.reached.acquire();
    loader.request(b);
    CHECK(!loader.poll());
    loader.request(c);
    gate.go.release();
    CHECK(waitFor(loader).as<EnvironmentMap>()->width == 32);
    CHECK(!loader.poll());
  }
  Gate gate{.after = true};
  Loader loader(environmentJob(&gate));
  loader.request(a);
  gate.reached.acquire();
  gate.go.release();
  std::this_thread::sleep_for(std::chrono::milliseconds(20));  // its result is there, as a rule
  CHECK(load(loader, c).as<EnvironmentMap>()->width == 32);
}

TEST_CASE("a canceled request has no result, and the next one is served") {
  const TemporaryFolder folder;
  Gate gate;
  Loader loader(environmentJob(&gate));
  loader.request(writeHdr(folder, "a.hdr", 16, 8));
  gate.reached.acquire();
  loader.cancel();
  gate.go.release();
  CHECK(!loader.poll());
  CHECK(load(loader, folder.at("a.hdr")).as<EnvironmentMap>());
  CHECK(!loader.poll());
}

TEST_CASE("a loader may die at any stage of a load, with a request waiting or a result not fetched") {
  const TemporaryFolder folder;
  const std::string path = writeHdr(folder, "a.hdr", 64, 32);
  for (const bool after : {false, true}) {
    Gate gate{.after = after};
    {
      Loader loader(environmentJob(&gate));
      loader.request(path);
      gate.reached.acquire();
      loader.request(path);
      gate.go.release();
    }
    Loader unfetched(environmentJob());
    unfetched.request(path);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  const Loader unused(environmentJob());
}

TEST_CASE(
    "a file that cannot be read is a result with the diagnostics of the synchronous path, and later ones "
    "load") {
  const TemporaryFolder folder;
  const std::string good = writeHdr(folder, "good.hdr", 64, 32);
  std::ifstream file(good, std::ios::binary);
  std::stringstream bytes;
  bytes << file.rdbuf();
  const std::string whole = bytes.str();
  std::string damaged = whole;
  damaged[whole.size() / 2] = '\x7f';
  const std::vector<std::string> paths = {folder.at("missing.hdr"),
                                          folder.at("."),
                                          folder.write("empty.hdr", ""),
                                          folder.write("half.hdr", whole.substr(0, whole.size() / 2)),
                                          folder.write("text.exr", "not a picture"),
                                          folder.write("a.xyz", "x")};
  Loader loader(environmentJob());
  for (const std::string& path : paths) {
    CAPTURE(path);
    const auto result = load(loader, path);
    CHECK(!result.as<EnvironmentMap>());
    text::Diagnostics said;
    CHECK(!loadEnvironment(path, said));
    CHECK(said.hasErrors());
    CHECK(result.diagnostics.text() == said.text());
    CHECK(result.diagnostics.text().find(path) != std::string::npos);
  }
  // Whatever a flipped byte does, it does the same on the thread.
  const auto flipped = load(loader, folder.write("flipped.hdr", damaged));
  text::Diagnostics said;
  CHECK(loadEnvironment(folder.at("flipped.hdr"), said).has_value() ==
        (flipped.as<EnvironmentMap>() != nullptr));
  CHECK(flipped.diagnostics.text() == said.text());
  CHECK(load(loader, good).as<EnvironmentMap>());
}

TEST_CASE("a load that is stopped ends without a result or a report, also while its pipe has nothing") {
  const TemporaryFolder folder;
  std::ostringstream whole;
  whole << std::ifstream(writeHdr(folder, "a.hdr", 32, 16), std::ios::binary).rdbuf();
  const std::string bytes = whole.str(), pipe = folder.at("pipe.hdr");
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  text::chooseFile(pipe);
  std::binary_semaphore ended{0};
  bool inTime = false;
  std::stop_source source;
  std::jthread writer([&] {
    std::ofstream out(pipe, std::ios::binary);
    out << bytes.substr(0, bytes.size() / 2) << std::flush;
    source.request_stop();
    inTime = ended.try_acquire_for(std::chrono::seconds(60));  // else it waits for the rest
  });
  text::Diagnostics diagnostics;
  CHECK(!loadEnvironmentMap(pipe, diagnostics, source.get_token()));
  ended.release();
  writer.join();
  CHECK(inTime);
  CHECK(!loadEnvironmentMap(folder.at("a.hdr"), diagnostics, source.get_token()));
  CHECK(diagnostics.empty());
}

TEST_CASE("a load may be stopped at any moment") {
  const TemporaryFolder folder;
  const std::string path = writeHdr(folder, "a.hdr", 1024, 512);
  bool loaded = false;
  for (auto wait = std::chrono::microseconds(50); !loaded; wait *= 2) {
    text::Diagnostics diagnostics;
    std::stop_source source;
    const std::jthread stopper([&] {
      std::this_thread::sleep_for(wait);
      source.request_stop();
    });
    loaded = loadEnvironmentMap(path, diagnostics, source.get_token()).has_value();
    CHECK(diagnostics.empty());
  }
}
