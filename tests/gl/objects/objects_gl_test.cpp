#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <utility>

#include "engine/gl/objects/objects.h"
#include "tests/gl/gl_test.h"

using namespace weft::gl;
using weft::gl::test::CleanScope;
using weft::text::Code;
using weft::text::Diagnostics;

namespace {

template <class T>
std::span<const std::byte> bytesOf(const std::vector<T>& values) {
  return std::as_bytes(std::span(values));
}

Texture makeTexture(const TextureDesc& desc) {
  Diagnostics diagnostics;
  auto texture = Texture::create(desc, "test texture", diagnostics);
  REQUIRE_MESSAGE(texture, diagnostics.text());
  return std::move(*texture);
}

Framebuffer makeFramebuffer(std::vector<Attachment> attachments) {
  Diagnostics diagnostics;
  auto framebuffer = Framebuffer::create(attachments, "test framebuffer", diagnostics);
  REQUIRE_MESSAGE(framebuffer, diagnostics.text());
  return std::move(*framebuffer);
}

}  // namespace

TEST_CASE("owners move, count and delete") {
  CleanScope clean;
  const std::string before = liveObjects();
  const std::int64_t textures = liveObjects(ObjectKind::texture);
  {
    Texture a = makeTexture({});
    const GLuint id = a.id();
    Texture b = std::move(a);
    CHECK(a.id() == 0);
    CHECK(b.id() == id);
    CHECK(liveObjects(ObjectKind::texture) == textures + 1);
    Texture c = makeTexture({.width = 4});
    c = std::move(b);
    CHECK(c.id() == id);
    CHECK(liveObjects(ObjectKind::texture) == textures + 1);
    Fence fence = Fence::insert();
    Fence moved = std::move(fence);
    CHECK(fence.isSignalled());
    CHECK(moved.wait(1'000'000'000));
    CHECK(moved.isSignalled());
    CHECK(liveObjects() == "1 texture, 1 fence");
    char label[64] = {};
    glGetObjectLabel(GL_TEXTURE, id, sizeof label, nullptr, label);
    CHECK(std::string(label) == "test texture");
  }
  CHECK(liveObjects() == before);
  CHECK(liveObjects() == "none");
}

TEST_CASE("every target takes an upload and gives it back, level by level and layer by layer") {
  CleanScope clean;
  const TextureDesc descs[] = {
      {.target = GL_TEXTURE_2D, .format = GL_RGBA32F, .width = 6, .height = 3, .mips = 3},
      {.target = GL_TEXTURE_2D_ARRAY, .format = GL_RGBA32F, .width = 5, .height = 4, .layers = 3, .mips = 2},
      {.target = GL_TEXTURE_CUBE_MAP, .format = GL_RGBA32F, .width = 4, .height = 4, .layers = 6, .mips = 3},
      {.target = GL_TEXTURE_CUBE_MAP_ARRAY,
       .format = GL_RGBA32F,
       .width = 2,
       .height = 2,
       .layers = 12,
       .mips = 2},
      {.target = GL_TEXTURE_3D, .format = GL_RGBA32F, .width = 4, .height = 3, .depth = 5, .mips = 3},
  };
  for (const TextureDesc& desc : descs) {
    const Texture texture = makeTexture(desc);
    const auto valueAt = [](std::uint32_t mip, std::uint32_t layer, std::size_t i) {
      return static_cast<float>(mip * 10000 + layer * 100) + static_cast<float>(i);
    };
    for (int pass = 0; pass < 2; ++pass)
      for (std::uint32_t mip = 0; mip < desc.mips; ++mip) {
        const Extent extent = extentOf(desc, mip);
        for (std::uint32_t layer = 0; layer < extent.layers; ++layer) {
          std::vector<float> values(std::size_t{extent.width} * extent.height * 4);
          for (std::size_t i = 0; i < values.size(); ++i) values[i] = valueAt(mip, layer, i);
          if (pass == 0)
            uploadTexture(texture.ref(), mip, layer, GL_RGBA, GL_FLOAT, bytesOf(values));
          else
            CHECK(readFloats(texture.ref(), mip, layer) == values);
        }
      }
  }
  CHECK(extentOf(descs[4], 1).layers == 2);
}

TEST_CASE("what is read back in several parts is whole") {
  CleanScope clean;
  const Texture large = makeTexture({.format = GL_R32UI, .width = 4096, .height = 4100});
  std::vector<std::uint32_t> numbers(4096 * 4100);
  for (std::uint32_t i = 0; i < numbers.size(); ++i) numbers[i] = i;
  uploadTexture(large.ref(), 0, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, bytesOf(numbers));
  const auto back = readTexture(large.ref(), 0, 0, GL_RED_INTEGER, GL_UNSIGNED_INT);
  REQUIRE(back.size() == 4 * numbers.size());
  CHECK(std::memcmp(back.data(), numbers.data(), back.size()) == 0);
}

TEST_CASE("odd rows, integers and depth come back exactly") {
  CleanScope clean;
  const Texture bytes = makeTexture({.format = GL_R8, .width = 3, .height = 2});
  const std::vector<std::uint8_t> texels{1, 2, 3, 4, 5, 255};
  uploadTexture(bytes.ref(), 0, 0, GL_RED, GL_UNSIGNED_BYTE, bytesOf(texels));
  const auto back = readTexture(bytes.ref(), 0, 0, GL_RED, GL_UNSIGNED_BYTE);
  REQUIRE(back.size() == 6);
  CHECK(std::memcmp(back.data(), texels.data(), 6) == 0);
  const auto floats = readFloats(bytes.ref());
  CHECK(floats[5 * 4] == 1.0f);
  CHECK(floats[5 * 4 + 1] == 0.0f);
  CHECK(floats[5 * 4 + 3] == 1.0f);

  const Texture integers = makeTexture({.format = GL_R32UI, .width = 2});
  const std::vector<std::uint32_t> numbers{7, 70000};
  uploadTexture(integers.ref(), 0, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, bytesOf(numbers));
  CHECK(readFloats(integers.ref())[4] == 70000.0f);
  const Texture negatives = makeTexture({.format = GL_R32I, .width = 1});
  const std::vector<std::int32_t> minus{-5};
  uploadTexture(negatives.ref(), 0, 0, GL_RED_INTEGER, GL_INT, bytesOf(minus));
  CHECK(readFloats(negatives.ref())[0] == -5.0f);

  const Texture depth = makeTexture({.format = GL_DEPTH32F_STENCIL8, .width = 2, .height = 2});
  const Framebuffer target = makeFramebuffer({{.point = GL_DEPTH_STENCIL_ATTACHMENT, .texture = depth.id()}});
  glClearNamedFramebufferfi(target.id(), GL_DEPTH_STENCIL, 0, 0.25f, 9);
  CHECK(readFloats(depth.ref()) == std::vector<float>(4, 0.25f));
  CHECK(clientFormatOf(GL_DEPTH32F_STENCIL8).channels == 1);
}

TEST_CASE("textures that cannot be are refused with the number that is wrong") {
  CleanScope clean;
  const std::pair<TextureDesc, const char*> cases[] = {
      {{.width = 100000}, "largest side"},
      {{.width = 8, .height = 8, .mips = 1000000000}, "at most 4 mips"},
      {{.target = GL_TEXTURE_2D_ARRAY, .layers = 1000000}, "layers"},
      {{.target = GL_TEXTURE_2D_MULTISAMPLE, .samples = 4096}, "samples"},
  };
  for (const auto& [desc, reason] : cases) {
    Diagnostics diagnostics;
    CHECK_FALSE(Texture::create(desc, "impossible", diagnostics));
    REQUIRE(diagnostics.size() == 1);
    CHECK(diagnostics.items()[0].code == Code::textureNotCreated);
    CHECK_MESSAGE(diagnostics.items()[0].message.find(reason) != std::string::npos, diagnostics.text());
    CHECK(diagnostics.items()[0].resource == "impossible");
  }
  // What only the driver can know: more memory than there is, and a format that is none.
  Diagnostics diagnostics;
  CHECK_FALSE(Texture::create(
      {.target = GL_TEXTURE_2D_ARRAY, .format = GL_RGBA32F, .width = 16384, .height = 16384, .layers = 512},
      "huge", diagnostics));
  CHECK_FALSE(Texture::create({.format = GL_RGBA}, "unsized", diagnostics));
  CHECK(diagnostics.errorCount() == 2);
  CHECK_FALSE(Buffer::create(std::uint64_t{1} << 60, 0, "huge buffer", diagnostics));
  CHECK(diagnostics.contains(Code::bufferNotCreated));
  clean.forgive();
}

TEST_CASE("a view shows one level, one layer, another format of the class, or the stencil") {
  CleanScope clean;
  Diagnostics diagnostics;
  std::optional<Texture> survivor;
  {
    const Texture texture = makeTexture(
        {.target = GL_TEXTURE_2D_ARRAY, .format = GL_RGBA8, .width = 8, .height = 4, .layers = 3, .mips = 2});
    std::vector<std::uint8_t> texels(4 * 2 * 4, 0x80);
    uploadTexture(texture.ref(), 1, 2, GL_RGBA, GL_UNSIGNED_BYTE, bytesOf(texels));
    survivor =
        Texture::create(texture.ref(), {.format = GL_R32UI, .mip = 1, .layer = 2}, "view", diagnostics);
    REQUIRE_MESSAGE(survivor, diagnostics.text());
    CHECK(liveObjects(ObjectKind::texture) == 2);
    CHECK(survivor->desc().width == 4);
    CHECK(survivor->desc().height == 2);
    CHECK(survivor->desc().target == GL_TEXTURE_2D);
  }
  // The storage lives on in the view.
  const auto words = readTexture(survivor->ref(), 0, 0, GL_RED_INTEGER, GL_UNSIGNED_INT);
  std::uint32_t word = 0;
  std::memcpy(&word, words.data(), 4);
  CHECK(word == 0x80808080u);

  const Texture depth = makeTexture({.format = GL_DEPTH32F_STENCIL8, .width = 2, .height = 2});
  const auto stencil = Texture::create(depth.ref(), {.stencil = true}, "stencil", diagnostics);
  REQUIRE(stencil);
  GLint mode = 0;
  glGetTextureParameteriv(stencil->id(), GL_DEPTH_STENCIL_TEXTURE_MODE, &mode);
  CHECK(mode == GL_STENCIL_INDEX);
  CHECK(diagnostics.empty());

  // Depth is in a class of its own, and there is no level 5.
  const Texture plain = makeTexture({.format = GL_DEPTH_COMPONENT32F, .width = 2, .height = 2});
  CHECK_FALSE(Texture::create(plain.ref(), {.format = GL_R32F}, "depth as color", diagnostics));
  CHECK_FALSE(Texture::create(plain.ref(), {.mip = 5}, "no such level", diagnostics));
  CHECK(diagnostics.errorCount() == 2);
  CHECK(diagnostics.contains(Code::viewNotCreated));
  clean.forgive();
}

TEST_CASE("framebuffers take levels, layers and whole cubes, and say why they are incomplete") {
  CleanScope clean;
  const Texture color = makeTexture(
      {.target = GL_TEXTURE_2D_ARRAY, .format = GL_RGBA8, .width = 8, .height = 8, .layers = 2, .mips = 2});
  const Texture second = makeTexture({.format = GL_R16F, .width = 4, .height = 4});
  // A gap: draw buffer 1 writes nothing.
  const Framebuffer gap =
      makeFramebuffer({{.point = GL_COLOR_ATTACHMENT0, .texture = color.id(), .mip = 1, .layer = 1},
                       {.point = GL_COLOR_ATTACHMENT2, .texture = second.id()}});
  const float white[] = {1, 1, 1, 1};
  for (const GLint buffer : {0, 1, 2}) glClearNamedFramebufferfv(gap.id(), GL_COLOR, buffer, white);
  CHECK(readFloats(color.ref(), 1, 1)[0] == 1.0f);
  CHECK(readFloats(second.ref())[0] == 1.0f);

  const Texture cube = makeTexture(
      {.target = GL_TEXTURE_CUBE_MAP, .format = GL_DEPTH_COMPONENT32F, .width = 4, .height = 4, .layers = 6});
  const Framebuffer layered = makeFramebuffer({{.point = GL_DEPTH_ATTACHMENT, .texture = cube.id()}});
  const float half = 0.5f;
  glClearNamedFramebufferfv(layered.id(), GL_DEPTH, 0, &half);
  for (std::uint32_t face = 0; face < 6; ++face) CHECK(readFloats(cube.ref(), 0, face)[15] == 0.5f);

  Diagnostics diagnostics;
  CHECK(Framebuffer::create({}, "attachmentless", diagnostics, {16, 16}));
  CHECK(diagnostics.empty());
  CHECK_FALSE(Framebuffer::create({}, "empty", diagnostics));
  const Texture shared = makeTexture({.format = GL_RGB9_E5, .width = 4, .height = 4});
  const Attachment unrenderable{.texture = shared.id()};
  CHECK_FALSE(Framebuffer::create({&unrenderable, 1}, "shared exponent", diagnostics));
  const Texture samples = makeTexture(
      {.target = GL_TEXTURE_2D_MULTISAMPLE, .format = GL_RGBA8, .width = 4, .height = 4, .samples = 4});
  const Attachment mixed[] = {{.texture = samples.id()},
                              {.point = GL_COLOR_ATTACHMENT1, .texture = second.id()}};
  CHECK_FALSE(Framebuffer::create(mixed, "mixed", diagnostics));
  REQUIRE(diagnostics.size() == 3);
  for (const auto& d : diagnostics.items()) CHECK(d.code == Code::incompleteFramebuffer);
  CHECK(diagnostics.items()[0].message.find("MISSING_ATTACHMENT") != std::string::npos);
  CHECK(diagnostics.items()[1].found.find("GL_RGB9_E5") != std::string::npos);
  CHECK_MESSAGE(diagnostics.items()[2].message.find("INCOMPLETE_MULTISAMPLE") != std::string::npos,
                diagnostics.items()[2].message);
  clean.forgive();
}

TEST_CASE("buffers hold, change and give back bytes, and a fence is reached") {
  CleanScope clean;
  Diagnostics diagnostics;
  const std::vector<std::uint32_t> values{1, 2, 3, 4};
  auto buffer = Buffer::create(16, GL_DYNAMIC_STORAGE_BIT, "buffer", diagnostics, values.data());
  REQUIRE(buffer);
  CHECK(buffer->bytes() == 16);
  const std::vector<std::uint32_t> patch{9};
  uploadBuffer(buffer->id(), 8, bytesOf(patch));
  const auto back = readBuffer(buffer->id(), 4, 12);
  std::uint32_t words[3];
  std::memcpy(words, back.data(), 12);
  CHECK(words[0] == 2);
  CHECK(words[1] == 9);

  const Fence fence = Fence::insert();
  CHECK(fence.wait(1'000'000'000));
}

TEST_CASE("vertex arrays keep what they are told") {
  CleanScope clean;
  Diagnostics diagnostics;
  auto buffer = Buffer::create(64, 0, "vertices", diagnostics);
  REQUIRE(buffer);
  VertexArray array = VertexArray::create("array");
  const VertexAttribute attributes[] = {{.location = 0}, {.location = 3, .components = 2, .offset = 12}};
  array.setVertices(0, buffer->id(), 0, 20, attributes);
  array.setIndices(buffer->id());
  GLint value = 0;
  glGetVertexArrayIndexediv(array.id(), 3, GL_VERTEX_ATTRIB_ARRAY_ENABLED, &value);
  CHECK(value == 1);
  glGetVertexArrayIndexediv(array.id(), 3, GL_VERTEX_ATTRIB_RELATIVE_OFFSET, &value);
  CHECK(value == 12);
  glGetVertexArrayiv(array.id(), GL_ELEMENT_ARRAY_BUFFER_BINDING, &value);
  CHECK(static_cast<GLuint>(value) == buffer->id());
}

TEST_CASE("client formats have sizes") {
  CHECK(texelBytes(GL_RGBA, GL_HALF_FLOAT) == 8);
  CHECK(texelBytes(GL_RGB, GL_UNSIGNED_BYTE) == 3);
  CHECK(texelBytes(GL_RED_INTEGER, GL_UNSIGNED_INT) == 4);
  CHECK(texelBytes(GL_DEPTH_COMPONENT, GL_FLOAT) == 4);
  CHECK(texelBytes(GL_RGB, GL_UNSIGNED_INT_10F_11F_11F_REV) == 4);
  CHECK(classOf(GL_RGBA16F) == FormatClass::floating);
  CHECK(classOf(GL_RG32I) == FormatClass::signed_integer);
}
