// Metals that touch or nearly do, pixel by pixel against paths.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/theory/neighbors/metals.h"
#include "tests/theory/statistics.h"

namespace neighbors_metals_test {

using namespace weft::theory;

namespace {

constexpr std::uint32_t kStep = 4;  // one of so many pixels along a side
constexpr int kPaths = 32;          // along a side of a pixel

struct Off {
  std::vector<double> values;
  double found = 0, truth = 0;  // sums of radiance
  void add(const glm::dvec3& is, const glm::dvec3& should) {
    for (int c = 0; c < 3; ++c) {
      values.push_back(std::abs(shownOf255(is[c]) - shownOf255(should[c])));
      found += is[c];
      truth += should[c];
    }
  }
  double radiance() const { return 100 * (found / truth - 1); }
};

struct Pixel {
  std::uint32_t x = 0, y = 0;
  std::size_t sphere = 0;
  glm::dvec3 truth{0};
};

std::vector<Pixel> tracedPixels(const MetalScene& scene, const MetalTracer& tracer, std::uint32_t step,
                                unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Pixel> pixels;
  for (std::uint32_t y = 1; y < MetalScene::kHeight; y += step)
    for (std::uint32_t x = y / step % step; x < MetalScene::kWidth; x += step) {
      const int sphere = scene.sphereOf(tracer, x, y);
      if (sphere < 0) continue;
      pixels.push_back({x, y, static_cast<std::size_t>(sphere), scene.truth(tracer, x, y, kPaths, random)});
    }
  return pixels;
}

struct Bounds {
  double mean, percentile, radiance;  // of each sphere
  double allMean, allPercentile, allRadiance;
};

void checkMetals(MetalScene::Stand stand, const Bounds& bounds) {
  MetalScene scene(stand);
  const std::vector<Pixel> pixels = tracedPixels(scene, MetalTracer(scene.setup), kStep, 5);
  const std::size_t count = scene.setup.balls.size();
  const auto compare = [&] {
    Lab lab(scene.setup);
    lab.frame();
    const Picture picture = lab.read("hdr");
    CHECK(lab.reports() == "");
    std::vector<Off> offs(count + 1);  // each sphere, and all of them
    for (const Pixel& pixel : pixels)
      for (const std::size_t to : {pixel.sphere, count}) {
        const float* is = picture.at(pixel.x, pixel.y);
        offs[to].add({is[0], is[1], is[2]}, pixel.truth);
      }
    return offs;
  };
  std::vector<Off> with = compare();
  scene.setup.sets = {};
  std::vector<Off> without = compare();
  for (std::size_t i = 0; i <= count; ++i) {
    const bool all = i == count;
    const double percentile = percentileOf(with[i].values, 0.95);
    MESSAGE((all ? "all" : "sphere " + std::to_string(i)), ": mean ", meanOf(with[i].values),
            ", 95th percentile ", percentile, ", radiance ", with[i].radiance(), " %; without occlusion ",
            meanOf(without[i].values), ", ", percentileOf(without[i].values, 0.95), ", ",
            without[i].radiance(), " %");
    REQUIRE(with[i].values.size() > 100);
    CHECK(meanOf(with[i].values) < (all ? bounds.allMean : bounds.mean));
    CHECK(percentile < (all ? bounds.allPercentile : bounds.percentile));
    CHECK(std::abs(with[i].radiance()) < (all ? bounds.allRadiance : bounds.radiance));
  }
}

}  // namespace

TEST_CASE("metals: paths keep all light in a white furnace, and two sets of them agree") {
  MetalScene furnace(MetalScene::Stand::inTheAir);
  Setup& white = furnace.setup;  // white metals under a white sky vanish
  white.environment = constantEnvironment(1, 1, 1);
  for (Ball& ball : white.balls) ball.albedo = glm::vec3(1);
  const std::vector<Pixel> vanished = tracedPixels(furnace, MetalTracer(white), 16, 1);
  CHECK(vanished.size() > 50);
  for (const Pixel& pixel : vanished) CHECK(pixel.truth.x == doctest::Approx(1).epsilon(0.05));
  for (const auto stand : {MetalScene::Stand::inTheAir, MetalScene::Stand::onGround}) {
    const MetalScene each(stand);
    const MetalTracer tracer(each.setup);
    const std::vector<Pixel> one = tracedPixels(each, tracer, 8, 1), other = tracedPixels(each, tracer, 8, 2);
    Off off;
    for (std::size_t i = 0; i < one.size(); ++i) off.add(one[i].truth, other[i].truth);
    MESSAGE("two sets: mean ", meanOf(off.values), ", 95th percentile ", percentileOf(off.values, 0.95));
    CHECK(meanOf(off.values) < 1.6);
  }
}

TEST_CASE("metals: in the air they reflect one another as paths say") {
  checkMetals(MetalScene::Stand::inTheAir, {.mean = 3.8,
                                            .percentile = 20.5,
                                            .radiance = 2.6,
                                            .allMean = 2.9,
                                            .allPercentile = 12.5,
                                            .allRadiance = 0.4});
}

TEST_CASE("metals: on a ground they reflect one another and it as paths say") {
  checkMetals(MetalScene::Stand::onGround, {.mean = 4.6,
                                            .percentile = 19,
                                            .radiance = 2.9,
                                            .allMean = 4.1,
                                            .allPercentile = 14.8,
                                            .allRadiance = 1.2});
}

}  // namespace neighbors_metals_test
