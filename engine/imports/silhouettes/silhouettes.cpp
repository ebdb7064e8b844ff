#include "engine/scene/silhouettes.h"

#include <algorithm>
#include <span>

#include "engine/imports/builtin.h"
#include "engine/imports/scene_tables.h"

namespace weft::imports {

namespace {

constexpr double kHighest = 65536;  // pixels

// Pixels that two silhouettes may be apart and still meet: the diagonal of one, and what a lens wider than the scene's makes of it.
constexpr float kPixels = 3;

class SilhouettesProvider : public Provider {
 public:
  explicit SilhouettesProvider(const graph::ImportRequest& request)
      : list_(drawListOf(request)),
        view_(request),
        height_(static_cast<float>(std::clamp(request.at("height").v[0], 1.0, kHighest))) {}

  BufferRef buffer(const Frame& frame, const RowLayout&, text::Diagnostics& diagnostics) override {
    const std::uint64_t now = generation(frame);
    if (buffer_ && sent_ == now) return {buffer_.id(), buffer_.bytes()};
    found_.find(frame.tables.rows(frame.tables.listOf(list_)), eye_, kPixels * pixel_);
    if (!sendTo(buffer_, std::as_bytes(std::span(found_.rows())), "silhouettes", true, diagnostics))
      return {};
    sent_ = now;
    return {buffer_.id(), buffer_.bytes()};
  }
  std::uint64_t generation(const Frame& frame) override {
    const scene::ViewData& view = view_.view(frame);
    const float pixel = 2 / (view.projection[1].y * height_);
    const std::uint64_t rows = frame.tables.generation(frame.tables.listOf(list_));
    if (generation_ == 0 || rows != rows_ || view.eye != eye_ || pixel != pixel_)
      generation_ = frame.newGeneration();
    rows_ = rows;
    eye_ = view.eye;
    pixel_ = pixel;
    return generation_;
  }

 private:
  scene::Selection list_;
  NamedView view_;
  float height_;
  scene::Silhouettes found_;
  gl::Buffer buffer_;
  std::uint64_t generation_ = 0, sent_ = 0;  // of what is below; of what the buffer holds
  std::uint64_t rows_ = 0;
  glm::vec3 eye_{0};
  float pixel_ = 0;
};

class Silhouettes : public ImportOf<SilhouettesProvider> {
 public:
  graph::ImportType reflect() const override {
    return {.name = "silhouettes",
            .kind = graph::ImportKind::buffer,
            .doc =
                "Of each sphere of `list`, those before it whose silhouettes meet its own in the picture. "
                "uvec4(first, number, 0, 0) per instance, then per such sphere the bits of vec4(center from "
                "the eye, radius); empty with more than 4096, or 131072 pairs that meet.",
            .arguments = {drawListArgument(),
                          argument("height", graph::Value::number(720), "of the picture, pixels"),
                          viewArgument()}};
  }

  graph::ImportFacts facts(const graph::ImportRequest& request, const WorldFacts& world,
                           Files&) const override {
    graph::ImportFacts facts{.exists = true, .count = world.spheresOf(drawListOf(request))};
    const double height = request.at("height").v[0];
    if (height >= 1 && height <= kHighest) return facts;
    facts.problems.push_back(
        badArgument("import 'silhouettes': argument 'height' does not fit",
                    "the height of the picture, 1 to 65536 pixels", graph::toText(request.at("height")),
                    "write \"height\": \"size(hdr).y\", with the picture's name in place of hdr"));
    return facts;
  }
};

}  // namespace

std::unique_ptr<Import> makeSilhouettes() {
  return std::make_unique<Silhouettes>();
}

}  // namespace weft::imports
