// The import `ground`: the plane that the scene stands on, as a table of one row.
#include <array>

#include "engine/imports/builtin.h"

namespace weft::imports {

namespace {

struct GroundTable : SceneTable<scene::Ground> {
  static constexpr const char* kLabel = "ground";
  static Columns<Row> columns() {
    return {column<Row, &Row::height>("height", "world Y"),
            column<Row, [](const Row& row) { return row.albedo.value_or(glm::vec3(0)); }>(
                "albedo", "linear, of its surface"),
            column<Row, [](const Row& row) { return row.albedo ? row.radius : 0.0f; }>(
                "radius", "of its surface; 0: it has none and shows the environment")};
  }
  static auto rows(const Frame& frame) { return std::array{frame.world.scene().ground.value_or(Row{})}; }
};

class Ground : public ImportOf<TableProvider<GroundTable>> {
 public:
  graph::ImportType reflect() const override {
    return {.name = "ground",
            .kind = graph::ImportKind::buffer,
            .doc = "The plane that the scene stands on: one row.",
            .arguments = {},
            .columns = tell(GroundTable::columns())};
  }
  graph::ImportFacts facts(const graph::ImportRequest&, const WorldFacts& world, Files&) const override {
    return {.exists = world.ground, .count = world.ground ? 1.0 : 0.0};
  }
};

}  // namespace

std::unique_ptr<Import> makeGround() {
  return std::make_unique<Ground>();
}

}  // namespace weft::imports
