#include "engine/imports/mouse/mouse.h"

#include "engine/imports/row_table.h"

namespace weft::imports {

namespace {

class MouseProvider : public Provider {
 public:
  BufferRef buffer(const Frame& frame, const RowLayout& layout, base::Diagnostics& diagnostics) override {
    const std::uint64_t current = generation(frame);
    const auto fill = [&](const RowLayout& wanted, std::vector<std::byte>& bytes) {
      RowWriter writer(wanted, 1, bytes);
      writer.put(0, 0, shown_.position);
      writer.put(0, 1, shown_.dragged);
      writer.put(0, 2, shown_.pressed);
      writer.put(0, 3, std::uint32_t{shown_.down});
      writer.put(0, 4, std::uint32_t{shown_.clicked});
    };
    return table_.get(layout, current, fill, diagnostics);
  }
  std::uint64_t generation(const Frame& frame) override {
    if (generation_ == 0 || frame.input.pointer != shown_) {
      shown_ = frame.input.pointer;
      generation_ = frame.newGeneration();
    }
    return generation_;
  }
  bool followsPointer() const override { return true; }

 private:
  Pointer shown_;
  std::uint64_t generation_ = 0;
  RowTable table_{"mouse"};
};

}  // namespace

graph::ImportType Mouse::reflect() const {
  return {.name = "mouse",
          .kind = graph::ImportKind::buffer,
          .doc =
              "Where the mouse points in the presented picture, and its left button: one row. Points are in "
              "pixels from the lower left corner, as gl_FragCoord counts them.",
          .arguments = {},
          .columns = {{"position", "vec2", "pixels, where it was last over the picture"},
                      {"dragged", "vec2", "pixels, where it was last while the button was held"},
                      {"pressed", "vec2", "pixels, where the button last went down"},
                      {"down", "uint", "1 while the button is held, else 0"},
                      {"clicked", "uint", "1 in the frame in which the button went down, else 0"}}};
}

graph::ImportFacts Mouse::facts(const graph::ImportRequest&, const WorldFacts&, Files&) const {
  return {.exists = true, .count = 1, .changing = true};
}

std::unique_ptr<Provider> Mouse::provide(const graph::ImportRequest&) const {
  return std::make_unique<MouseProvider>();
}

}  // namespace weft::imports
