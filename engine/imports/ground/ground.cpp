// The import `ground`: the plane that the scene stands on, as a table of one row.
#include <array>

#include "engine/imports/builtin.h"
#include "engine/imports/row_table.h"

namespace weft::imports {

namespace {

const Columns<scene::Ground>& groundColumns() {
  using Row = scene::Ground;
  static const Columns<Row> columns = {
      column<Row, &Row::height>("height", "world Y"),
      column<Row, [](const Row& row) { return row.albedo.value_or(glm::vec3(0)); }>("albedo",
                                                                                    "linear, of its surface"),
      column<Row, [](const Row& row) { return row.albedo ? row.radius : 0.0f; }>(
          "radius", "of its surface; 0: it has none and shows the environment")};
  return columns;
}

class GroundProvider : public Provider {
 public:
  BufferRef buffer(const Frame& frame, const RowLayout& layout, base::Diagnostics& diagnostics) override {
    const auto row = [&] { return std::array{frame.world.scene().ground.value_or(scene::Ground{})}; };
    return table_.get(layout, generation(frame), row, diagnostics);
  }
  std::uint64_t generation(const Frame& frame) override { return frame.world.sceneGeneration(); }
  bool isStill(const World&) const override { return true; }

 private:
  RowTable<scene::Ground> table_{"ground", groundColumns()};
};

class Ground : public Import {
 public:
  graph::ImportType reflect() const override {
    return {.name = "ground",
            .kind = graph::ImportKind::buffer,
            .doc = "The plane that the scene stands on: one row.",
            .arguments = {},
            .columns = tell(groundColumns())};
  }

  graph::ImportFacts facts(const graph::ImportRequest&, const WorldFacts& world, Files&) const override {
    return {.exists = world.ground, .count = world.ground ? 1.0 : 0.0};
  }

  std::unique_ptr<Provider> provide(const graph::ImportRequest&) const override {
    return std::make_unique<GroundProvider>();
  }
};

}  // namespace

std::unique_ptr<Import> makeGround() {
  return std::make_unique<Ground>();
}

}  // namespace weft::imports
