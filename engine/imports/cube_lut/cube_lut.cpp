#include "engine/imports/builtin.h"
#include "engine/imports/cube_lut/lut_texture.h"

namespace weft::imports {

namespace {

const std::string& fileOf(const graph::ImportRequest& request) {
  return request.arguments[0].second.symbol;
}

class CubeLutProvider : public Provider {
 public:
  explicit CubeLutProvider(std::string file) : file_(std::move(file)) {}

  gl::TextureRef texture(const Frame& frame, base::Diagnostics& diagnostics) override {
    if (file_.empty()) return {};
    if (stale_) {
      stale_ = false;
      const auto table = tableOf(frame.files, file_, diagnostics);
      auto texture = table && table != table_ ? makeLutTexture(*table, file_, diagnostics) : std::nullopt;
      if (texture) {
        table_ = table;
        texture_ = std::move(*texture);
        generation_ = frame.newGeneration();
      }
    }
    return texture_ ? texture_.ref() : gl::TextureRef{};
  }
  std::uint64_t generation(const Frame&) override { return generation_; }
  bool isStill(const World&) const override { return true; }
  bool renew(bool used) override {
    stale_ = true;
    return used;
  }

 private:
  std::string file_;
  std::shared_ptr<const assets::CubeLut> table_;  // what the texture holds
  gl::Texture texture_;
  std::uint64_t generation_ = 0;
  bool stale_ = true;
};

class CubeLut : public Import {
 public:
  graph::ImportType reflect() const override {
    return {.name = "cube_lut",
            .kind = graph::ImportKind::texture,
            .doc =
                "A .cube table, 3D or 1D, as an RGBA16F 3D texture for composite/lut.glsl; not there when "
                "`file` is empty.",
            .arguments = {{.name = "file",
                           .initial = graph::Value::text(""),
                           .choices = {},
                           .doc = "path of the .cube file"}}};
  }

  graph::ImportFacts facts(const graph::ImportRequest& request, const WorldFacts&,
                           Files& files) const override {
    graph::ImportFacts result;
    if (fileOf(request).empty()) return result;
    base::Diagnostics said;
    if (const auto lut = tableOf(files, fileOf(request), said)) {
      const gl::Extent extent = lutExtent(*lut);
      result.exists = true;
      result.format = graph::Format::rgba16f;
      result.width = extent.width;
      result.height = extent.height;
      result.depth = extent.layers;
    }
    result.problems = said.items();
    return result;
  }

  std::unique_ptr<Provider> provide(const graph::ImportRequest& request) const override {
    return std::make_unique<CubeLutProvider>(fileOf(request));
  }
};

}  // namespace

std::unique_ptr<Import> makeCubeLut() {
  return std::make_unique<CubeLut>();
}

}  // namespace weft::imports
