// Hostile and broken models: one diagnostic each, quickly.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <functional>

#include "engine/assets/models/model_file.h"
#include "tests/assets/models/failure.h"
#include "tests/assets/models/gltf_maker.h"
#include "tests/temporary_folder.h"

using namespace weft;
using namespace weft::assets;
using text::Code;
using weft::test::failureOf;
using weft::test::GltfMaker;
using weft::test::json;

namespace {

// A square with one thing changed.
text::Diagnostic failureWith(const std::function<void(GltfMaker&)>& change) {
  const TemporaryFolder folder;
  GltfMaker maker;
  maker.square();
  change(maker);
  return failureOf(folder, "m.gltf", maker.gltf());
}

json& firstPrimitive(GltfMaker& maker) {
  return maker.document["meshes"][0]["primitives"][0];
}

}  // namespace

TEST_CASE("a .glb that ends anywhere is one error, and never a crash") {
  GltfMaker maker;
  maker.square();
  const std::string whole = maker.glb();
  const TemporaryFolder folder;
  for (std::size_t length = 0; length < whole.size(); length += length < 64 ? 1 : 17) {
    CAPTURE(length);
    const text::Diagnostic d = failureOf(folder, "m.glb", whole.substr(0, length));
    CHECK((d.code == Code::unreadableModel || d.code == Code::notJson || d.code == Code::badModelValue));
  }
  std::string longer = whole;
  longer[8] = static_cast<char>(0xff);
  longer[9] = static_cast<char>(0xff);
  CHECK(failureOf(folder, "m.glb", longer).code == Code::unreadableModel);
  std::string chunk = whole;
  chunk[15] = 0x7f;
  CHECK(failureOf(folder, "m.glb", chunk).code == Code::unreadableModel);
}

TEST_CASE("every byte of a .glb's header and JSON may be another") {
  GltfMaker maker;
  maker.square();
  const std::string whole = maker.glb();
  const TemporaryFolder folder;
  for (std::size_t at = 0; at < std::min<std::size_t>(whole.size(), 900); at += 3)
    for (const char other : {'\0', '\xff', '9', '"', '-'}) {
      std::string bytes = whole;
      bytes[at] = other;
      text::Diagnostics diagnostics;
      const auto model = loadModel(folder.write("m.glb", bytes), diagnostics);
      CHECK(model.has_value() != diagnostics.hasErrors());
    }
}

TEST_CASE("indices that name nothing") {
  CHECK(failureWith([](GltfMaker& m) { firstPrimitive(m)["indices"] = m.shorts({0, 1, 4}); }).found == "4");
  for (const auto& [pointer, value] :
       std::initializer_list<std::pair<const char*, json>>{{"/scenes/0/nodes/0", 7},
                                                           {"/scene", 3},
                                                           {"/nodes/0/mesh", 9},
                                                           {"/nodes/0/mesh", -1},
                                                           {"/nodes/0/mesh", 0.5},
                                                           {"/nodes/0/mesh", "x"},
                                                           {"/nodes/0/skin", 0},
                                                           {"/meshes/0/primitives/0/material", 2},
                                                           {"/meshes/0/primitives/0/attributes/POSITION", 99},
                                                           {"/meshes/0/primitives/0/indices", 1e300},
                                                           {"/accessors/0/bufferView", 50},
                                                           {"/bufferViews/0/buffer", 1}}) {
    CAPTURE(pointer);
    const text::Diagnostic d =
        failureWith([&](GltfMaker& m) { m.document[json::json_pointer(pointer)] = value; });
    CHECK(d.code == Code::badModelValue);
    CHECK(d.pointer == pointer);
    CHECK(d.place.line == 1);
    CHECK(d.place.column > 1);
  }
}

TEST_CASE("values of another type than glTF has") {
  const auto failureAt = [](const char* pointer, const json& value) {
    return failureWith([&](GltfMaker& m) {
      m.document["materials"] = {{{"pbrMetallicRoughness", {{"metallicFactor", 1}}}}};
      m.document["extras"] = {{"children", "anything"}, {"extensions", 1}};
      m.document["nodes"][0]["extensions"] = {{"VENDOR_nodes", {{"children", "anything"}}}};
      m.document[json::json_pointer(pointer)] = value;
    });
  };
  for (const auto& [pointer, value, expected] :
       std::initializer_list<std::tuple<const char*, json, const char*>>{
           {"/materials/0/pbrMetallicRoughness", json::array({"not an object"}), "an object"},
           {"/materials/0/extensions", 1, "an object"},
           {"/materials/0/extensions/KHR_materials_sheen", "x", "an object"},
           {"/materials/0/doubleSided", 1, "a boolean"},
           {"/materials/0/alphaMode", 42, "a string"},
           {"/materials/0", 5, "an object"},
           {"/materials", {{"a", 1}}, "an array"},
           {"/nodes/0/children", 0, "an array"},
           {"/nodes/0/weights", 0.5, "an array"},
           {"/meshes/0/primitives/0/attributes", "POSITION", "an object"},
           {"/scenes", {{"a", 1}}, "an array"},
           {"/extensionsRequired", {{"VENDOR_a", 1}}, "an array"}}) {
    CAPTURE(pointer);
    const text::Diagnostic d = failureAt(pointer, value);
    CHECK(d.code == Code::badModelValue);
    CHECK(d.expected == expected);
    CHECK(d.pointer == pointer);
  }
}

TEST_CASE("accessors and views that reach beyond what they stand in") {
  for (const auto& [pointer, value] :
       std::initializer_list<std::pair<const char*, json>>{{"/accessors/0/count", 5},
                                                           {"/accessors/0/byteOffset", 4},
                                                           {"/accessors/0/byteOffset", 1e12},
                                                           {"/accessors/0/componentType", 7},
                                                           {"/accessors/0/type", "VEC9"},
                                                           {"/accessors/0/count", 0},
                                                           {"/bufferViews/0/byteLength", 1e9},
                                                           {"/bufferViews/0/byteOffset", 1e15},
                                                           {"/bufferViews/0/byteStride", 2},
                                                           {"/bufferViews/0/byteStride", 1e6}}) {
    CAPTURE(pointer);
    CHECK(failureWith([&](GltfMaker& m) { m.document[json::json_pointer(pointer)] = value; }).code ==
          Code::badModelValue);
  }
  CHECK(failureWith([](GltfMaker& m) {
          m.document["accessors"][0]["sparse"] = {{"count", 9}};
        }).code == Code::badModelValue);
  CHECK(failureWith([](GltfMaker& m) {
          const int index = m.shorts({4}), value = m.floats({0, 0, 0}, 3);
          m.document["accessors"][0]["sparse"] = {
              {"count", 1},
              {"indices",
               {{"bufferView", m.document["accessors"][index]["bufferView"]}, {"componentType", 5123}}},
              {"values", {{"bufferView", m.document["accessors"][value]["bufferView"]}}}};
        }).code == Code::badModelValue);
  // Attributes that do not fit each other.
  CHECK(failureWith([](GltfMaker& m) {
          firstPrimitive(m)["attributes"]["NORMAL"] = m.floats({0, 0, 1}, 3);
        }).code == Code::badModelValue);
  CHECK(failureWith([](GltfMaker& m) {
          firstPrimitive(m)["attributes"]["POSITION"] = firstPrimitive(m)["indices"];
        }).code == Code::badModelValue);
}

TEST_CASE("a thousand million vertices are claimed") {
  const text::Diagnostic beyond =
      failureWith([](GltfMaker& m) { m.document["accessors"][0]["count"] = 1000000000; });
  CHECK(beyond.code == Code::limitExceeded);
  // Without a buffer view they would be zeros, which take no file.
  const text::Diagnostic zeros = failureWith([](GltfMaker& m) {
    m.document["accessors"][0] = {{"count", 1000000000}, {"type", "VEC3"}, {"componentType", 5126}};
  });
  CHECK(zeros.code == Code::limitExceeded);
  CHECK(zeros.hint.find("--limit") != std::string::npos);
  // Few vertices, used again and again.
  const text::Diagnostic many = failureWith([](GltfMaker& m) {
    std::vector<std::uint16_t> indices(30000, 0);
    firstPrimitive(m)["indices"] = m.shorts(indices);
    for (int i = 0; i < 1000; ++i) m.document["meshes"][0]["primitives"].push_back(firstPrimitive(m));
  });
  CHECK(many.code == Code::limitExceeded);
}

TEST_CASE("numbers that are none, or too large") {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                  kInf = std::numeric_limits<float>::infinity();
  for (const float bad : {kNan, kInf, -kInf, 1e30f}) {
    CAPTURE(bad);
    const text::Diagnostic d = failureWith([&](GltfMaker& m) {
      firstPrimitive(m)["attributes"]["POSITION"] = m.floats({0, 0, 0, 1, bad, 0, 1, 1, 0, 0, 1, 0}, 3);
    });
    CHECK(d.code == Code::badModelValue);
    CHECK(d.message == "'POSITION' of vertex 1 is no number that can be used");
    CHECK(failureWith([&](GltfMaker& m) {
            firstPrimitive(m)["attributes"]["TEXCOORD_0"] = m.floats({0, 1, 1, bad, 1, 0, 0, 0}, 2);
          }).code == Code::badModelValue);
  }
  CHECK(failureWith([](GltfMaker& m) {
          m.document["nodes"][0]["translation"] = {1e300, 0, 0};
        }).code == Code::badModelValue);
  CHECK(failureWith([](GltfMaker& m) {
          m.document["nodes"][0]["rotation"] = {0, 0, 0, 0};
        }).code == Code::badModelValue);
  // Normals that are none are made anew.
  const TemporaryFolder folder;
  GltfMaker maker;
  maker.square();
  firstPrimitive(maker)["attributes"]["NORMAL"] = maker.floats({kNan, 0, 1, 0, 0, 0, kInf, 0, 1, 0, 0, 2}, 3);
  text::Diagnostics diagnostics;
  const auto model = loadModel(folder.write("m.gltf", maker.gltf()), diagnostics);
  REQUIRE_MESSAGE(model, diagnostics.text());
  for (const Vertex& v : model->vertices) CHECK(v.normal == glm::vec3{0, 0, 1});
}

TEST_CASE("nodes that are their own ancestors, or have two parents") {
  for (const json& nodes : {json{{{"children", {0}}}}, json{{{"children", {1}}}, {{"children", {0}}}},
                            json{{{"mesh", 0}, {"children", {1}}}, {{"children", {2}}}, {{"children", {1}}}},
                            json{{{"children", {2}}}, {{"children", {2}}}, json::object()}}) {
    const text::Diagnostic d = failureWith([&](GltfMaker& m) { m.document["nodes"] = nodes; });
    CHECK(d.code == Code::badModelValue);
  }
  // A row of a hundred thousand is none of these, and needs no stack.
  const TemporaryFolder folder;
  GltfMaker maker;
  maker.square();
  maker.document["nodes"] = json::array();
  for (int i = 0; i < 100000; ++i) maker.document["nodes"].push_back({{"children", {i + 1}}});
  maker.document["nodes"].push_back({{"mesh", 0}});
  text::Diagnostics diagnostics;
  CHECK_MESSAGE(loadModel(folder.write("m.gltf", maker.gltf()), diagnostics), diagnostics.text());
}

TEST_CASE("skins and animations that do not fit") {
  const auto skinned = [](GltfMaker& m, std::uint16_t joint, float weight) {
    std::vector<std::uint16_t> joints(16, joint);
    std::vector<float> weights(16, weight);
    firstPrimitive(m)["attributes"]["JOINTS_0"] = m.shorts(joints, 4);
    firstPrimitive(m)["attributes"]["WEIGHTS_0"] = m.floats(weights, 4);
    m.document["skins"] = {{{"joints", {0}}}};
    m.document["nodes"][0]["skin"] = 0;
  };
  CHECK(failureWith([&](GltfMaker& m) { skinned(m, 1, 0.25f); }).found == "joint 1");
  CHECK(failureWith([&](GltfMaker& m) { skinned(m, 0, std::numeric_limits<float>::quiet_NaN()); }).code ==
        Code::badModelValue);
  CHECK(failureWith([&](GltfMaker& m) {
          skinned(m, 0, 0.25f);
          m.document["skins"][0]["joints"] = json::array();
        }).code == Code::badModelValue);
  CHECK(failureWith([&](GltfMaker& m) {
          skinned(m, 0, 0.25f);
          m.document["skins"][0]["joints"] = {0, 0};
          m.document["skins"][0]["inverseBindMatrices"] = m.floats(std::vector<float>(16, 1), 16);
        }).code == Code::badModelValue);

  const auto animated = [](GltfMaker& m, const std::vector<float>& times, std::size_t values) {
    m.document["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}},
         {"samplers",
          {{{"input", m.floats(times, 1)}, {"output", m.floats(std::vector<float>(values * 3, 1), 3)}}}}}};
  };
  CHECK(failureWith([&](GltfMaker& m) { animated(m, {0, 1}, 3); }).code == Code::badModelValue);
  CHECK(failureWith([&](GltfMaker& m) { animated(m, {1, 0}, 2); }).code == Code::badModelValue);
  CHECK(failureWith([&](GltfMaker& m) {
          animated(m, {0, std::numeric_limits<float>::quiet_NaN()}, 2);
        }).code == Code::badModelValue);
  for (const auto& [pointer, value] :
       std::initializer_list<std::pair<const char*, json>>{{"/animations/0/channels/0/sampler", 1},
                                                           {"/animations/0/channels/0/target/node", 1},
                                                           {"/animations/0/samplers/0/input", 77}})
    CHECK(failureWith([&](GltfMaker& m) {
            animated(m, {0, 1}, 2);
            m.document[json::json_pointer(pointer)] = value;
          }).code == Code::badModelValue);
}

TEST_CASE("a texture that is missing or damaged is a warning, and a checkerboard") {
  const TemporaryFolder folder;
  folder.write("bad.png", "\x89PNG\r\n\x1a\n and no more");
  GltfMaker maker;
  maker.square();
  maker.document["images"] = {{{"uri", "gone.png"}}, {{"uri", "bad.png"}}};
  maker.document["textures"] = {{{"source", 0}}, {{"source", 1}}, json::object()};
  maker.document["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                                  {"normalTexture", {{"index", 1}}},
                                  {"occlusionTexture", {{"index", 2}}}}};
  text::Diagnostics diagnostics;
  std::vector<std::string> files;
  const auto model = loadModel(folder.write("m.gltf", maker.gltf()), diagnostics, {}, &files);
  REQUIRE_MESSAGE(model, diagnostics.text());
  CHECK(diagnostics.size() == 3);
  for (const text::Diagnostic& d : diagnostics.items()) {
    CHECK(d.code == Code::missingModelTexture);
    CHECK(d.severity == text::Severity::warning);
    CHECK_FALSE(d.hint.empty());
  }
  CHECK(files == std::vector{folder.at("m.gltf"), folder.at("gone.png"), folder.at("bad.png")});
  REQUIRE(model->textures.size() == 1);
  CHECK(model->textures[0].image->texels[0] == 255);
  CHECK(model->textures[0].image->texels[1] == 0);
  CHECK(model->materials[0].normalMap == kNoRow);
  CHECK(model->materials[0].occlusionMap == kNoRow);
}

// An accessor without a buffer view is zeros, of as many bytes as it says.
TEST_CASE("positions that no corner uses count, in each mesh that has them") {
  const auto codeOf = [](std::uint32_t positions, std::size_t meshes) {
    return failureWith([&](GltfMaker& m) {
             m.document["accessors"].push_back(
                 {{"componentType", 5126}, {"count", positions}, {"type", "VEC3"}});
             json primitive = {{"attributes", {{"POSITION", m.document["accessors"].size() - 1}}},
                               {"indices", m.shorts({0, 1, 2})}};
             m.document["meshes"][0]["primitives"] = json::array();
             for (std::size_t i = 0; i < meshes; ++i)
               m.document["meshes"][0]["primitives"].push_back(primitive);
           })
        .code;
  };
  CHECK(codeOf(25'000'000, 1) == Code::limitExceeded);
  CHECK(codeOf(100'000, 85) == Code::limitExceeded);
  CHECK(codeOf(100'000, 1) == Code::unreadableModel);  // nothing to draw
}

TEST_CASE("a picture of gigabytes is refused by its header") {
  const TemporaryFolder folder;
  std::string png("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x40\0\0\0\x20\0\x08\x06\0\0\0", 29);  // 16384 x 8192
  png += std::string("\0\0\0\0\0\0\0\0IDAT\0\0\0\0", 16);
  folder.write("huge.png", png);
  GltfMaker maker;
  maker.square();
  maker.document["images"] = {{{"uri", "huge.png"}}};
  maker.document["textures"] = {{{"source", 0}}};
  maker.document["materials"] = {{{"emissiveTexture", {{"index", 0}}}}};
  text::Diagnostics diagnostics;
  CHECK_FALSE(loadModel(folder.write("m.gltf", maker.gltf()), diagnostics));
  CHECK_MESSAGE(diagnostics.errorCount() == 1, diagnostics.text());
  CHECK(diagnostics.contains(Code::limitExceeded));
  CHECK(diagnostics.text().find("--limit") != std::string::npos);
}

TEST_CASE("OBJ files that lie") {
  const TemporaryFolder folder;
  const auto codeOf = [&](const std::string& text) { return failureOf(folder, "m.obj", text).code; };
  CHECK(codeOf("") == Code::unreadableModel);
  CHECK(codeOf("hello\n") == Code::unreadableModel);
  CHECK(codeOf("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n") == Code::unreadableModel);
  CHECK(codeOf("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n") == Code::unreadableModel);
  CHECK(codeOf("v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n") == Code::badModelValue);
  CHECK(codeOf("v 0 0 0\nv inf 0 0\nv 0 1 0\nf 1 2 3\n") == Code::badModelValue);
  CHECK(codeOf("v 0 0 0 0 0 0\nv 1 0 0 0 nan 0\nv 0 1 0 0 0 0\nf 1 2 3\n") == Code::badModelValue);
  CHECK(codeOf("v 0 0 0\nv 1e300 0 0\nv 0 1 0\nf 1 2 3\n") == Code::badModelValue);
  text::Diagnostics wires;
  CHECK_FALSE(loadModel(folder.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3\n"), wires));
  REQUIRE_MESSAGE(wires.size() == 2, wires.text());
  CHECK(wires.contains(Code::modelPartLeftOut));  // the lines
  CHECK(wires.contains(Code::unreadableModel));
  CHECK(wires.text().find("nothing to draw") != std::string::npos);
  std::string corners = "v 0 0 0\nf";
  for (int i = 0; i < 5000; ++i) corners += " 1";
  CHECK(codeOf(corners + "\n") == Code::badModelValue);
  for (const char* odd :
       {"v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/9 2/9 3/9\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//9 2//9 3//9\n", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/ 2/ 3/\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf ///// \\\n 1 2 3\n", "f 1 2 3\n", "v\nv\nv\nf 1 2 3\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999999999999\n",
        "o\ng\nusemtl\nmtllib\ns\nv 0 0 0\nf 1 1 1\n"}) {
    text::Diagnostics diagnostics;
    const auto model = loadModel(folder.write("m.obj", odd), diagnostics);
    CHECK_MESSAGE(model.has_value() != diagnostics.hasErrors(), diagnostics.text());
  }
}

TEST_CASE("an OBJ of a hundred megabytes, or of one endless line, is refused") {
  const TemporaryFolder folder;
  std::string line = "v 0 0 0\nf";
  line.reserve(100 << 20);
  while (line.size() < (std::size_t{100} << 20))
    line += " 1/1/1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1";
  const text::Diagnostic large = failureOf(folder, "m.obj", line);
  CHECK(large.code == Code::limitExceeded);
  CHECK(large.hint.find("--limit") != std::string::npos);
  line.resize(std::size_t{20} << 20);
  const text::Diagnostic endless = failureOf(folder, "m.obj", line);
  CHECK(endless.code == Code::badModelValue);
  CHECK(endless.place.line == 2);
}
