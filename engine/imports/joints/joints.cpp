// The import `joints`: matrices of the joints of skinned meshes, now and in the frame before.
#include "engine/imports/builtin.h"
#include "engine/imports/row_table.h"
#include "engine/imports/scene_tables.h"

namespace weft::imports {

namespace {

const Columns<scene::Joint>& jointColumns() {
  using Row = scene::Joint;
  static const Columns<Row> columns = {column<Row, &Row::now>("now", "bind pose to world"),
                                       column<Row, &Row::previous>("previous", "of the frame before")};
  return columns;
}

class JointsProvider : public Provider {
 public:
  BufferRef buffer(const Frame& frame, const RowLayout& layout, base::Diagnostics& diagnostics) override {
    const auto rows = [&] { return frame.tables.meshFrame().joints(); };
    return table_.get(layout, frame.tables.jointGeneration(), rows, diagnostics);
  }
  std::uint64_t generation(const Frame& frame) override { return frame.tables.jointGeneration(); }
  bool isStill(const World& world) const override { return world.scene().skins.size() == 0; }

 private:
  RowTable<scene::Joint> table_{"joints", jointColumns()};
};

class Joints : public Import {
 public:
  graph::ImportType reflect() const override {
    return {.name = "joints",
            .kind = graph::ImportKind::buffer,
            .doc =
                "Of the joints of skinned meshes: bind pose to world, so that a vertex is the mean of its "
                "joints' matrices, by weight, times its position.",
            .columns = tell(jointColumns())};
  }

  graph::ImportFacts facts(const graph::ImportRequest&, const WorldFacts& world, Files&) const override {
    return {.exists = world.skins > 0, .count = static_cast<double>(world.skins)};
  }

  std::unique_ptr<Provider> provide(const graph::ImportRequest&) const override {
    return std::make_unique<JointsProvider>();
  }
};

}  // namespace

std::unique_ptr<Import> makeJoints() {
  return std::make_unique<Joints>();
}

}  // namespace weft::imports
