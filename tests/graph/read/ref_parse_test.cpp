#include "engine/graph/read/ref_parse.h"

#include <doctest/doctest.h>

#include "engine/graph/language/keys.h"
#include "tests/graph/language/expr_text.h"

using namespace weft::graph;
using weft::text::Code;
using weft::text::Diagnostics;

namespace {

Place refPlaceAt(std::uint32_t column) {
  return {"t.json", 3, column};
}

RefDesc parse(std::string_view text) {
  Diagnostics diagnostics;
  auto ref = parseRef(text, refPlaceAt(1), diagnostics);
  REQUIRE_MESSAGE(ref, diagnostics.text());
  CHECK(diagnostics.empty());
  CHECK(ref->text == text);
  return *std::move(ref);
}

struct RefFailure {
  Code code{};
  std::uint32_t column = 0;
  std::string message, hint;
};

RefFailure refFailure(std::string_view text) {
  Diagnostics diagnostics;
  CHECK_MESSAGE(!parseRef(text, refPlaceAt(1), diagnostics), text);
  REQUIRE_MESSAGE(diagnostics.size() == 1, diagnostics.text());
  const auto& d = diagnostics.items()[0];
  return {d.code, d.place.column, d.message, d.hint};
}

}  // namespace

TEST_CASE("plain names") {
  const RefDesc keys = parse("keys");
  CHECK(keys.name == "keys");
  CHECK(!keys.import);
  CHECK(!keys.optional);
  CHECK(!keys.condition.present());
  CHECK(!keys.kind);
  CHECK(parse("ibl.environment").name == "ibl.environment");
  CHECK(parse("@environment").import);
  CHECK(parse("@environment").name == "environment");
  CHECK(parse("  hdr ").place.column == 3);
}

TEST_CASE("selectors and spans") {
  const RefDesc glow = parse("glow.mip[i-1]");
  REQUIRE(glow.mip);
  CHECK(!glow.mip->range);
  CHECK(textOf(glow.mip->first) == "i - 1");
  CHECK(glow.mip->first.place().column == 10);
  const RefDesc rest = parse("sky_map.mip[1..]");
  CHECK(rest.mip->range);
  CHECK(rest.mip->first.text() == "1");
  CHECK(!rest.mip->last.present());
  const RefDesc all = parse("x1.layer[..]");
  CHECK(all.layer->range);
  CHECK(!all.layer->first.present());
  CHECK(parse("a.mip[0 .. min(3, $n)]").mip->last.text() == "min(3, $n)");
  CHECK(parse("a.mip[..2]").mip->last.text() == "2");
  const RefDesc cube = parse("point_maps.layer[l].face[f]");
  CHECK(cube.layer->first.text() == "l");
  CHECK(cube.face->first.text() == "f");
  const RefDesc light = parse("@shadowed_lights[l].face[[1, 2].x]");
  CHECK(light.element->first.text() == "l");
  CHECK(light.face->first.text() == "[1, 2].x");
  CHECK(parse("gi.sh[2].mip[0]").name == "gi.sh");
  CHECK(parse("depth.stencil").stencil);
  CHECK(parse("depth.stencil").name == "depth");
}

TEST_CASE("history, words, conditions, optional") {
  CHECK(parse("adapted@-1").history == 1);
  CHECK(parse("adapted @-12").history == 12);
  const RefDesc resolved = parse("resolved@-1 as linear");
  CHECK(resolved.history == 1);
  CHECK(resolved.sampler.linear);
  CHECK(resolved.sampler.wrap == Wrap::clamp);
  const RefDesc sky = parse("ibl.environment as linear wrap");
  CHECK(sky.sampler.linear);
  CHECK(sky.sampler.wrap == Wrap::repeat);
  CHECK(parse("depth as depth").kind == Kind::depth);
  CHECK(parse("map as compare ?").sampler.compare);
  CHECK(parse("map as compare").sampler.linear);
  CHECK(!parse("map as nearest compare").sampler.linear);
  CHECK(parse("map as sampled linear").kind == Kind::sampled);
  CHECK(parse("hdr as copy linear").sampler.linear);  // a blit's filter, as expanded graphs say it
  CHECK(parse("glow.mip[0]?").optional);
  const RefDesc bloom = parse("glow.mip[0] if $bloom ?");
  CHECK(bloom.optional);
  CHECK(textOf(bloom.condition) == "$bloom");
  CHECK(bloom.condition.place().column == 16);
  const RefDesc sh = parse("gi.sh as linear if $gi_sampling == textures ?");
  CHECK(textOf(sh.condition) == "$gi_sampling == textures");
  CHECK(textOf(parse("a if $b ? $c : $d").condition) == "$b ? $c : $d");
  CHECK(!parse("a if $b ? $c : $d").optional);
  CHECK(parse("a if $b ? $c : $d ?").optional);
  CHECK(textOf(parse("cpu_order if $sort != gpu_bitonic").condition) == "$sort != gpu_bitonic");
}

TEST_CASE("words with arguments behind 'as'") {
  CHECK(parse("a as mirror").sampler.wrap == Wrap::mirror);
  CHECK(parse("a as border").sampler == Sampler{.wrap = Wrap::border});
  CHECK(parse("a as border").border == BorderColor{});
  CHECK(parse("a as border(0.5)").sampler == Sampler{.wrap = Wrap::border});
  CHECK(parse("a as border(0.5)").border == BorderColor{0.5f, 0.5f, 0.5f, 0.5f});
  const RefDesc map = parse("a as linear border( 1,-2.5 , 3e2, 0 ) if $b ?");
  CHECK(map.sampler == Sampler{.linear = true, .wrap = Wrap::border});
  CHECK(map.border == BorderColor{1, -2.5f, 300, 0});
  CHECK(textOf(map.condition) == "$b");
  CHECK(map.optional);
  CHECK(!parse("a as compare").sampler.function);
  for (std::size_t i = 0; i < kCompareNames.size(); ++i) {
    const RefDesc ref = parse("a as compare(" + std::string(kCompareNames[i]) + ") mirror");
    CHECK(
        ref.sampler ==
        Sampler{.linear = true, .wrap = Wrap::mirror, .compare = true, .function = static_cast<Compare>(i)});
  }
  for (const char* text : {"a as border()", "a as border(1, 2)", "a as border(1, 2, 3)",
                           "a as border(1,,2,3)", "a as border(1, 2, 3, 4, 5)", "a as border(red)",
                           "a as border(inf)", "a as border(1e99)", "a as border($x)", "a as border(1 2)"}) {
    const RefFailure d = refFailure(text);
    CHECK_MESSAGE(d.code == Code::badReference, text);
    CHECK_MESSAGE(d.column == 6, text);
    CHECK_MESSAGE(d.hint.find("border(0, 0, 0, 1)") != std::string::npos, text);
  }
  CHECK(refFailure("a as compare(lesser)").hint == "did you mean 'less'?");
  CHECK(refFailure("a as compare(lequal)").hint == "write 'less_equal'");
  CHECK(refFailure("a as compare()").hint.find("greater_equal") != std::string::npos);
  CHECK(refFailure("a as compare(less").column == 13);
  CHECK(refFailure("a as border(1").hint == "close it with ')'");
  CHECK(refFailure("a as mirror border").column == 13);
  CHECK(refFailure("a as border(1) image").column == 16);
  CHECK(refFailure("a as border(1) border(0, 0, 0, 1)").column == 16);
  CHECK(refFailure("a as linear linear").column == 13);
  CHECK(refFailure("a as compare(less) compare(greater)").column == 20);
  CHECK(refFailure("a as mirrored_repeat").hint == "write 'mirror'");
}

TEST_CASE("errors carry column and fix") {
  CHECK(refFailure("").column == 1);
  CHECK(refFailure("  ?").code == Code::badReference);
  CHECK(refFailure("mip[0]").message == "'mip' may not stand in a name");
  CHECK(refFailure("a.x").column == 2);
  CHECK(refFailure("a.b.").column == 5);
  CHECK(refFailure("a..b").column == 3);
  CHECK(refFailure("9lives").column == 1);
  CHECK(refFailure("\xC3\xA9t\xC3\xA9").message == "'\xC3\xA9' where a name is expected");
  CHECK(refFailure("a[0].b[1]").hint == "known: mip, layer, face, stencil");
  CHECK(refFailure("a[0].mips[1]").hint == "did you mean 'mip'?");
  CHECK(refFailure("glow.mip").column == 9);
  CHECK(refFailure("glow.mip[0").column == 9);
  CHECK(refFailure("glow.mip[]").column == 10);
  CHECK(refFailure("glow.mip[0].mip[1]").column == 12);
  CHECK(refFailure("a[0][1]").column == 5);
  CHECK(refFailure("glow.mip[1 +]").code == Code::badExpression);
  CHECK(refFailure("glow.mip[1 +]").column == 13);
  CHECK(refFailure("glow.mip[(0]").column == 9);
  CHECK(refFailure("hdr@1").column == 4);
  CHECK(refFailure("hdr@-").column == 4);
  CHECK(refFailure("hdr@-0").column == 4);
  CHECK(refFailure("hdr@--1").column == 4);
  CHECK(refFailure("hdr@").column == 4);
  CHECK(refFailure("hdr@-99999999999").column == 4);
  CHECK(refFailure("hdr as").column == 7);
  CHECK(refFailure("hdr as if $x").column == 8);
  CHECK(refFailure("hdr as liner").hint == "did you mean 'linear'?");
  CHECK(refFailure("hdr as liner").column == 8);
  CHECK(refFailure("hdr as linear nearest").column == 15);
  CHECK(refFailure("hdr as wrap clamp").column == 13);
  CHECK(refFailure("hdr as depth color").column == 14);
  CHECK(refFailure("hdr as depth linear").column == 14);
  CHECK(refFailure("hdr linear").hint == "write 'as linear'");
  CHECK(refFailure("hdr if").column == 7);
  CHECK(refFailure("hdr if $").code == Code::badExpression);
  CHECK(refFailure("hdr if $").column == 8);
  CHECK(refFailure("hdr? if $x").column == 4);
  CHECK(refFailure("hdr as linear .mip[0]").column == 15);
  CHECK(refFailure("a b c").code == Code::badReference);
}

TEST_CASE("references and values are told apart where both may stand") {
  CHECK(looksLikeRef("@cut"));
  CHECK(looksLikeRef("camera if $progressive"));
  CHECK(looksLikeRef("ibl.environment"));
  CHECK(!looksLikeRef("size(hdr)"));
  CHECK(!looksLikeRef("size (hdr)"));
  CHECK(!looksLikeRef("$taa ? 1 : 0"));
  CHECK(!looksLikeRef("screen"));
  CHECK(!looksLikeRef("device.software"));
  CHECK(!looksLikeRef("1 + 2"));
  CHECK(!looksLikeRef(""));
}

TEST_CASE("words with arguments") {
  Diagnostics diagnostics;
  CHECK(parseCallText("quad", refPlaceAt(1), diagnostics)->name == "quad");
  const auto ball = parseCallText("icosphere($subdivision)", refPlaceAt(1), diagnostics);
  REQUIRE(ball);
  CHECK(ball->name == "icosphere");
  REQUIRE(ball->arguments.size() == 1);
  CHECK(ball->arguments[0].text() == "$subdivision");
  CHECK(ball->arguments[0].place().column == 11);
  CHECK(parseCallText("box(1, min(2, 3))", refPlaceAt(1), diagnostics)->arguments.size() == 2);
  CHECK(diagnostics.empty());
  for (const char* text : {"", "2", "quad x", "icosphere(2", "icosphere(2) x", "icosphere()", "icosphere(1,)",
                           "a)(", "a(1))", "a(]"})
    CHECK_MESSAGE(!parseCallText(text, refPlaceAt(1), diagnostics), text);
  CHECK(diagnostics.size() == 10);
}
