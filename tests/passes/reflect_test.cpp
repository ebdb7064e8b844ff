// What the built-in pass types say of themselves, and that an embedder's stands beside them.
#include <doctest/doctest.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "engine/passes/pass_type.h"

using namespace weft;
using namespace weft::passes;

namespace {

graph::PassType typeOf(std::string_view name) {
  const PassRegistry registry = PassRegistry::builtin();
  const PassType* type = registry.find(name);
  REQUIRE(type);
  return type->reflect();
}

bool takes(const graph::PassType& type, std::string_view key) {
  return std::ranges::find(type.keys, key) != type.keys.end();
}

class Mirror : public PassType {
 public:
  graph::PassType reflect() const override {
    return {.name = "mirror", .doc = "of an embedder", .shader = graph::ShaderShape::none};
  }
  void execute(const PassContext&) const override {}
};

}  // namespace

TEST_CASE("every built-in pass type is found under the name that it reflects, with a text") {
  const PassRegistry registry = PassRegistry::builtin();
  std::set<std::string> names;
  for (const graph::PassType& type : registry.reflect()) {
    CAPTURE(type.name);
    CHECK(names.insert(type.name).second);
    CHECK_FALSE(type.doc.empty());
    REQUIRE(registry.find(type.name));
    CHECK(registry.find(type.name)->reflect().doc == type.doc);
  }
  CHECK(fmt::format("{}", fmt::join(names, " ")) == "blit compute draw fullscreen mipmap");
  CHECK_FALSE(registry.find("mirror"));
}

TEST_CASE("pass types say what checks and the executor go by") {
  CHECK(typeOf("fullscreen").shader == graph::ShaderShape::fragment);
  CHECK(typeOf("draw").shader == graph::ShaderShape::draw);
  CHECK(typeOf("compute").shader == graph::ShaderShape::compute);
  CHECK(typeOf("compute").defaultWriteTexture == graph::Kind::image);
  CHECK(takes(typeOf("compute"), "threads"));
  CHECK_FALSE(takes(typeOf("fullscreen"), "threads"));
  CHECK(takes(typeOf("draw"), "list"));
  for (const char* copy : {"blit", "mipmap"}) {
    const graph::PassType type = typeOf(copy);
    CHECK(type.shader == graph::ShaderShape::none);
    CHECK(type.defaultReadTexture == graph::Kind::copy);
    REQUIRE(type.fixedSlots.size() == 2);
    CHECK(type.fixedSlots[0].access == graph::Access::read);
    CHECK(type.fixedSlots[1].access == graph::Access::write);
  }
  CHECK(typeOf("blit").framebuffers);
  CHECK_FALSE(typeOf("blit").fromSource);
  CHECK(typeOf("mipmap").fromSource);
  CHECK(typeOf("mipmap").touches != 0);
}

TEST_CASE("an embedder's pass type stands behind the built-in ones") {
  PassRegistry registry = PassRegistry::builtin();
  registry.add(std::make_unique<Mirror>());
  CHECK(registry.reflect().back().name == "mirror");
  REQUIRE(registry.find("mirror"));
  CHECK_FALSE(PassRegistry::builtin().find("mirror"));
}
