#include <algorithm>
#include <span>
#include <vector>

#include "engine/imports/builtin.h"
#include "engine/imports/scene_tables.h"
#include "engine/scene/sort.h"

namespace weft::imports {

namespace {

class DrawOrderProvider : public Provider {
 public:
  explicit DrawOrderProvider(const graph::ImportRequest& request)
      : list_(drawListOf(request)), view_(request) {}

  BufferRef buffer(const Frame& frame, const RowLayout&, text::Diagnostics& diagnostics) override {
    if (const std::uint64_t now = generation(frame); sorted_ != now) {
      scene::drawOrder(frame.tables.rows(frame.tables.listOf(list_)), view_.view(frame).eye, elements_,
                       scratch_);
      if (elements_.empty()) elements_.emplace_back();
      if (!sendTo(buffer_, std::as_bytes(std::span(elements_)), "draw order", false, diagnostics)) return {};
      sorted_ = now;
    }
    return {buffer_.id(), buffer_.bytes()};
  }
  std::uint64_t generation(const Frame& frame) override {
    const std::uint64_t rows = frame.tables.generation(frame.tables.listOf(list_)),
                        camera = view_.generation(frame);
    if (generation_ == 0 || rows != rows_ || camera != camera_) generation_ = frame.newGeneration();
    rows_ = rows;
    camera_ = camera;
    return generation_;
  }

 private:
  scene::Selection list_;
  NamedView view_;
  gl::Buffer buffer_;
  std::uint64_t generation_ = 0, rows_ = 0, camera_ = 0;
  std::uint64_t sorted_ = 0;  // the generation that the buffer holds
  std::vector<scene::SortElement> elements_, scratch_;
};

class DrawOrder : public ImportOf<DrawOrderProvider> {
 public:
  graph::ImportType reflect() const override {
    return {
        .name = "draw_order",
        .kind = graph::ImportKind::buffer,
        .doc =
            "uvec2(key, index) per instance of `list`, back to front, sorted on the CPU every frame by the "
            "squared distance from the eye less the squared radius, which is right for all spheres that "
            "do not meet.",
        .arguments = {drawListArgument(), viewArgument()}};
  }

  graph::ImportFacts facts(const graph::ImportRequest& request, const WorldFacts& world,
                           Files&) const override {
    const double count = world.spheresOf(drawListOf(request));
    return {.exists = true,
            .bytes = static_cast<std::uint64_t>(std::max(count, 1.0)) * sizeof(scene::SortElement),
            .count = count};
  }
};

}  // namespace

std::unique_ptr<Import> makeDrawOrder() {
  return std::make_unique<DrawOrder>();
}

}  // namespace weft::imports
