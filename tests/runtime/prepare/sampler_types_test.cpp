#include "engine/runtime/prepare/sampler_types.h"

#include <doctest/doctest.h>

using namespace weft;

TEST_CASE("a sampler type fits the resource's target, texel class and comparison, or says what would") {
  const graph::FlatResource flat{.format = graph::Format::rgba8};
  const graph::FlatResource cube{
      .format = graph::Format::depth32f, .target = graph::Target::texture_cube, .layers = 6};
  const graph::FlatResource integers{.format = graph::Format::r32ui};
  const graph::FlatUse one{}, six{.layers = 6};
  using runtime::opaqueMismatch;
  using runtime::opaqueTypeOf;
  CHECK(opaqueMismatch(opaqueTypeOf(GL_SAMPLER_2D), flat, one, false).empty());
  CHECK(opaqueMismatch(opaqueTypeOf(GL_SAMPLER_3D), flat, one, false) == "a 2D type");
  CHECK(opaqueMismatch(opaqueTypeOf(GL_SAMPLER_CUBE_SHADOW), cube, six, true).empty());
  CHECK(opaqueMismatch(opaqueTypeOf(GL_SAMPLER_CUBE), cube, six, true) ==
        "a Shadow type (the slot says `as compare`)");
  CHECK(opaqueMismatch(opaqueTypeOf(GL_SAMPLER_2D), cube, one, false).empty());
  CHECK(opaqueMismatch(opaqueTypeOf(GL_SAMPLER_2D), integers, one, false) == "an unsigned int type");
  CHECK(opaqueMismatch(opaqueTypeOf(GL_UNSIGNED_INT_SAMPLER_2D), integers, one, false).empty());
}
