// OBJ files as people have them. Right values come from the formats' descriptions, areas from the polygons themselves.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/assets/images/image.h"
#include "tests/assets/models/loading.h"

using namespace weft;
using namespace weft::assets;
using text::Code;
using weft::test::loadGood;

namespace {

const std::string kSquare =
    "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3 4/4\n";

const Material& named(const Model& model, const char* name) {
  return *std::ranges::find(model.materials, name, &Material::name);
}

double areaOf(const Model& model) {
  double area = 0;
  for (std::size_t i = 0; i + 2 < model.indices.size(); i += 3) {
    const auto at = [&](std::size_t c) { return model.vertices[model.indices[i + c]].position; };
    area += glm::length(glm::cross(at(1) - at(0), at(2) - at(0))) / 2;
  }
  return area;
}

std::vector<std::string> warningsOf(const TemporaryFolder& folder, const std::string& obj) {
  text::Diagnostics diagnostics;
  const auto model = loadModel(folder.write("m.obj", obj), diagnostics);
  CHECK_MESSAGE(model, diagnostics.text());
  std::vector<std::string> messages;
  for (const text::Diagnostic& d : diagnostics.items()) {
    CHECK(d.code == Code::modelPartLeftOut);
    messages.push_back(d.message);
  }
  return messages;
}

}  // namespace

TEST_CASE("OBJ: a byte order mark, in the model and in its library") {
  const TemporaryFolder folder;
  folder.write("m.mtl", "\xEF\xBB\xBFnewmtl m\nKd 0.8 0.1 0.1\n");
  const Model model = loadGood(folder.write("m.obj", "\xEF\xBB\xBFmtllib m.mtl\n" + kSquare));
  CHECK(named(model, "m").albedo == glm::vec3(0.8f, 0.1f, 0.1f));
  CHECK(model.materials[model.instances[0].material].name == "m");
}

TEST_CASE("OBJ: lines that go on, signs, negative indices, names of libraries with spaces") {
  const TemporaryFolder folder;
  folder.write("my materials.mtl", "newmtl m\nKd 1 0 0\n");
  const Model model = loadGood(folder.write(
      "m.obj",
      "mtllib my materials.mtl\r\nv +0 0 0\r\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl m\nf -4 -3 \\\r\n-2 -1\n"));
  CHECK(areaOf(model) == doctest::Approx(1));
  CHECK(named(model, "m").albedo == glm::vec3(1, 0, 0));
}

TEST_CASE("OBJ: a concave polygon covers its own area") {
  const TemporaryFolder folder;
  // An L of 3 squares, a star of 5 points, and a square with a corner in the middle of a side.
  CHECK(areaOf(loadGood(folder.write(
            "l.obj", "v 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nv 2 0 0\nv 2 1 0\nf 1 2 3 4 5 6\n"))) ==
        doctest::Approx(3));
  std::string star, face = "f";
  double area = 0;
  for (int i = 0; i < 10; ++i) {
    const double radius = i % 2 == 0 ? 1 : 0.3, next = i % 2 == 0 ? 0.3 : 1;
    star += "v " + std::to_string(radius * std::cos(i * M_PI / 5)) + " 0 " +
            std::to_string(radius * std::sin(i * M_PI / 5)) + "\n";
    face += " " + std::to_string(i + 1);
    area += radius * next * std::sin(M_PI / 5) / 2;
  }
  CHECK(areaOf(loadGood(folder.write("s.obj", star + face + "\n"))) == doctest::Approx(area).epsilon(1e-4));
  CHECK(areaOf(loadGood(folder.write(
            "t.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4 5\n"))) == doctest::Approx(4));
}

TEST_CASE("OBJ: a smoothing group shares the normals that the file lacks") {
  const TemporaryFolder folder;
  // Two sides of a cube that share an edge: upwards along z and x.
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 -1\nv 1 1 -1\nvn 0 0 2\nvn 0 1 0\n";
  const auto mixed = [&](const std::string& faces) {
    const Model model = loadGood(folder.write("m.obj", corners + faces));
    std::size_t found = 0;
    for (const Vertex& v : model.vertices) {
      CHECK(glm::length(v.normal) == doctest::Approx(1));
      const float along = glm::dot(v.normal, {std::sqrt(0.5f), 0, std::sqrt(0.5f)});
      if (along > 0.9999f) {
        CHECK(v.position.x == 1);
        CHECK(v.position.z == 0);
        ++found;
      }
    }
    return found;
  };
  CHECK(mixed("s 1\nf 1 2 3 4\nf 2 5 6 3\n") == 2);
  CHECK(mixed("s 1\no a\nf 1 2 3 4\no b\nf 2 5 6 3\n") == 4);  // also where the mesh ends
  CHECK(mixed("s 1\nf 1 2 3 4\ns 2\nf 2 5 6 3\n") == 0);
  CHECK(mixed("f 1 2 3 4\nf 2 5 6 3\n") == 0);
  CHECK(mixed("s 1\ns off\nf 1 2 3 4\nf 2 5 6 3\n") == 0);
  CHECK(mixed("s 1\nf 1//1 2//1 3//1 4//1\nf 2 5 6 3\n") == 0);  // its own stay
  // Negative rows count the normals of the file.
  const Model model =
      loadGood(folder.write("m.obj", corners + "s 1\nf 2 5 6 3\nf 1//-2 2//-2 3//-2 4//-2\n"));
  CHECK(std::ranges::count(model.vertices, glm::vec3(0, 0, 1), &Vertex::normal) == 4);
}

TEST_CASE("OBJ: what is not drawn is one warning of each kind, and the rest is drawn") {
  const TemporaryFolder folder;
  folder.write("m.mtl", "newmtl m\nKd 1 1 1\nPs 0\nillum 2\nNi 1.5\n");
  const std::string square = "mtllib m.mtl\n" + kSquare;
  CHECK(warningsOf(folder, square).empty());
  CHECK(warningsOf(folder, square + "l 1 2\nl 2 3\np 1\n").size() == 2);
  // Normals and texture coordinates of which the file has none, and one that is far away.
  const std::string corner = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  CHECK(warningsOf(folder, corner + "f 1/4/7 2/5/8 3/6/9\n").empty());
  CHECK(warningsOf(folder, corner + "vt 3443870976 0 0\nf 1/1/1 2/1/2 3/1/3\n").empty());
  const std::string line = "v 0 0 0\nv 3 3 3\nv 5 5 5\n", flat = "o a\nf 1 1 2\nf -1 -2 -3\no b\nf 4 4 4\n";
  CHECK(warningsOf(folder, square + line + flat).size() == 1);
  CHECK(warningsOf(folder, square + "f 1 2 9\nf 1 2 -7\nf 1/9 2/1 3/1\n").size() == 1);
  CHECK(warningsOf(folder, square + "usemtl other\nf 1 2 3\nusemtl other\nf 1 3 4\n").size() == 1);
  std::string many = square, maps;
  for (int i = 0; i < 1200; ++i) many += fmt::format("usemtl m{}\nf 1 2 3\n", i);
  CHECK(warningsOf(folder, many).size() == 1001);
  for (int i = 0; i < 4100; ++i) maps += fmt::format("newmtl m{}\nmap_Kd {}.png\n", i, i);
  folder.write("m.mtl", maps);
  text::Diagnostics files;
  CHECK_FALSE(loadModel(folder.write("m.obj", square), files));
  CHECK(files.errorCount() == 1);
  CHECK(files.contains(text::Code::limitExceeded));
  folder.write("m.mtl", "newmtl m\nKd 1 1 1\nmap_Ks x.png\nPs 0.5\nPs 0.5\n");
  CHECK(warningsOf(folder, square).size() == 2);
  // Maps of faces without texture coordinates, once for a material.
  text::Diagnostics diagnostics;
  REQUIRE(savePng8(folder.at("x.png"), 1, 1, 3, std::array<std::uint8_t, 3>{1, 2, 3}, diagnostics));
  folder.write("m.mtl", "newmtl m\nmap_Kd x.png\nnewmtl n\nKd 1 1 1\n");
  CHECK(warningsOf(folder, square).empty());
  CHECK(warningsOf(folder, square + "f 1 2 3\no b\nf 1 3 4\nusemtl n\nf 1 2 3\n").size() == 1);
  folder.write("m.mtl", "newmtl m\nKd 1 1 1\nmap_Ks x.png\nPs 0.5\nPs 0.5\n");
  CHECK(areaOf(loadGood(folder.write("m.obj", square + "f 1 2 9\n"), 3)) == doctest::Approx(4));
}

TEST_CASE("MTL: holes, roughness and metal from maps, clamping, scale and offset") {
  const TemporaryFolder folder;
  text::Diagnostics diagnostics;
  const std::vector<std::uint8_t> holes = {255, 255, 255, 0, 0, 0}, soft = {100, 100, 100, 200, 200, 200},
                                  gray = {51, 51, 51, 204, 204, 204};
  REQUIRE(savePng8(folder.at("holes.png"), 2, 1, 3, holes, diagnostics));
  REQUIRE(savePng8(folder.at("soft.png"), 2, 1, 3, soft, diagnostics));
  REQUIRE(savePng8(folder.at("gray.png"), 2, 1, 3, gray, diagnostics));
  folder.write("m.mtl",
               "newmtl m\nKd 0.2 0.6 0.2\nmap_d holes.png\n"
               "newmtl soft\nmap_Kd gray.png\nmap_d soft.png\n"
               "newmtl rough\nmap_Pr -clamp on gray.png\nmap_Pm holes.png\n"
               "newmtl shown\nKd 0 0 0\nKs 1 1 1\nmap_Kd gray.png\n"
               "newmtl moved\nmap_Kd -s 2 3 1 -o 0.5 0.25 0 gray.png\n");
  const Model model = loadGood(folder.write(
      "m.obj", "mtllib m.mtl\n" + kSquare + "usemtl moved\nf 1/1 2/2 3/3\nusemtl soft\nf 1/1 2/2 3/3\n"));
  const Material& m = named(model, "m");
  CHECK_FALSE(m.blend);
  CHECK(m.alphaCutoff == 0.5f);
  CHECK(model.textures[m.albedoMap].image->texels ==
        std::vector<std::uint8_t>{255, 255, 255, 255, 255, 255, 255, 0});
  CHECK(named(model, "soft").blend);
  CHECK(model.textures[named(model, "soft").albedoMap].image->texels ==
        std::vector<std::uint8_t>{51, 51, 51, 100, 204, 204, 204, 200});
  CHECK(named(model, "shown").metallic == 1);  // as lacquer it would hide its map
  const Material& rough = named(model, "rough");
  CHECK_FALSE(rough.blinnPhong);
  CHECK(rough.roughness == 1);
  CHECK(rough.metallic == 1);
  CHECK(rough.samplers[2] == (clampU | clampV));
  const std::vector<std::uint8_t>& texels = model.textures[rough.metallicRoughnessMap].image->texels;
  CHECK(texels[1] == 51);   // roughness
  CHECK(texels[2] == 255);  // metallic
  CHECK(texels[5] == 204);
  CHECK(texels[6] == 0);
  // uv * scale + offset, v upwards; Weft's v goes down.
  const auto instance = std::ranges::find_if(model.instances, [&](const ModelInstance& each) {
    return model.materials[each.material].name == "moved";
  });
  REQUIRE(instance != model.instances.end());
  const Mesh& mesh = model.meshes[instance->mesh];
  for (std::uint32_t v = mesh.firstVertex; v < mesh.firstVertex + mesh.vertexCount; ++v) {
    const glm::vec2 plain = glm::vec2(model.vertices[v].position) * 0.5f + 0.5f;
    CHECK(model.vertices[v].uv.x == doctest::Approx(plain.x * 2 + 0.5));
    CHECK(model.vertices[v].uv.y == doctest::Approx(1 - (plain.y * 3 + 0.25)));
  }
}
