// The import `lamps`: the scene's point and spot lights as a table, and six views of each that its shadows are drawn from.
#include <algorithm>
#include <span>
#include <vector>

#include "engine/imports/builtin.h"
#include "engine/imports/scene_tables.h"
#include "engine/scene/light_views.h"

namespace weft::imports {

namespace {

struct LampRow : scene::Lamp {
  float nearPlane = 0;
  std::int32_t caster = -1;
};

Columns<LampRow> lampColumns() {
  using Row = LampRow;
  return {column<Row, &Row::position>("position", "world"),
          column<Row, &Row::range>("range", "world units; nothing beyond is lit"),
          column<Row, &Row::intensity>("intensity",
                                       "linear RGB; irradiance times squared distance, scene-referred"),
          column<Row, &Row::cosInner>("cos_inner", "of a spot: cosine within which it is full; -1 all round"),
          column<Row, &Row::direction>("direction", "unit, away from it, of a spot"),
          column<Row, &Row::cosOuter>("cos_outer", "cosine beyond which nothing is lit"),
          column<Row, &Row::nearPlane>("near_plane", "of its views"),
          column<Row, &Row::radius>("radius", "world units: its own, for soft shadows"),
          column<Row, &Row::caster>("shadow", "index among those that cast shadows, or -1")};
}

class LampsProvider : public Provider {
 public:
  explicit LampsProvider(const graph::ImportRequest& request) : casting_(request.at("casting").truth()) {}

  BufferRef buffer(const Frame& frame, const RowLayout& layout, text::Diagnostics& diagnostics) override {
    follow(frame);
    return table_.get(
        layout, generation_, [this] { return tableRows(); }, diagnostics);
  }
  bool value(const Frame& frame, const ViewPart& part, std::uint32_t column, Numbers& out) override {
    follow(frame);
    return table_.read(tableRows(), part.element, column, out);
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
    return !scene::isMoving(world.scene()) ||
           std::ranges::none_of(world.scene().lamps.rows(),
                                [](const scene::Lamp& lamp) { return lamp.node.valid(); });
  }

 private:
  void follow(const Frame& frame) {
    if (frame_ == frame.number) return;
    frame_ = frame.number;
    const scene::MeshFrame& placed = frame.tables.meshFrame();
    lamps_ = placed.lamps();
    if (placed_ == placed.lightsGeneration()) return;
    placed_ = placed.lightsGeneration();
    generation_ = frame.newGeneration();
    rows_.clear();
    for (std::uint32_t row = 0; row < lamps_.size(); ++row)
      if (lamps_[row].shadow || !casting_) rows_.push_back(row);
  }

  std::vector<LampRow> tableRows() const {
    std::vector<LampRow> rows;
    std::int32_t casters = 0;
    for (const std::uint32_t row : rows_)
      rows.push_back({lamps_[row], scene::nearPlaneOf(lamps_[row]), lamps_[row].shadow ? casters++ : -1});
    return rows;
  }

  bool casting_;
  std::uint64_t frame_ = 0, generation_ = 0;
  std::uint64_t placed_ = 0;            // generation of the lamps that were seen last
  std::span<const scene::Lamp> lamps_;  // of this frame
  std::vector<std::uint32_t> rows_;     // of lamps_ that the import has
  scene::ViewData view_;
  RowTable<LampRow> table_{"lamps", lampColumns()};
};

class Lamps : public ImportOf<LampsProvider> {
 public:
  graph::ImportType reflect() const override {
    return {.name = "lamps",
            .kind = graph::ImportKind::buffer,
            .doc =
                "The scene's point and spot lights, one row each, and views of 90 degrees from them: "
                "@lamps[l].face[f], faces as of a cube map.",
            .arguments = {argument("casting", graph::Value::boolean(false), "only those that cast shadows")},
            .columns = tell(lampColumns()),
            .views = true};
  }

  graph::ImportFacts facts(const graph::ImportRequest& request, const WorldFacts& world,
                           Files&) const override {
    const std::uint32_t count = request.at("casting").truth() ? world.castingLamps : world.lamps;
    return {.exists = count > 0, .count = static_cast<double>(count)};
  }
};

}  // namespace

std::unique_ptr<Import> makeLamps() {
  return std::make_unique<Lamps>();
}

}  // namespace weft::imports
