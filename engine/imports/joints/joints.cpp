// The import `joints`: matrices of the joints of skinned meshes, now and in the frame before.
#include "engine/imports/builtin.h"
#include "engine/imports/scene_tables.h"

namespace weft::imports {

namespace {

struct JointTable : SceneTable<scene::Joint> {
  static constexpr const char* kLabel = "joints";
  static Columns<Row> columns() {
    return {column<Row, &Row::now>("now", "bind pose to world"),
            column<Row, &Row::previous>("previous", "of the frame before")};
  }
  static std::span<const Row> rows(const Frame& frame) { return frame.tables.meshFrame().joints(); }
  static std::uint64_t generation(const Frame& frame) { return frame.tables.meshFrame().jointsGeneration(); }
  static bool isStill(const World& world) { return world.scene().skins.size() == 0; }
};

class Joints : public ImportOf<TableProvider<JointTable>> {
 public:
  graph::ImportType reflect() const override {
    return {.name = "joints",
            .kind = graph::ImportKind::buffer,
            .doc =
                "Of the joints of skinned meshes: bind pose to world, so that a vertex is the mean of its "
                "joints' matrices, by weight, times its position.",
            .columns = tell(JointTable::columns())};
  }
  graph::ImportFacts facts(const graph::ImportRequest&, const WorldFacts& world, Files&) const override {
    return {.exists = world.skins > 0, .count = static_cast<double>(world.skins)};
  }
};

}  // namespace

std::unique_ptr<Import> makeJoints() {
  return std::make_unique<Joints>();
}

}  // namespace weft::imports
