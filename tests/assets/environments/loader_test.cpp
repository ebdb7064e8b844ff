#include <doctest/doctest.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <semaphore>
#include <sstream>
#include <thread>

#include "engine/assets/environments/environment_map.h"
#include "engine/assets/images/half.h"
#include "engine/text/files/file_access.h"
#include "tests/assets/images/save_hdr.h"
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

// Holds the loader thread at the first stage of one kind until it is let go.
struct Gate {
  LoadStage at = LoadStage::reading;
  std::binary_semaphore reached{0}, go{0};
  std::atomic<bool> used{false};
  void operator()(LoadStage stage) {
    if (stage != at || used.exchange(true)) return;
    reached.release();
    go.acquire();
  }
};

static void checkSame(const EnvironmentMap& map, const ImageF& image) {
  CHECK(map.width == static_cast<std::uint32_t>(image.width));
  CHECK(map.height == static_cast<std::uint32_t>(image.height));
  std::vector<std::uint16_t> expected(image.texels.size());
  for (std::size_t i = 0; i < expected.size(); ++i) expected[i] = floatToHalf(image.texels[i]);
  CHECK(map.texels == expected);
}

TEST_CASE("a loaded environment is what the synchronous path gives, rounded to halves, for .hdr and .exr") {
  const TemporaryFolder folder;
  text::Diagnostics diagnostics;
  const std::string exr = folder.at("a.exr");
  ImageF odd = makeSky(67, 33, 700.0f);  // beyond 65504 in places; a size that no portion divides
  odd.texels[5] = -1;
  REQUIRE(saveExr(exr, odd, diagnostics));
  Loader loader;
  for (const std::string& path : {writeHdr(folder, "a.hdr", 512, 300), exr}) {
    const auto result = loader.wait(loader.request(path));
    REQUIRE(result);
    REQUIRE(result->as<EnvironmentMap>());
    text::Diagnostics said;
    const auto image = loadEnvironment(path, said);
    REQUIRE(image);
    checkSame(*result->as<EnvironmentMap>(), *image);
    CHECK(result->diagnostics.text() == said.text());
    CHECK(loader.progress(result->ticket).stage == LoadStage::idle);
  }
  const std::string real = std::string(WEFT_SOURCE_DIR) + "/scenes/environments/spiaggia_di_mondello_1k.hdr";
  checkSame(*loader.wait(loader.request(real))->as<EnvironmentMap>(), *loadEnvironment(real, diagnostics));
}

TEST_CASE("an RGB picture in memory becomes the same map as its file") {
  const TemporaryFolder folder;
  text::Diagnostics diagnostics;
  const auto image = loadImage(writeHdr(folder, "a.hdr", 40, 20), diagnostics);
  REQUIRE(image->channels == 3);
  CHECK(toEnvironmentMap(*image).texels == loadEnvironmentMap(folder.at("a.hdr"), diagnostics)->texels);
}

TEST_CASE("many requests finish in the order they were made, and no more than the bound are taken") {
  const TemporaryFolder folder;
  Gate gate;
  Loader loader([&](std::uint64_t, LoadStage stage) { gate(stage); });
  std::vector<std::uint64_t> tickets;
  for (std::size_t i = 0; i < Loader::kMaxRequests; ++i)
    tickets.push_back(
        loader.request(writeHdr(folder, std::to_string(i) + ".hdr", 8 + static_cast<int>(i), 8)));
  gate.reached.acquire();
  CHECK(loader.request(folder.at("0.hdr")) == 0);
  CHECK(!loader.poll());
  CHECK(loader.progress(tickets[0]).stage == LoadStage::reading);
  CHECK(loader.progress(tickets[5]).stage == LoadStage::waiting);
  CHECK(loader.progress(tickets.back() + 1).stage == LoadStage::idle);
  gate.go.release();
  auto last = loader.wait(tickets.back());
  REQUIRE(last);
  for (std::size_t i = 0; i + 1 < tickets.size(); ++i) {
    const auto result = loader.poll();  // all before the last are finished
    REQUIRE(result);
    CHECK(result->ticket == tickets[i]);
    REQUIRE(result->as<EnvironmentMap>());
    CHECK(result->as<EnvironmentMap>()->width == 8 + i);
  }
  CHECK(!loader.poll());
  CHECK(!loader.wait(tickets[0]));
  CHECK(loader.request(folder.at("0.hdr")) != 0);
}

TEST_CASE("a request replaces those of its channel: waiting, running and finished ones, and no other's") {
  const TemporaryFolder folder;
  const std::string a = writeHdr(folder, "a.hdr", 16, 8), b = writeHdr(folder, "b.hdr", 24, 8),
                    c = writeHdr(folder, "c.hdr", 32, 8);
  for (const LoadStage stage : {LoadStage::reading, LoadStage::decoding, LoadStage::converting}) {
    Gate gate{.at = stage};
    Loader loader([&](std::uint64_t, LoadStage at) { gate(at); });
    const std::uint64_t running = loader.request(a, 1);
    gate.reached.acquire();
    const std::uint64_t other = loader.request(a, 2), waiting = loader.request(b, 1),
                        wanted = loader.request(c, 1);
    gate.go.release();
    CHECK(!loader.wait(running));
    CHECK(!loader.wait(waiting));
    const auto result = loader.wait(wanted);
    REQUIRE(result);
    CHECK(result->as<EnvironmentMap>()->width == 32);
    CHECK(loader.wait(other)->as<EnvironmentMap>()->width == 16);
    CHECK(!loader.poll());
  }
  Loader loader;
  const std::uint64_t finished = loader.request(a, 1);
  CHECK(loader.wait(loader.request(b, 2)));  // after it
  const std::uint64_t wanted = loader.request(c, 1);
  CHECK(!loader.wait(finished));
  CHECK(loader.wait(wanted)->as<EnvironmentMap>()->width == 32);
}

TEST_CASE("a canceled request has no result, and the next one is served") {
  const TemporaryFolder folder;
  Gate gate;
  Loader loader([&](std::uint64_t, LoadStage at) { gate(at); });
  const std::uint64_t running = loader.request(writeHdr(folder, "a.hdr", 16, 8));
  gate.reached.acquire();
  const std::uint64_t next = loader.request(folder.at("a.hdr"));
  loader.cancel(running);
  loader.cancel(12345);
  gate.go.release();
  CHECK(loader.wait(next));
  CHECK(!loader.poll());
}

TEST_CASE("a loader may die at any stage of a load, with requests waiting and results not fetched") {
  const TemporaryFolder folder;
  const std::string path = writeHdr(folder, "a.hdr", 64, 32);
  for (const LoadStage stage : {LoadStage::reading, LoadStage::decoding, LoadStage::converting}) {
    Gate gate{.at = stage};
    {
      Loader loader([&](std::uint64_t, LoadStage at) { gate(at); });
      loader.request(path);
      loader.request(path);
      gate.reached.acquire();
      gate.go.release();
    }
    Loader unfetched;
    const std::uint64_t first = unfetched.request(path);
    unfetched.wait(unfetched.request(path));
    CHECK(first != 0);
  }
  const Loader unused;
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
  Loader loader;
  for (const std::string& path : paths) {
    CAPTURE(path);
    const auto result = loader.wait(loader.request(path));
    REQUIRE(result);
    CHECK(!result->as<EnvironmentMap>());
    text::Diagnostics said;
    CHECK(!loadEnvironment(path, said));
    CHECK(said.hasErrors());
    CHECK(result->diagnostics.text() == said.text());
    CHECK(result->diagnostics.text().find(path) != std::string::npos);
  }
  // Whatever a flipped byte does, it does the same on the thread.
  const auto flipped = loader.wait(loader.request(folder.write("flipped.hdr", damaged)));
  text::Diagnostics said;
  CHECK(loadEnvironment(folder.at("flipped.hdr"), said).has_value() ==
        (flipped->as<EnvironmentMap>() != nullptr));
  CHECK(flipped->diagnostics.text() == said.text());
  CHECK(loader.wait(loader.request(good))->as<EnvironmentMap>());
}

TEST_CASE("progress grows through the stages of a load and never falls within it") {
  const TemporaryFolder folder;
  const std::string path = writeHdr(folder, "a.hdr", 1024, 512);
  std::vector<std::pair<LoadStage, double>> seen;
  text::Diagnostics diagnostics;
  REQUIRE(loadEnvironmentMap(path, diagnostics, [&](LoadStage stage, double done) {
    seen.emplace_back(stage, done);
    return true;
  }));
  CHECK(std::ranges::is_sorted(seen));
  CHECK(seen.front() == std::pair{LoadStage::reading, 0.0});
  CHECK(seen.back().first == LoadStage::converting);
  CHECK(std::ranges::count(seen, LoadStage::reading, &std::pair<LoadStage, double>::first) > 2);

  Loader loader;
  const std::uint64_t ticket = loader.request(path);
  float before = 0;
  std::optional<LoadQueue::Result> result;
  while (!(result = loader.poll())) {
    const LoadProgress now = loader.progress(ticket);
    if (now.stage == LoadStage::idle) continue;  // finished a moment ago
    CHECK(now.done >= before);
    CHECK(now.done <= 1);
    before = now.done;
  }
  CHECK(result->as<EnvironmentMap>());
}

TEST_CASE("progress of a pipe, which has no size, begins with what came of it") {
  const TemporaryFolder folder;
  std::ostringstream whole;
  whole << std::ifstream(writeHdr(folder, "a.hdr", 32, 16), std::ios::binary).rdbuf();
  const std::string bytes = whole.str(), pipe = folder.at("pipe.hdr");
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  text::chooseFile(pipe);
  std::binary_semaphore seen{0};
  bool inTime = false;
  std::jthread writer([&] {
    std::ofstream out(pipe, std::ios::binary);
    out << bytes.substr(0, bytes.size() / 2) << std::flush;
    inTime = seen.try_acquire_for(std::chrono::seconds(60));  // else half of it would never be told of
    out << bytes.substr(bytes.size() / 2);
  });
  double last = 0;
  text::Diagnostics diagnostics;
  const auto map = loadEnvironmentMap(pipe, diagnostics, [&](LoadStage stage, double done) {
    if (stage != LoadStage::reading) return true;
    CHECK(done >= last);
    CHECK(done < 1);
    if (last == 0 && done > 0) seen.release();
    last = done;
    return true;
  });
  writer.join();
  CHECK(inTime);
  REQUIRE_MESSAGE(map, diagnostics.text());
  CHECK(map->width == 32);
}

TEST_CASE("an observer that gives up ends a load at every step, without a result or a report") {
  const TemporaryFolder folder;
  const std::string path = writeHdr(folder, "a.hdr", 600, 300);
  int steps = 0;
  text::Diagnostics diagnostics;
  REQUIRE(loadEnvironmentMap(path, diagnostics, [&](LoadStage, double) { return ++steps > 0; }));
  REQUIRE(steps > 5);
  for (int last = 1; last <= steps; ++last) {
    int step = 0;
    CHECK(!loadEnvironmentMap(path, diagnostics, [&](LoadStage, double) { return ++step < last; }));
    CHECK(step == last);
  }
  CHECK(diagnostics.empty());
}
