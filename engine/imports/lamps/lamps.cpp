#include "engine/imports/lamps/lamps.h"

#include <algorithm>
#include <span>
#include <vector>

#include "engine/imports/row_table.h"
#include "engine/imports/scene_tables.h"
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
    return table_.get(layout, generation_, fill, diagnostics);
  }
  const scene::ViewData& view(const Frame& frame, const ViewPart& part) override {
    follow(frame);
    if (part.element < rows_.size())
      view_ = scene::lampView(lamps_[rows_[part.element]], std::min<std::uint32_t>(part.face, 5), part.width);
    return view_;
  }
  std::uint64_t generation(const Frame& frame) override {
    follow(frame);
    return generation_;
  }
  bool isStill(const World& world) const override {
    return !standOnNodes(world.scene()) || !scene::isMoving(world.scene());
  }

 private:
  static bool standOnNodes(const scene::Scene& scene) {
    return std::ranges::any_of(scene.lamps.rows(), [](const scene::Lamp& lamp) { return lamp.node.valid(); });
  }

  // Lamps that stand on no node are the scene's own rows: nothing of the frame is needed for them.
  void follow(const Frame& frame) {
    if (frame_ == frame.number) return;
    frame_ = frame.number;
    const scene::Scene& scene = frame.world.scene();
    const std::uint64_t changed = frame.world.sceneGeneration();
    if (scene_ != changed) onNodes_ = standOnNodes(scene);
    lamps_ = onNodes_ ? frame.tables.meshFrame().lamps() : scene.lamps.rows();
    const std::uint64_t placed = onNodes_ ? frame.tables.meshFrame().lightsGeneration() : 0;
    if (scene_ == changed && placed_ == placed) return;
    scene_ = changed;
    placed_ = placed;
    generation_ = frame.newGeneration();
    rows_.clear();
    for (std::uint32_t row = 0; row < lamps_.size(); ++row)
      if (lamps_[row].shadow || !casting_) rows_.push_back(row);
  }

  void write(const RowLayout& layout, std::vector<std::byte>& bytes) const {
    RowWriter writer(layout, rows_.size(), bytes);
    std::int32_t casters = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const scene::Lamp& lamp = lamps_[rows_[i]];
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
  std::uint64_t frame_ = 0, generation_ = 0;
  std::uint64_t scene_ = 0, placed_ = 0;  // generations of what was seen last
  bool onNodes_ = false;
  std::span<const scene::Lamp> lamps_;  // of this frame
  std::vector<std::uint32_t> rows_;     // of lamps_ that the import has
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
