#include <array>

#include "engine/imports/builtin.h"

namespace weft::imports {

namespace {

Columns<Pointer> mouseColumns() {
  using Row = Pointer;
  return {column<Row, &Row::position>("position", "pixels, where it was last over the picture"),
          column<Row, &Row::dragged>("dragged", "pixels, where it was last while the button was held"),
          column<Row, &Row::pressed>("pressed", "pixels, where the button last went down"),
          column<Row, &Row::down>("down", "1 while the button is held, else 0"),
          column<Row, &Row::clicked>("clicked", "1 in the frame in which the button went down, else 0")};
}

class MouseProvider : public Provider {
 public:
  BufferRef buffer(const Frame& frame, const RowLayout& layout, text::Diagnostics& diagnostics) override {
    const auto row = [this] { return std::array{shown_}; };
    return table_.get(layout, generation(frame), row, diagnostics);
  }
  bool value(const Frame& frame, const ViewPart& part, std::uint32_t column, Numbers& out) override {
    return table_.read(std::array{frame.input.pointer}, part.element, column, out);
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
  RowTable<Pointer> table_{"mouse", mouseColumns()};
};

class Mouse : public ImportOf<MouseProvider> {
 public:
  graph::ImportType reflect() const override {
    return {
        .name = "mouse",
        .kind = graph::ImportKind::buffer,
        .doc =
            "Where the mouse points in the presented picture, and its left button: one row. Points are in "
            "pixels from the lower left corner, as gl_FragCoord counts them.",
        .arguments = {},
        .columns = tell(mouseColumns())};
  }
  graph::ImportFacts facts(const graph::ImportRequest&, const WorldFacts&, Files&) const override {
    return {.exists = true, .count = 1, .changing = true};
  }
};

}  // namespace

std::unique_ptr<Import> makeMouse() {
  return std::make_unique<Mouse>();
}

}  // namespace weft::imports
