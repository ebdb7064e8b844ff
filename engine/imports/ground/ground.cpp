#include "engine/imports/ground/ground.h"

#include "engine/imports/row_table.h"

namespace weft::imports {

namespace {

class GroundProvider : public Provider {
 public:
  BufferRef buffer(const Frame& frame, const RowLayout& layout, base::Diagnostics& diagnostics) override {
    const auto fill = [&](const RowLayout& wanted, std::vector<std::byte>& bytes) {
      const scene::Ground ground = frame.world.scene().ground.value_or(scene::Ground{});
      RowWriter writer(wanted, 1, bytes);
      writer.put(0, 0, ground.height);
      writer.put(0, 1, ground.albedo.value_or(glm::vec3(0)));
      writer.put(0, 2, ground.albedo ? ground.radius : 0.0f);
    };
    return table_.get(layout, generation(frame), fill, diagnostics);
  }
  std::uint64_t generation(const Frame& frame) override { return frame.world.sceneGeneration(); }
  bool isStill(const World&) const override { return true; }

 private:
  RowTable table_{"ground"};
};

}  // namespace

graph::ImportType Ground::reflect() const {
  return {.name = "ground",
          .kind = graph::ImportKind::buffer,
          .doc = "The plane that the scene stands on: one row.",
          .arguments = {},
          .columns = {{"height", "float", "world Y"},
                      {"albedo", "vec3", "linear, of its surface"},
                      {"radius", "float", "of its surface; 0: it has none and shows the environment"}}};
}

graph::ImportFacts Ground::facts(const graph::ImportRequest&, const WorldFacts& world, Files&) const {
  return {.exists = world.ground, .count = world.ground ? 1.0 : 0.0};
}

std::unique_ptr<Provider> Ground::provide(const graph::ImportRequest&) const {
  return std::make_unique<GroundProvider>();
}

}  // namespace weft::imports
