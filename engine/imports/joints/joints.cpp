#include "engine/imports/joints/joints.h"

#include "engine/imports/row_table.h"
#include "engine/imports/scene_tables.h"

namespace weft::imports {

namespace {

class JointsProvider : public Provider {
 public:
  BufferRef buffer(const Frame& frame, const RowLayout& layout, base::Diagnostics& diagnostics) override {
    const std::span<const glm::mat4> joints = frame.tables.meshFrame().joints();
    const auto fill = [&](const RowLayout& wanted, std::vector<std::byte>& bytes) {
      RowWriter writer(wanted, joints.size() / 2, bytes);
      for (std::size_t i = 0; i < joints.size() / 2; ++i) {
        writer.put(i, 0, joints[2 * i]);
        writer.put(i, 1, joints[2 * i + 1]);
      }
    };
    return table_.get(layout, frame.tables.jointGeneration(), fill, diagnostics);
  }
  std::uint64_t generation(const Frame& frame) override { return frame.tables.jointGeneration(); }
  bool isStill(const World& world) const override { return world.scene().skins.size() == 0; }

 private:
  RowTable table_{"joints"};
};

}  // namespace

graph::ImportType Joints::reflect() const {
  return {.name = "joints",
          .kind = graph::ImportKind::buffer,
          .doc =
              "Of the joints of skinned meshes: bind pose to world, so that a vertex is the mean of its "
              "joints' matrices, by weight, times its position.",
          .columns = {{"now", "mat4", "bind pose to world"}, {"previous", "mat4", "of the frame before"}}};
}

graph::ImportFacts Joints::facts(const graph::ImportRequest&, const WorldFacts& world, Files&) const {
  return {.exists = world.skins > 0, .count = static_cast<double>(world.skins)};
}

std::unique_ptr<Provider> Joints::provide(const graph::ImportRequest&) const {
  return std::make_unique<JointsProvider>();
}

}  // namespace weft::imports
