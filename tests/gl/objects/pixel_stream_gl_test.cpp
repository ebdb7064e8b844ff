#include "engine/gl/objects/streams.h"
#include "tests/gl/gl_test.h"

using namespace weft;
using namespace weft::gl;

static std::vector<std::byte> makeTexels(std::uint32_t width, std::uint32_t height) {
  std::vector<std::byte> texels(std::size_t{width} * height * 4);
  for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<std::byte>(i * 31 % 251);
  return texels;
}

TEST_CASE("a level sent in portions is the level, whatever the portion, and other levels stay") {
  const test::CleanScope scope;
  text::Diagnostics diagnostics;
  const std::uint32_t width = 33, height = 20;
  const std::vector<std::byte> texels = makeTexels(width, height);
  for (const std::uint32_t rows : {1u, 3u, 7u, 20u, 100u}) {
    CAPTURE(rows);
    const auto texture = Texture::create({.width = 66, .height = 40, .mips = 3}, "stream", diagnostics);
    const std::vector<std::byte> others(66 * 40 * 4, std::byte{9});
    uploadTexture(texture->ref(), 0, 0, GL_RGBA, GL_UNSIGNED_BYTE, others);
    auto stream =
        PixelStream::create(texture->ref(), 1, GL_RGBA, GL_UNSIGNED_BYTE, rows, "stream", diagnostics);
    REQUIRE(stream);
    std::uint32_t before = 0;
    while (!stream->sentAll()) {
      stream->advance(texels);
      CHECK(stream->rows() - before <= rows);
      before = stream->rows();
    }
    stream->advance(texels);
    CHECK(stream->rows() == height);
    CHECK(readTexture(texture->ref(), 1, 0, GL_RGBA, GL_UNSIGNED_BYTE) == texels);
    CHECK(readTexture(texture->ref(), 0, 0, GL_RGBA, GL_UNSIGNED_BYTE) == others);
  }
  CHECK(diagnostics.empty());
}

TEST_CASE("a stream may go before it is done, and moves") {
  const test::CleanScope scope;
  text::Diagnostics diagnostics;
  const std::vector<std::byte> texels = makeTexels(16, 16);
  const auto texture = Texture::create({.width = 16, .height = 16}, "stream", diagnostics);
  auto stream = PixelStream::create(texture->ref(), 0, GL_RGBA, GL_UNSIGNED_BYTE, 4, "stream", diagnostics);
  stream->advance(texels);
  PixelStream moved = std::move(*stream);
  stream.reset();
  moved.advance(texels);
  CHECK(moved.rows() == 8);
  CHECK(!moved.sentAll());
}
