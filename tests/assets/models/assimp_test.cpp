// OBJ and FBX. FBX files are written by Assimp's exporter, from models that the glTF reader is tested with.
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>

#include "engine/assets/images/image.h"
#include "engine/assets/models/model_file.h"
#include "engine/text/files/file.h"
#include "tests/assets/models/fbx_records.h"
#include "tests/assets/models/loading.h"

using namespace weft;
using namespace weft::assets;
using text::Code;
using weft::test::kModels;
using weft::test::loadGood;
using weft::test::worldOf;

namespace {

void writeColor(const std::string& path, std::array<std::uint8_t, 3> color) {
  text::Diagnostics diagnostics;
  REQUIRE(savePng8(path, 1, 1, 3, color, diagnostics));
}

// Fox.glb as FBX, in the binary or the text form.
void writeFox(const std::string& path, const char* format) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(kModels + "Fox.glb", 0);
  REQUIRE(scene);
  Assimp::Exporter exporter;
  REQUIRE(exporter.Export(scene, format, path) == aiReturn_SUCCESS);
  if (std::string(format) != "fbx") return;
  text::Diagnostics diagnostics;
  const std::string bytes = test::repairFbx(text::readFile(path, diagnostics).value());
  REQUIRE(text::writeFile(path, bytes, diagnostics));
}

std::string readBytes(const std::string& path) {
  text::Diagnostics diagnostics;
  return text::readFile(path, diagnostics).value();
}

text::Diagnostics failuresOf(const TemporaryFolder& folder, const std::string& name,
                             const std::string& bytes) {
  text::Diagnostics diagnostics;
  const auto model = loadModel(folder.write(name, bytes), diagnostics);
  CHECK(model.has_value() != diagnostics.hasErrors());
  CHECK(diagnostics.errorCount() <= 1);
  return diagnostics;
}

}  // namespace

TEST_CASE("OBJ: Blinn-Phong as it is, and its conversion") {
  const TemporaryFolder folder;
  folder.write("m.mtl",
               "newmtl plastic\nKd 0.2 0.4 0.6\nKs 0.5 0.5 0.5\nNs 30\nKe 1 0 0\n"
               "newmtl glass\nKd 1 1 1\nd 0.25\n"
               "newmtl copper\nKd 0 0 0\nKs 0.9 0.8 0.7\nNs 200\n"
               "newmtl lacquer\nKd 0 0 0\nKs 0.8 0.8 0.79\nNs 200\n");
  const Model model =
      loadGood(folder.write("m.obj",
                            "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl plastic\nf 1 2 "
                            "3\nusemtl glass\nf 1 2 3\nusemtl copper\nf 1 2 3\nusemtl lacquer\nf 1 2 3\n"));
  REQUIRE(model.instances.size() == 4);
  const auto materialOf = [&](const char* name) -> const Material& {
    return *std::ranges::find(model.materials, name, &Material::name);
  };
  const Material &plastic = materialOf("plastic"), &glass = materialOf("glass"),
                 &copper = materialOf("copper"), &lacquer = materialOf("lacquer");
  CHECK(plastic.blinnPhong);
  CHECK(plastic.albedo == glm::vec3{0.2f, 0.4f, 0.6f});
  CHECK(plastic.specular == glm::vec3{0.5f, 0.5f, 0.5f});
  CHECK(plastic.shininess == 30);
  CHECK(plastic.emissive == glm::vec3{1, 0, 0});
  CHECK(plastic.metallic == 0);
  CHECK(plastic.roughness == doctest::Approx(0.5));  // (2 / 32) to the fourth root
  CHECK(glass.blend);
  CHECK(glass.alpha == 0.25f);
  CHECK(copper.metallic == 1);
  CHECK(copper.albedo == glm::vec3{0.9f, 0.8f, 0.7f});
  CHECK(lacquer.metallic == 0);  // its highlight is as white as any dielectric's
  CHECK(lacquer.albedo == glm::vec3(0));
}

TEST_CASE("OBJ: polygons, equal vertices, uv from the top, maps of other machines' paths") {
  const TemporaryFolder folder;
  writeColor(folder.at("red.png"), {200, 10, 20});
  writeColor(folder.at("normal.png"), {128, 128, 255});
  writeColor(folder.at("height.png"), {90, 90, 90});
  folder.write("m.mtl",
               "newmtl a\nmap_Kd C:\\art\\red.png\nmap_Bump /home/x/normal.png\nnewmtl b\nmap_Kd "
               "gone.png\nmap_Bump height.png\n");
  text::Diagnostics diagnostics;
  const auto model = loadModel(
      folder.write(
          "m.obj",
          "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
          "usemtl a\nf 1/1/1 2/2/1 3/3/1 4/4/1\nusemtl b\nf 1/1/1 2/2/1 3/3/1 4/4/1\n"),
      diagnostics);
  REQUIRE_MESSAGE(model, diagnostics.text());
  REQUIRE_MESSAGE(diagnostics.size() == 2, diagnostics.text());
  CHECK(diagnostics.contains(Code::missingModelTexture));  // gone.png
  CHECK(diagnostics.contains(Code::modelPartLeftOut));     // heights
  REQUIRE(model->meshes.size() == 2);
  CHECK(model->meshes[0].vertexCount == 4);
  CHECK(model->meshes[0].indexCount == 6);
  for (std::uint32_t v = 0; v < 4; ++v) {
    const Vertex& vertex = model->vertices[v];
    CHECK(vertex.uv == glm::vec2{vertex.position[0], 1 - vertex.position[1]});
    CHECK(vertex.tangent == glm::vec4{1, 0, 0, 1});
  }
  const auto named = [&](const char* name) -> const Material& {
    return *std::ranges::find(model->materials, name, &Material::name);
  };
  CHECK(model->textures[named("a").albedoMap].image->texels == std::vector<std::uint8_t>{200, 10, 20, 255});
  CHECK(model->textures[named("a").albedoMap].srgb);
  REQUIRE(named("a").normalMap != kNoRow);
  CHECK_FALSE(model->textures[named("a").normalMap].srgb);
  CHECK(named("b").normalMap == kNoRow);
}

TEST_CASE("OBJ: a library that is missing is a warning") {
  const TemporaryFolder folder;
  text::Diagnostics diagnostics;
  CHECK(loadModel(folder.write("m.obj", "mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n"),
                  diagnostics));
  REQUIRE_MESSAGE(diagnostics.size() == 1, diagnostics.text());
  CHECK(diagnostics.items()[0].severity == text::Severity::warning);
}

TEST_CASE("OBJ: the vertex colors are sRGB, and equal places with other colors stay apart") {
  const TemporaryFolder folder;
  // 0.735357 is half of the light: IEC 61966-2-1.
  const Model model = loadGood(
      folder.write("m.obj",
                   "v 0 0 0 1 0 0\nv 1 0 0 0.735357 0.04045 2\nv 1 1 0 0.5 0.5 0.5 # gray\n"
                   "v 0 1 0 0 0 -1\nv 0 0 0 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\nf 5//1 2//1 3//1\n"));
  REQUIRE(model.vertices.size() == 5);
  REQUIRE(model.colors.size() == 5);
  const std::vector<std::pair<glm::vec3, glm::vec3>> wanted = {
      {{0, 0, 0}, {1, 0, 0}},
      {{1, 0, 0}, {0.5f, 0.04045f / 12.92f, 1}},
      {{1, 1, 0}, {0.2140411f, 0.2140411f, 0.2140411f}},
      {{0, 1, 0}, {0, 0, 0}},
      {{0, 0, 0}, {0, 1, 0}}};
  for (const auto& [position, color] : wanted) {
    CAPTURE(color[0]);
    const auto isThis = [&](std::size_t v) {
      bool same = model.vertices[v].position == position && model.colors[v][3] == 1;
      for (std::size_t c = 0; c < 3; ++c) same = same && std::abs(model.colors[v][c] - color[c]) < 1e-6;
      return same;
    };
    std::size_t found = 0;
    for (std::size_t v = 0; v < 5; ++v) found += isThis(v) ? 1 : 0;
    CHECK(found == 1);
  }
  // Faces without colors have none.
  CHECK(loadGood(folder.write("plain.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")).colors.empty());
}

TEST_CASE("OBJ: where some vertices have no color, all are left out, with a warning") {
  const TemporaryFolder folder;
  text::Diagnostics diagnostics;
  const auto model = loadModel(
      folder.write("m.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\no second\nf 1 2 4\n"),
      diagnostics);
  REQUIRE_MESSAGE(model, diagnostics.text());
  CHECK(model->colors.empty());
  REQUIRE_MESSAGE(diagnostics.size() == 1, diagnostics.text());
  const text::Diagnostic& d = diagnostics.items()[0];
  CHECK(d.code == Code::modelPartLeftOut);
  CHECK(d.severity == text::Severity::warning);
  CHECK(d.message.find("vertex colors") != std::string::npos);
  CHECK(!d.hint.empty());
}

TEST_CASE("FBX: the vertex colors are sRGB, with alpha as it is") {
  const TemporaryFolder folder;
  test::GltfMaker maker;
  maker.square();
  const std::vector<float> colors = {1, 0, 0, 1, 0, 0.735357f, 0, 0.5f, 0, 0, 0.5f, 0.25f, 0.5f, 0.25f, 1, 0};
  maker.document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = maker.floats(colors, 4);
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(folder.write("m.gltf", maker.gltf()), 0);
  REQUIRE(scene);
  Assimp::Exporter exporter;
  REQUIRE(exporter.Export(scene, "fbxa", folder.at("m.fbx")) == aiReturn_SUCCESS);
  const Model model = loadGood(folder.at("m.fbx"));
  const Model linear = loadGood(folder.at("m.gltf"));
  REQUIRE(model.colors.size() == model.vertices.size());
  REQUIRE(linear.colors.size() == 4);
  std::size_t found = 0;
  for (std::size_t v = 0; v < model.vertices.size(); ++v)
    for (std::size_t w = 0; w < 4; ++w) {
      if (model.vertices[v].position != linear.vertices[w].position) continue;
      ++found;
      for (std::size_t c = 0; c < 3; ++c) {
        const double stored = linear.colors[w][c];
        CHECK(model.colors[v][c] ==
              doctest::Approx(stored <= 0.04045 ? stored / 12.92 : std::pow((stored + 0.055) / 1.055, 2.4))
                  .epsilon(1e-5));
      }
      CHECK(model.colors[v][3] == linear.colors[w][3]);
    }
  CHECK(found == model.vertices.size());
}

TEST_CASE("FBX, binary and text: the fox, its nodes, weights and animations") {
  const TemporaryFolder folder;
  const Model wanted = loadGood(kModels + "Fox.glb");
  for (const char* format : {"fbx", "fbxa"}) {
    CAPTURE(format);
    const std::string path = folder.at("fox.fbx");
    writeFox(path, format);
    text::Diagnostics diagnostics;
    const auto model = loadModel(path, diagnostics);
    REQUIRE_MESSAGE(model, diagnostics.text());
    REQUIRE(model->instances.size() == 1);
    CHECK(model->meshes[0].indexCount == wanted.meshes[0].indexCount);
    CHECK(model->meshes[0].skinned);
    REQUIRE(model->animations.size() == 3);
    CHECK(model->animations[1]->name == "Walk");
    CHECK(model->animations[1]->tracks.size() >= 21);
    CHECK(model->skins[0].joints.size() == 24);
    // Every corner, skinned in the pose of the file: the same places in the same order.
    const auto place = [](const Model& m, std::size_t corner) {
      const std::uint32_t v = m.meshes[0].firstVertex + m.indices[m.meshes[0].firstIndex + corner];
      const ModelSkin& skin = m.skins[0];
      std::array<double, 3> sum{};
      for (std::size_t i = 0; i < 4; ++i) {
        if (!(m.skin[v].weights[i] > 0)) continue;
        const std::size_t joint = m.skin[v].joints[i];
        const glm::mat4 to = worldOf(m, skin.joints[joint]) * skin.inverseBind[joint];
        const glm::vec3& p = m.vertices[v].position;
        const glm::vec4 moved = to * glm::vec4(p, 1);
        for (int r = 0; r < 3; ++r)
          sum[static_cast<std::size_t>(r)] += double(m.skin[v].weights[i]) * moved[r];
      }
      return sum;
    };
    double worst = 0;
    for (std::size_t corner = 0; corner < wanted.meshes[0].indexCount; ++corner) {
      const auto a = place(wanted, corner), b = place(*model, corner);
      for (std::size_t c = 0; c < 3; ++c) worst = std::max(worst, std::abs(a[c] - b[c]));
    }
    CHECK(worst < 0.05);  // of 150: the file's text has few digits
  }
}

TEST_CASE("FBX: lights, cameras and maps that are not read are left out, each with a warning") {
  const TemporaryFolder folder;
  writeFox(folder.at("fox.fbx"), "fbxa");
  std::string text = readBytes(folder.at("fox.fbx"));
  const auto insertAfter = [&](const std::string& line, const std::string& more) {
    const std::size_t at = text.find(line);
    REQUIRE(at != std::string::npos);
    text.insert(text.find('\n', at) + 1, more);
  };
  insertAfter("Objects:  {",
              "\tNodeAttribute: 9001, \"NodeAttribute::bulb\", \"Light\" {\n\t\tTypeFlags: \"Light\"\n\t}\n"
              "\tModel: 9002, \"Model::bulb\", \"Light\" {\n\t\tVersion: 232\n\t}\n"
              "\tNodeAttribute: 9003, \"NodeAttribute::eye\", \"Camera\" {\n\t\tTypeFlags: \"Camera\"\n\t}\n"
              "\tModel: 9004, \"Model::eye\", \"Camera\" {\n\t\tVersion: 232\n\t}\n"
              "\tTexture: 9005, \"Texture::holes\", \"\" {\n\t\tRelativeFilename: \"holes.png\"\n\t}\n");
  const std::size_t named = text.find("\tMaterial: ");
  REQUIRE(named != std::string::npos);
  const std::string material = text.substr(named + 11, text.find(',', named) - named - 11);
  insertAfter("Connections:  {",
              "\tC: \"OO\",9001,9002\n\tC: \"OO\",9002,0\n\tC: \"OO\",9003,9004\n\tC: \"OO\",9004,0\n"
              "\tC: \"OP\",9005," +
                  material + ", \"TransparentColor\"\n");
  text::Diagnostics diagnostics;
  const auto model = loadModel(folder.write("lit.fbx", text), diagnostics);
  REQUIRE_MESSAGE(model, diagnostics.text());
  CHECK(model->lights.empty());
  CHECK(std::ranges::count(diagnostics.items(), "give the scene file a 'sun' and 'lamps'",
                           &text::Diagnostic::hint) == 1);
  REQUIRE_MESSAGE(diagnostics.size() == 3, diagnostics.text());
  for (const char* what : {"light", "camera", "map Opacity"})
    CHECK_MESSAGE(std::ranges::any_of(diagnostics.items(),
                                      [&](const text::Diagnostic& d) {
                                        return d.code == Code::modelPartLeftOut &&
                                               d.message.find(what) != std::string::npos;
                                      }),
                  diagnostics.text());
}

TEST_CASE("FBX: shape keys are left out with a warning, and the mesh is drawn as it rests") {
  const TemporaryFolder folder;
  const Model model = loadGood(folder.write("m.fbx", R"(; FBX 7.4.0 project file
FBXHeaderExtension:  {
	FBXVersion: 7400
}
Objects:  {
	Geometry: 1, "Geometry::", "Mesh" {
		Vertices: *12 {
			a: 0,0,0,1,0,0,0,1,0,-1,0,0
		}
		PolygonVertexIndex: *4 {
			a: 0,1,2,-4
		}
	}
	Geometry: 2, "Geometry::smile", "Shape" {
		Version: 100
		Indexes: *1 {
			a: 2
		}
		Vertices: *3 {
			a: 0,4,0
		}
		Normals: *3 {
			a: 0,0,0
		}
	}
	Deformer: 3, "Deformer::face", "BlendShape" {
		Version: 100
	}
	Deformer: 4, "SubDeformer::smile", "BlendShapeChannel" {
		Version: 100
		DeformPercent: 50
		FullWeights: *1 {
			a: 100
		}
	}
	Model: 5, "Model::head", "Mesh" {
		Version: 232
	}
}
Connections:  {
	C: "OO",5,0
	C: "OO",1,5
	C: "OO",3,1
	C: "OO",4,3
	C: "OO",2,4
}
)"),
                               1);
  REQUIRE(model.vertices.size() == 6);
  for (const Vertex& vertex : model.vertices) CHECK(vertex.position.y <= 1);
  text::Diagnostics diagnostics;
  REQUIRE(loadModel(folder.at("m.fbx"), diagnostics));
  CHECK(diagnostics.items()[0].message.find("shape key") != std::string::npos);
}

TEST_CASE("FBX files that are damaged anywhere") {
  const TemporaryFolder folder;
  writeFox(folder.at("fox.fbx"), "fbx");
  const std::string whole = readBytes(folder.at("fox.fbx"));
  for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 60)
    failuresOf(folder, "m.fbx", whole.substr(0, length));
  // A fixed sequence of damages: Knuth's generator.
  std::uint64_t state = 1;
  for (int round = 0; round < 60; ++round) {
    std::string bytes = whole;
    for (int k = 0; k < 8; ++k) {
      state = state * 6364136223846793005ull + 1442695040888963407ull;
      bytes[(state >> 33) % bytes.size()] = static_cast<char>(state >> 24);
    }
    failuresOf(folder, "m.fbx", bytes);
  }
  CHECK(failuresOf(folder, "m.fbx", "").hasErrors());
  CHECK(failuresOf(folder, "m.fbx", "; FBX 7.4.0 project file\n" + std::string(100, '{')).hasErrors());
}

TEST_CASE("FBX: nodes that are their own ancestors, arrays that unpack to more than memory") {
  const TemporaryFolder folder;
  writeFox(folder.at("fox.fbx"), "fbxa");
  std::string text = readBytes(folder.at("fox.fbx"));
  // The first connection of two nodes, and then the same the other way round.
  const auto isNode = [&](const std::string& id) { return text.find("Model: " + id + ",") != text.npos; };
  std::string child, parent;
  std::size_t at = 0, end = 0;
  do {
    at = text.find("C: \"OO\", ", at) + 9;
    REQUIRE(at != std::string::npos + 9);
    end = text.find('\n', at);
    child = text.substr(at, text.find(',', at) - at);
    parent = text.substr(at + child.size() + 2, end - at - child.size() - 2);
  } while (!isNode(child) || !isNode(parent));
  text.insert(end + 1, "\tC: \"OO\", " + parent + ", " + child + "\n");
  const text::Diagnostics circle = failuresOf(folder, "m.fbx", text);
  REQUIRE(circle.errorCount() == 1);
  CHECK(circle.items()[0].code == Code::unreadableModel);

  // Packed positions that claim to be 501 million numbers.
  writeFox(folder.at("fox.fbx"), "fbx");
  std::string bytes = readBytes(folder.at("fox.fbx"));
  const std::size_t array = bytes.find("Verticesd");
  REQUIRE(array != std::string::npos);
  const std::uint32_t claimed[] = {501'000'000, 1};
  std::memcpy(bytes.data() + array + 9, claimed, sizeof claimed);
  const text::Diagnostics bomb = failuresOf(folder, "m.fbx", bytes);
  REQUIRE(bomb.errorCount() == 1);
  CHECK(bomb.items()[0].code == Code::unreadableModel);
  CHECK(bomb.items()[0].hint.find("--limit") != std::string::npos);
}
