// A program with an import and a pass type of its own, of which the engine knows nothing: `waves`, a texture made anew in
// every frame, and `fold`, which copies a texture into four mirrored quarters.
//
//     extend GRAPH PICTURE.png SECONDS
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include "engine/gl/context/context.h"
#include "engine/runtime/frame/renderer.h"

using namespace weft;

namespace {

class WavesProvider : public imports::Provider {
 public:
  explicit WavesProvider(std::uint32_t size) : size_(size) {}

  gl::TextureRef texture(const imports::Frame& frame, text::Diagnostics& diagnostics) override {
    if (!texture_) {
      auto made =
          gl::Texture::create({.format = GL_RGBA8, .width = size_, .height = size_}, "waves", diagnostics);
      if (!made) return {};
      texture_ = std::move(*made);
    }
    if (made_ == frame.number) return texture_.ref();  // asked for more than once in a frame
    made_ = frame.number;
    texels_.clear();
    for (std::uint32_t y = 0; y < size_; ++y)
      for (std::uint32_t x = 0; x < size_; ++x) {
        const double wave = std::sin(0.2 * x + 0.1 * y + 3 * frame.input.time);
        for (const double c : {0.5 + 0.5 * wave, x / double(size_), y / double(size_), 1.0})
          texels_.push_back(static_cast<std::byte>(255 * c));
      }
    gl::uploadTexture(texture_.ref(), 0, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels_);
    return texture_.ref();
  }
  // generation() says that it changes in every frame, isStill() and remembers() that it is a function of the frame's time.

 private:
  std::uint32_t size_;
  gl::Texture texture_;
  std::uint64_t made_ = 0;
  std::vector<std::byte> texels_;
};

class Waves : public imports::Import {
 public:
  graph::ImportType reflect() const override {
    return {.name = "waves",
            .kind = graph::ImportKind::texture,
            .doc = "Waves that move with time.",
            .arguments = {{.name = "size",
                           .initial = graph::Value::number(32),
                           .choices = {},
                           .doc = "texels on a side, 1 to 1024"}}};
  }
  graph::ImportFacts facts(const graph::ImportRequest& request, const imports::WorldFacts&,
                           imports::Files&) const override {
    return {
        .exists = true, .format = graph::Format::rgba8, .width = sizeOf(request), .height = sizeOf(request)};
  }
  std::unique_ptr<imports::Provider> provide(const graph::ImportRequest& request) const override {
    return std::make_unique<WavesProvider>(sizeOf(request));
  }

 private:
  static std::uint32_t sizeOf(const graph::ImportRequest& request) {
    return static_cast<std::uint32_t>(std::clamp(request.arguments[0].second.v[0], 1.0, 1024.0));
  }
};

class Fold : public passes::PassType {
 public:
  graph::PassType reflect() const override {
    return {.name = "fold",
            .doc = "Copies `source` into the four quarters of `destination`, mirrored.",
            .shader = graph::ShaderShape::none,
            .defaultReadTexture = graph::Kind::copy,
            .defaultWriteTexture = graph::Kind::copy,
            .fixedSlots = {{"source", graph::Access::read, "what is copied"},
                           {"destination", graph::Access::write, "where to"}},
            .framebuffers = true};
  }
  void execute(const passes::PassContext& pass) const override {
    const auto from = [&](std::uint32_t n) { return static_cast<GLint>(n); };
    const GLint width = from(pass.destination.width), height = from(pass.destination.height);
    for (const GLint right : {0, width})
      for (const GLint top : {0, height})
        glBlitNamedFramebuffer(pass.source.framebuffer, pass.destination.framebuffer, 0, 0,
                               from(pass.source.width), from(pass.source.height), right, top, width / 2,
                               height / 2, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
};

}  // namespace

int main(int count, char** words) {
  if (count != 4) return 2;
  auto passTypes = std::make_shared<passes::PassRegistry>(passes::PassRegistry::builtin());
  passTypes->add(std::make_unique<Fold>());
  auto own = std::make_shared<imports::ImportRegistry>(imports::ImportRegistry::builtin());
  own->add(std::make_unique<Waves>());

  text::Diagnostics diagnostics;
  const auto fail = [&] {
    std::fputs(diagnostics.text().c_str(), stderr);
    return 1;
  };
  const auto context = gl::createContext({}, diagnostics);  // without a window
  if (!context) return fail();
  scene::Scene scene;
  scene.cameras.add({});
  const runtime::World world(std::move(scene));
  runtime::Renderer renderer(*context, words[1], {.plugIns = {passTypes, own}});
  if (!renderer.load({.screenWidth = 160, .screenHeight = 160}, world, diagnostics)) return fail();
  renderer.frame(world, runtime::headlessFrame(world, 0, 1), diagnostics);
  const std::uint32_t seconds = static_cast<std::uint32_t>(std::atoi(words[3]));
  renderer.frame(world, runtime::headlessFrame(world, seconds, 1), diagnostics);
  const auto picture = renderer.readPresented8();
  if (!picture || diagnostics.hasErrors()) return fail();
  return assets::savePng8(words[2], picture->width, picture->height, 4, picture->texels, diagnostics)
             ? 0
             : fail();
}
