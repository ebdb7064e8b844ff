// One sampler for equal wishes, another for each other wish; GL says what each of them does.
#include <array>
#include <set>

#include "engine/runtime/storage/caches.h"
#include "tests/runtime/stage.h"

namespace prepare_sampler_cache_test {

using namespace weft;
using namespace weft::runtime::test;
using graph::Compare;
using graph::Sampler;
using graph::TexelKind;

namespace {

GLenum asked(GLuint sampler, GLenum what) {
  GLint value = 0;
  glGetSamplerParameteriv(sampler, what, &value);
  return static_cast<GLenum>(value);
}

}  // namespace

TEST_CASE("filters: nearest unless the slot says linear, between levels only where the view has several") {
  const CleanScope clean;
  runtime::SamplerCache cache;
  const auto filtersOf = [&](bool linear, bool mipmapped) {
    const GLuint id = cache.get({.linear = linear}, {}, mipmapped, TexelKind::floating);
    return std::array<GLenum, 2>{asked(id, GL_TEXTURE_MIN_FILTER), asked(id, GL_TEXTURE_MAG_FILTER)};
  };
  CHECK(filtersOf(false, false) == std::array<GLenum, 2>{GL_NEAREST, GL_NEAREST});
  CHECK(filtersOf(false, true) == std::array<GLenum, 2>{GL_NEAREST_MIPMAP_NEAREST, GL_NEAREST});
  CHECK(filtersOf(true, false) == std::array<GLenum, 2>{GL_LINEAR, GL_LINEAR});
  CHECK(filtersOf(true, true) == std::array<GLenum, 2>{GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR});
}

TEST_CASE("a comparison is that of the slot, and filters") {
  const CleanScope clean;
  runtime::SamplerCache cache;
  const auto comparedBy = [&](Compare function) {
    const GLuint id = cache.get({.compare = true, .function = function}, {}, false, TexelKind::depth);
    CHECK(asked(id, GL_TEXTURE_COMPARE_MODE) == GL_COMPARE_REF_TO_TEXTURE);
    CHECK(asked(id, GL_TEXTURE_MAG_FILTER) == GL_LINEAR);
    return asked(id, GL_TEXTURE_COMPARE_FUNC);
  };
  CHECK(comparedBy(Compare::greater) == GL_GREATER);
  CHECK(comparedBy(Compare::less_equal) == GL_LEQUAL);
  CHECK(comparedBy(Compare::always) == GL_ALWAYS);
  const GLuint plain = cache.get({.linear = true}, {}, false, TexelKind::depth);
  CHECK(asked(plain, GL_TEXTURE_COMPARE_MODE) == GL_NONE);
}

TEST_CASE(
    "equal wishes share a sampler, and the color of a border tells samplers apart only where there is one") {
  const CleanScope clean;
  runtime::SamplerCache cache;
  const auto get = [&](const Sampler& sampler, const graph::BorderColor& color = {},
                       TexelKind texels = TexelKind::floating) {
    return cache.get(sampler, color, false, texels);
  };
  using graph::Wrap;
  std::set<GLuint> samplers;
  for (const Wrap wrap : {Wrap::clamp, Wrap::repeat, Wrap::mirror, Wrap::border}) {
    const GLuint id = get({.wrap = wrap});
    CHECK(samplers.insert(id).second);
    CHECK(get({.wrap = wrap}) == id);
  }
  CHECK(get({}, {1, 2, 3, 4}) == get({}));
  const GLuint red = get({.wrap = Wrap::border}, {1, 0, 0, 1});
  CHECK(red != get({.wrap = Wrap::border}));
  CHECK(red != get({.wrap = Wrap::border}, {1, 0, 0, 1}, TexelKind::unsigned_integer));
  std::array<float, 4> color{};
  glGetSamplerParameterfv(red, GL_TEXTURE_BORDER_COLOR, color.data());
  CHECK(color == std::array<float, 4>{1, 0, 0, 1});
  // Integers: whole numbers, held within the range of the texels.
  const GLuint below = get({.wrap = Wrap::border}, {-3, 7, 0, 5e9f}, TexelKind::unsigned_integer);
  std::array<GLuint, 4> naturals{};
  glGetSamplerParameterIuiv(below, GL_TEXTURE_BORDER_COLOR, naturals.data());
  CHECK(naturals == std::array<GLuint, 4>{0, 7, 0, 4294967295u});
  const GLuint signedBorder = get({.wrap = Wrap::border}, {-3, 7, 0, 5e9f}, TexelKind::signed_integer);
  std::array<GLint, 4> wholes{};
  glGetSamplerParameterIiv(signedBorder, GL_TEXTURE_BORDER_COLOR, wholes.data());
  CHECK(wholes == std::array<GLint, 4>{-3, 7, 0, 2147483647});
}

}  // namespace prepare_sampler_cache_test
