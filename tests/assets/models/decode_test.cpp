// Images of models decoded on several threads: the same model and the same messages on one thread, on two and on five.
#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <stop_token>
#include <thread>

#include "engine/assets/models/model_file.h"
#include "tests/assets/models/gltf_maker.h"
#include "tests/temporary_folder.h"

using namespace weft;
using weft::test::GltfMaker;
using weft::test::json;

namespace {

const std::string kHelmet = WEFT_SOURCE_DIR "/scenes/models/FlightHelmet/FlightHelmet.gltf";

struct Loaded {
  assets::Model model;
  std::string said;
};

Loaded load(const std::string& path, int threads) {
  text::Diagnostics diagnostics;
  std::optional<assets::Model> model;
  tbb::task_arena(threads).execute([&] { model = assets::loadModel(path, diagnostics); });
  REQUIRE_MESSAGE(model, diagnostics.text());
  return {std::move(*model), diagnostics.text()};
}

void checkSame(const std::string& path, std::size_t textures) {
  const Loaded turn = load(path, 1);
  CHECK(turn.model.textures.size() == textures);
  for (const int threads : {2, 5}) {
    CAPTURE(threads);
    const Loaded other = load(path, threads);
    CHECK(other.said == turn.said);
    REQUIRE(other.model.textures.size() == textures);
    for (std::size_t i = 0; i < textures; ++i) {
      const assets::Texture &a = turn.model.textures[i], &b = other.model.textures[i];
      CHECK(a.name == b.name);
      CHECK(a.srgb == b.srgb);
      CHECK(a.content == b.content);
      CHECK(a.image->width == b.image->width);
      CHECK(a.image->texels == b.image->texels);
    }
    for (std::size_t i = 0; i < turn.model.materials.size(); ++i)
      CHECK(turn.model.materials[i].normalMap == other.model.materials[i].normalMap);
  }
}

}  // namespace

TEST_CASE("FlightHelmet's images are the same to the byte on one thread and on several") {
  checkSame(kHelmet, 15);
}

TEST_CASE("damaged and missing images say the same in the same order on any number of threads") {
  const TemporaryFolder folder;
  GltfMaker maker;
  maker.square();
  const std::filesystem::path good = std::filesystem::path(kHelmet).parent_path();
  std::vector<std::filesystem::path> pictures;
  for (const auto& each : std::filesystem::directory_iterator(good))
    if (each.path().extension() == ".png" || each.path().extension() == ".jpg")
      pictures.push_back(each.path());
  std::ranges::sort(pictures);
  REQUIRE(pictures.size() > 2);
  std::filesystem::copy_file(pictures[0], folder.at("good.png"));
  folder.write("cut.png", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x40\0\0\0\x20\x08\x06\0\0\0", 29));
  for (const char* name : {"cut.png", "gone.png", "good.png", "text.png"})
    maker.document["images"].push_back({{"uri", name}});
  folder.write("text.png", "no picture at all");
  for (int i = 0; i < 4; ++i) {
    maker.document["textures"].push_back({{"source", i}});
    maker.document["materials"].push_back({{"emissiveTexture", {{"index", i}}}});
  }
  const std::string path = folder.write("m.gltf", maker.gltf());
  checkSame(path, 2);  // the good one, and one that stands for all others
  const std::string said = load(path, 2).said;
  CHECK(said.find("cut.png") != std::string::npos);
  CHECK(said.find("gone.png") != std::string::npos);
  CHECK(said.find("cut.png") < said.find("text.png"));
}

TEST_CASE("a load that is stopped at any moment gives nothing and says nothing") {
  for (const int threads : {1, 2}) {
    std::optional<assets::Model> model;
    for (auto wait = std::chrono::milliseconds(1); !model; wait *= 2) {
      text::Diagnostics diagnostics;
      std::stop_source source;
      const std::jthread stopper([&] {
        std::this_thread::sleep_for(wait);
        source.request_stop();
      });
      tbb::task_arena(threads).execute(
          [&] { model = assets::loadModel(kHelmet, diagnostics, source.get_token()); });
      CHECK(diagnostics.empty());
    }
  }
}
