// Tracks against the formulas of glTF 2.0, appendix C, and Fox's against a reader of its bytes that is nothing but this file.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "engine/assets/models/model_file.h"
#include "engine/scene/frame/transforms.h"

using namespace weft;
using namespace weft::scene;
using assets::ModelTrack;
using assets::TrackInterpolation;
using assets::TrackPath;

namespace {

ModelTrack translation(TrackInterpolation how, std::vector<float> times, std::vector<glm::vec4> values) {
  return {.node = 0,
          .path = TrackPath::translation,
          .interpolation = how,
          .times = std::move(times),
          .values = std::move(values)};
}

// Floats of an accessor of a .glb, by the letter of the format.
struct Glb {
  nlohmann::json document;
  std::string binary;
  explicit Glb(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, 4);
    document = nlohmann::json::parse(bytes.substr(20, length));
    binary = bytes.substr(20 + length + 8);
  }
  std::vector<float> floats(int accessor, int components) const {
    const nlohmann::json& a = document["accessors"][static_cast<std::size_t>(accessor)];
    const nlohmann::json& view = document["bufferViews"][a["bufferView"].get<std::size_t>()];
    const std::size_t offset =
        view.value("byteOffset", std::size_t{0}) + a.value("byteOffset", std::size_t{0});
    std::vector<float> out(a["count"].get<std::size_t>() * static_cast<std::size_t>(components));
    const std::size_t stride = view.value("byteStride", static_cast<std::size_t>(components) * 4);
    for (std::size_t i = 0; i < a["count"].get<std::size_t>(); ++i)
      std::memcpy(&out[i * static_cast<std::size_t>(components)], binary.data() + offset + i * stride,
                  static_cast<std::size_t>(components) * 4);
    return out;
  }
};

}  // namespace

TEST_CASE("linear, step, and what lies outside the keys") {
  const ModelTrack linear =
      translation(TrackInterpolation::linear, {1, 2, 4}, {{0, 0, 0, 0}, {10, 0, -2, 0}, {10, 8, 0, 0}});
  CHECK(sampleTrack(linear, 0.5f) == glm::vec4(0));
  CHECK(sampleTrack(linear, 1.25f) == glm::vec4(2.5f, 0, -0.5f, 0));
  CHECK(sampleTrack(linear, 2) == glm::vec4(10, 0, -2, 0));
  CHECK(sampleTrack(linear, 3) == glm::vec4(10, 4, -1, 0));
  CHECK(sampleTrack(linear, 9) == glm::vec4(10, 8, 0, 0));
  ModelTrack step = linear;
  step.interpolation = TrackInterpolation::step;
  CHECK(sampleTrack(step, 1.99f) == glm::vec4(0));
  CHECK(sampleTrack(step, 2) == glm::vec4(10, 0, -2, 0));
  CHECK(sampleTrack(step, 4) == glm::vec4(10, 8, 0, 0));
  CHECK(sampleTrack(translation(TrackInterpolation::linear, {3}, {{1, 2, 3, 0}}), 3) ==
        glm::vec4(1, 2, 3, 0));
}

TEST_CASE("cubic splines go through a cubic exactly") {
  // p(t) = t³ - 2t, with its derivatives as tangents.
  const auto p = [](float t) { return t * t * t - 2 * t; };
  const auto d = [](float t) { return 3 * t * t - 2; };
  ModelTrack cubic = translation(TrackInterpolation::cubic, {0, 0.5f, 2}, {});
  for (const float t : cubic.times) {
    cubic.values.push_back({d(t), 0, 0, 0});
    cubic.values.push_back({p(t), 5, 0, 0});
    cubic.values.push_back({d(t), 0, 0, 0});
  }
  for (float t = 0; t <= 2; t += 0.0625f) {
    CHECK(sampleTrack(cubic, t).x == doctest::Approx(p(t)).epsilon(1e-5).scale(1));
    CHECK(sampleTrack(cubic, t).y == doctest::Approx(5));
  }
}

TEST_CASE("rotations take the short way at an even pace") {
  // A quarter turn about Y; the second key is the same rotation spelled with the other sign.
  const float h = std::sqrt(0.5f);
  for (const float sign : {1.0f, -1.0f}) {
    const ModelTrack track{.node = 0,
                           .path = TrackPath::rotation,
                           .times = {0, 1},
                           .values = {{0, 0, 0, 1}, {0, sign * h, 0, sign * h}}};
    for (const float f : {0.0f, 0.25f, 0.5f, 0.9f}) {
      const glm::vec4 q = sampleTrack(track, f);
      const double half = static_cast<double>(f) * 3.14159265358979 / 4;
      CHECK(std::abs(q.y) == doctest::Approx(std::sin(half)).epsilon(1e-5).scale(1));
      CHECK(std::abs(q.w) == doctest::Approx(std::cos(half)).epsilon(1e-5));
    }
  }
}

TEST_CASE("an animation plays round and round, at its speed, forwards and back") {
  auto tracks = std::make_shared<assets::ModelAnimation>();
  tracks->duration = 2;
  const Animation once{tracks, {}, 1}, fast{tracks, {}, 3}, back{tracks, {}, -1};
  CHECK(animationTime(once, 0) == 0);
  CHECK(animationTime(once, 3) == 1);
  CHECK(animationTime(fast, 1) == 1);
  CHECK(animationTime(back, 0.5) == 1.5f);
  CHECK(animationTime(once, -0.5) == 1.5f);
  CHECK(animationTime(once, 1e6 + 0.25) == 0.25f);
  tracks->duration = 0;
  CHECK(animationTime(once, 7) == 0);
}

TEST_CASE("Fox's tracks are what stands in its bytes") {
  const std::string path = WEFT_SOURCE_DIR "/scenes/models/Fox.glb";
  text::Diagnostics diagnostics;
  const auto model = assets::loadModel(path, diagnostics);
  REQUIRE_MESSAGE(model, diagnostics.text());
  const Glb glb(path);
  for (std::size_t a = 0; a < 3; ++a) {
    const nlohmann::json& animation = glb.document["animations"][a];
    REQUIRE(model->animations[a]->tracks.size() == animation["channels"].size());
    for (std::size_t c = 0; c < animation["channels"].size(); ++c) {
      const nlohmann::json& channel = animation["channels"][c];
      const nlohmann::json& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
      const bool rotation = channel["target"]["path"] == "rotation";
      const std::size_t n = rotation ? 4 : 3;
      const std::vector<float> times = glb.floats(sampler["input"], 1),
                               values = glb.floats(sampler["output"], static_cast<int>(n));
      const ModelTrack& track = model->animations[a]->tracks[c];
      CHECK(model->nodes[track.node].name ==
            glb.document["nodes"][channel["target"]["node"].get<std::size_t>()]["name"]);
      for (std::size_t k = 0; k + 1 < times.size(); ++k) {
        const glm::vec4 at = sampleTrack(track, times[k]),
                        between = sampleTrack(track, (times[k] + times[k + 1]) / 2);
        double dot = 0, length = 0;
        for (std::size_t i = 0; i < n; ++i) {
          REQUIRE(at[static_cast<int>(i)] == doctest::Approx(values[k * n + i]).epsilon(1e-5).scale(1));
          dot += static_cast<double>(values[k * n + i]) * static_cast<double>(values[(k + 1) * n + i]);
        }
        // Half way between two quaternions is their normalized sum, on the short way.
        glm::dvec4 middle(0);
        for (std::size_t i = 0; i < n; ++i) {
          middle[static_cast<int>(i)] =
              static_cast<double>(values[k * n + i]) +
              (rotation && dot < 0 ? -1 : 1) * static_cast<double>(values[(k + 1) * n + i]);
          length += middle[static_cast<int>(i)] * middle[static_cast<int>(i)];
        }
        middle = rotation ? middle / std::sqrt(length) : middle * 0.5;
        for (std::size_t i = 0; i < n; ++i)
          REQUIRE(static_cast<double>(between[static_cast<int>(i)]) ==
                  doctest::Approx(middle[static_cast<int>(i)]).epsilon(1e-4).scale(1));
      }
    }
  }
}
