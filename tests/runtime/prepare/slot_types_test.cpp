#include "engine/runtime/prepare/slot_types.h"

#include <doctest/doctest.h>

using namespace weft;

TEST_CASE("a sampler type fits the resource's target, texel class and comparison, or says what would") {
  const graph::FlatResource flat{.format = graph::Format::rgba8};
  const graph::FlatResource cube{
      .format = graph::Format::depth32f, .target = graph::Target::texture_cube, .layers = 6};
  const graph::FlatResource integers{.format = graph::Format::r32ui};
  const graph::FlatUse one{}, six{.layers = 6};
  using runtime::opaqueMismatch;
  const auto opaqueTypeOf = [](std::string_view name) { return gl::findGlslType(name); };
  CHECK(opaqueMismatch(opaqueTypeOf("sampler2D"), flat, one, false).empty());
  CHECK(opaqueMismatch(opaqueTypeOf("sampler3D"), flat, one, false) == "a 2D type");
  CHECK(opaqueMismatch(opaqueTypeOf("samplerCubeShadow"), cube, six, true).empty());
  CHECK(opaqueMismatch(opaqueTypeOf("samplerCube"), cube, six, true) ==
        "a Shadow type (the slot says `as compare`)");
  CHECK(opaqueMismatch(opaqueTypeOf("sampler2D"), cube, one, false).empty());
  CHECK(opaqueMismatch(opaqueTypeOf("sampler2D"), integers, one, false) == "an unsigned int type");
  CHECK(opaqueMismatch(opaqueTypeOf("usampler2D"), integers, one, false).empty());
}
