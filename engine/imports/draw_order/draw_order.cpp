#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "engine/imports/builtin.h"
#include "engine/imports/camera_views.h"
#include "engine/imports/scene_tables.h"
#include "engine/scene/sort.h"

namespace weft::imports {

namespace {

using graph::Value;

// In the order of reflect().
const std::string& orderedList(const graph::ImportRequest& request) {
  return request.arguments[0].second.symbol;
}
const std::string& orderedBy(const graph::ImportRequest& request) {
  return request.arguments[1].second.symbol;
}
const std::string& methodOf(const graph::ImportRequest& request) {
  return request.arguments[2].second.symbol;
}

class DrawOrderProvider : public Provider {
 public:
  explicit DrawOrderProvider(const graph::ImportRequest& request)
      : list_(scene::findDrawList(orderedList(request))),
        by_(scene::findSortBy(orderedBy(request)).value_or(scene::SortBy::power)),
        method_(scene::findSortMethod(methodOf(request))) {}

  BufferRef buffer(const Frame& frame, const RowLayout&, base::Diagnostics& diagnostics) override {
    if (!list_ || !method_) return {};
    if (const std::uint64_t now = generation(frame); sorted_ != now) {
      const scene::ViewData& view = frame.camera.view(frame, 1, 1);
      scene::drawOrder(frame.tables.rows(*list_), view, by_, *method_, elements_, scratch_);
      const std::uint64_t bytes = std::max<std::size_t>(elements_.size(), 1) * sizeof(scene::SortElement);
      if (!buffer_ || buffer_.bytes() != bytes) {
        auto buffer = gl::Buffer::create(bytes, GL_DYNAMIC_STORAGE_BIT, "draw order", diagnostics);
        if (!buffer) return {};
        buffer_ = std::move(*buffer);
      }
      if (!elements_.empty()) gl::uploadBuffer(buffer_.id(), 0, std::as_bytes(std::span(elements_)));
      sorted_ = now;
    }
    return {buffer_.id(), buffer_.bytes()};
  }
  std::uint64_t generation(const Frame& frame) override {
    if (!list_) return 0;
    const std::uint64_t rows = frame.tables.generation(*list_), camera = frame.camera.generation(frame);
    if (generation_ == 0 || rows != rows_ || camera != camera_) generation_ = frame.newGeneration();
    rows_ = rows;
    camera_ = camera;
    return generation_;
  }

 private:
  std::optional<scene::DrawList> list_;
  scene::SortBy by_;
  std::optional<scene::SortMethod> method_;  // none: a graph's own passes sort
  gl::Buffer buffer_;
  std::uint64_t generation_ = 0, rows_ = 0, camera_ = 0;
  std::uint64_t sorted_ = 0;  // the generation that the buffer holds
  std::vector<scene::SortElement> elements_, scratch_;
};

class DrawOrder : public Import {
 public:
  graph::ImportType reflect() const override {
    return {
        .name = "draw_order",
        .kind = graph::ImportKind::buffer,
        .doc = "uvec2(key, index) per instance of `list`, back to front, sorted on the CPU every frame.",
        .arguments = {{.name = "list",
                       .initial = Value::text(scene::drawListNames().front()),
                       .choices = {},
                       .doc = "a draw list",
                       .drawList = true},
                      {.name = "by",
                       .initial = Value::text("power"),
                       .choices = scene::sortByNames(),
                       .doc = "what is compared: power, the squared distance from the eye less the squared "
                              "radius, right for all "
                              "spheres that do not meet; depth, of the centres along the view axis"},
                      {.name = "method",
                       .initial = Value::text("cpu_radix"),
                       .choices = {"cpu_std", "cpu_radix", "gpu_bitonic"},
                       .doc = "how; gpu_bitonic leaves the buffer to a graph's own passes"}}};
  }

  graph::ImportFacts facts(const graph::ImportRequest& request, const WorldFacts& world,
                           Files&) const override {
    const double count = world.countOf(orderedList(request));
    return {.exists = true,
            .bytes = static_cast<std::uint64_t>(std::max(count, 1.0)) * sizeof(scene::SortElement),
            .count = count};
  }

  std::unique_ptr<Provider> provide(const graph::ImportRequest& request) const override {
    return std::make_unique<DrawOrderProvider>(request);
  }
};

}  // namespace

std::unique_ptr<Import> makeDrawOrder() {
  return std::make_unique<DrawOrder>();
}

}  // namespace weft::imports
