#include "engine/imports/lamps/lamps.h"

#include <algorithm>
#include <vector>

#include "engine/imports/row_table.h"
#include "engine/scene/light_views.h"

namespace weft::imports {

namespace {

bool isCasting(const graph::ImportRequest& request) {
  return request.arguments[0].second.truth();
}

class LampsProvider : public Provider {
 public:
  explicit LampsProvider(bool casting) : casting_(casting) {}

  BufferRef buffer(const Frame& frame, const RowLayout& layout, base::Diagnostics& diagnostics) override {
    follow(frame);
    const auto fill = [&](const RowLayout& wanted, std::vector<std::byte>& bytes) { write(wanted, bytes); };
    return table_.get(layout, scene_, fill, diagnostics);
  }
  const scene::ViewData& view(const Frame& frame, const ViewPart& part) override {
    follow(frame);
    if (part.element < lamps_.size())
      view_ = scene::lampView(lamps_[part.element], std::min<std::uint32_t>(part.face, 5), part.width);
    return view_;
  }
  std::uint64_t generation(const Frame& frame) override { return frame.world.sceneGeneration(); }
  bool isStill(const World&) const override { return true; }

 private:
  void follow(const Frame& frame) {
    if (scene_ == frame.world.sceneGeneration()) return;
    scene_ = frame.world.sceneGeneration();
    lamps_.clear();
    for (const scene::Lamp& lamp : frame.world.scene().lamps.rows())
      if (lamp.shadow || !casting_) lamps_.push_back(lamp);
  }

  void write(const RowLayout& layout, std::vector<std::byte>& bytes) const {
    RowWriter writer(layout, lamps_.size(), bytes);
    std::int32_t casters = 0;
    for (std::size_t i = 0; i < lamps_.size(); ++i) {
      const scene::Lamp& lamp = lamps_[i];
      writer.put(i, 0, lamp.position);
      writer.put(i, 1, lamp.range);
      writer.put(i, 2, lamp.intensity);
      writer.put(i, 3, lamp.cosInner);
      writer.put(i, 4, lamp.direction);
      writer.put(i, 5, lamp.cosOuter);
      writer.put(i, 6, scene::nearPlaneOf(lamp));
      writer.put(i, 7, lamp.radius);
      writer.put(i, 8, lamp.shadow ? casters++ : -1);
    }
  }

  bool casting_;
  std::uint64_t scene_ = 0;  // generation
  std::vector<scene::Lamp> lamps_;
  scene::ViewData view_;
  RowTable table_{"lamps"};
};

}  // namespace

graph::ImportType Lamps::reflect() const {
  return {.name = "lamps",
          .kind = graph::ImportKind::buffer,
          .doc =
              "The scene's point and spot lights, one row each, and views of 90 degrees from them: "
              "@lamps[l].face[f], faces as of a cube map.",
          .arguments = {{.name = "casting",
                         .initial = graph::Value::boolean(false),
                         .choices = {},
                         .doc = "only those that cast shadows"}},
          .columns = {{"position", "vec3", "world"},
                      {"range", "float", "world units; nothing beyond is lit"},
                      {"intensity", "vec3", "linear RGB; irradiance times squared distance, scene-referred"},
                      {"cos_inner", "float", "of a spot: cosine within which it is full; -1 all round"},
                      {"direction", "vec3", "unit, away from it, of a spot"},
                      {"cos_outer", "float", "cosine beyond which nothing is lit"},
                      {"near_plane", "float", "of its views"},
                      {"radius", "float", "world units: its own, for soft shadows"},
                      {"shadow", "int", "index among those that cast shadows, or -1"}},
          .views = true};
}

graph::ImportFacts Lamps::facts(const graph::ImportRequest& request, const WorldFacts& world, Files&) const {
  const std::uint32_t count = isCasting(request) ? world.castingLamps : world.lamps;
  return {.exists = count > 0, .count = static_cast<double>(count)};
}

std::unique_ptr<Provider> Lamps::provide(const graph::ImportRequest& request) const {
  return std::make_unique<LampsProvider>(isCasting(request));
}

}  // namespace weft::imports
