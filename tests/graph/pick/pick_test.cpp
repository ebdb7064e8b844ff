#include "engine/graph/pick/pick.h"

#include <doctest/doctest.h>

using namespace weft::graph;

TEST_CASE("a pick is a name with what is wanted of it") {
  const auto parsed = [](const char* text) {
    auto pick = parsePick(text);
    REQUIRE_MESSAGE(pick.has_value(), text);
    CHECK(pick->text == text);
    pick->text.clear();
    return *pick;
  };
  CHECK(parsed("hdr") == Pick{.text = {}, .name = "hdr", .pass = {}});
  CHECK(parsed("post.glow#2.mip[3]") ==
        Pick{.text = {}, .name = "post.glow", .version = 2, .mip = 3, .pass = {}});
  CHECK(parsed("sky.face[4]").layer == 4);
  CHECK(parsed("sky.layer[2].face[4].mip[1]") ==
        Pick{.text = {}, .name = "sky", .mip = 1, .layer = 16, .pass = {}});
  CHECK(parsed("maps[3].layer[7]") == Pick{.text = {}, .name = "maps[3]", .layer = 7, .pass = {}});
  CHECK(parsed("depth.stencil").stencil);
  CHECK(parsed("adapted@-2").history == 2);
  CHECK(parsed("@environment.mip[2]") == Pick{.text = {}, .name = "@environment", .mip = 2, .pass = {}});
  CHECK(parsed("hdr#1 after post.fog[2]") ==
        Pick{.text = {}, .name = "hdr", .version = 1, .pass = "post.fog[2]"});
  for (const char* text :
       {"", "2", "a b", "a.", "a.mip", "a.mip[]", "a.mip[x]", "a.face[6]", "a#0", "a#", "a@-0", "a@1",
        "a after ", "out/a", "a.png.", "mip[2].", "a.layer[70000]", "a.mip[99999999999]"})
    CHECK_MESSAGE(!parsePick(text), text);
}

TEST_CASE("a pattern matches whole texts") {
  CHECK(matchesPattern("hdr", "hdr"));
  CHECK_FALSE(matchesPattern("hdr", "hdr2"));
  CHECK(matchesPattern("*", ""));
  CHECK(matchesPattern("h*r", "hdr"));
  CHECK(matchesPattern("*a*b*", "xxaayyb"));
  CHECK_FALSE(matchesPattern("*a*b", "bbba"));
  CHECK(matchesPattern("gl?w*", "glow#2"));
  CHECK_FALSE(matchesPattern("?", ""));
}
