// Extensions of glTF, samplers, cameras, sheared matrices. Right values come from the texts of the extensions; packed geometry was
// packed by the libraries' own encoders.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>
#include <webp/encode.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "tests/assets/models/failure.h"
#include "tests/assets/models/loading.h"

using namespace weft;
using namespace weft::assets;
using text::Code;
using weft::test::GltfMaker;
using weft::test::json;
using weft::test::make;
using weft::test::worldOf;

namespace {

GltfMaker plainSquare() {
  GltfMaker maker;
  maker.square();
  return maker;
}

// The square with this material.
Model withMaterial(json material, std::size_t warnings = 0) {
  GltfMaker maker = plainSquare();
  maker.document["materials"] = {std::move(material)};
  maker.document["meshes"][0]["primitives"][0]["material"] = 0;
  return make(maker, warnings);
}

// A buffer view of bytes; its index.
std::size_t viewOf(GltfMaker& maker, const std::string& bytes) {
  while (maker.bytes.size() % 4 != 0) maker.bytes.push_back(0);
  maker.document["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", maker.bytes.size()}, {"byteLength", bytes.size()}});
  maker.bytes += bytes;
  return maker.document["bufferViews"].size() - 1;
}

}  // namespace

TEST_CASE("each extension that is not known is one warning that names it, wherever it is") {
  GltfMaker maker = plainSquare();
  maker.document["materials"] = {{{"extensions", {{"KHR_materials_dispersion", {{"dispersion", 1}}}}}},
                                 {{"extensions", {{"KHR_materials_dispersion", json::object()}}}}};
  maker.document["nodes"][0]["extensions"]["EXT_new"] = json::object();
  maker.document["extras"]["extensions"]["EXT_not_one"] = json::object();
  const TemporaryFolder folder;
  text::Diagnostics diagnostics;
  REQUIRE(loadModel(folder.write("m.gltf", maker.gltf()), diagnostics));
  REQUIRE_MESSAGE(diagnostics.size() == 2, diagnostics.text());
  for (const char* name : {"KHR_materials_dispersion", "EXT_new"})
    CHECK(std::ranges::any_of(diagnostics.items(), [&](const text::Diagnostic& d) {
      return d.code == Code::modelPartLeftOut && d.message.find(name) != std::string::npos;
    }));
}

TEST_CASE("samplers: wrap of both axes and what is magnified") {
  GltfMaker maker = plainSquare();
  maker.document["images"] = {
      {{"uri",
        "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAQAAAAECAIAAAAmkwkpAAAAEUlEQVR42mPY2fARjhi"
        "I4wAAgSEioWWu6ykAAAAASUVORK5CYII="}}};
  maker.document["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}, json::object()};
  maker.document["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 0}, {"sampler", 1}}};
  maker.document["materials"] = {
      {{"pbrMetallicRoughness",
        {{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", {{"index", 1}}}}},
       {"normalTexture", {{"index", 0}}}}};
  const Model model = make(maker);
  const Material& material = model.materials[0];
  const std::array<std::uint8_t, 3> samplers = {clampU | mirrorV | nearest, clampU | mirrorV | nearest,
                                                repeat};
  CHECK(std::ranges::equal(samplers,
                           std::span(material.samplers).first(3)));  // of albedo, normal, metallic-roughness
}

TEST_CASE("maps of which a mesh lacks the texture coordinates are one warning that names them") {
  GltfMaker maker = plainSquare();
  maker.document["images"] = {
      {{"uri", "data:image/png;base64," +
                   GltfMaker::base64(encodePng8(1, 1, 3, std::array<std::uint8_t, 3>{1, 2, 3}))}}};
  maker.document["textures"] = {{{"source", 0}}};
  maker.document["materials"] = {
      {{"name", "painted"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}},
      {{"name", "plain"}}};
  json& primitives = maker.document["meshes"][0]["primitives"];
  primitives[0]["material"] = 0;
  CHECK(make(maker).instances.size() == 1);
  const auto said = [&] {
    const TemporaryFolder folder;
    text::Diagnostics diagnostics;
    CHECK(loadModel(folder.write("m.gltf", maker.gltf()), diagnostics));
    REQUIRE_MESSAGE(diagnostics.size() == 1, diagnostics.text());
    CHECK(diagnostics.items()[0].code == Code::modelPartLeftOut);
    CHECK(diagnostics.items()[0].message.find("'painted'") != std::string::npos);
    return diagnostics.items()[0].expected;
  };
  maker.document["materials"][0]["normalTexture"] = {{"index", 0}, {"texCoord", 3}};
  CHECK(said() == "TEXCOORD_3");
  maker.document["materials"][0].erase("normalTexture");
  primitives[0]["attributes"].erase("TEXCOORD_0");
  primitives.push_back(primitives[0]);
  CHECK(said() == "TEXCOORD_0");
  for (json& each : primitives) each["material"] = 1;
  CHECK(make(maker).instances.size() == 2);  // no map: nothing is lost
}

TEST_CASE("layers: what the extensions of a material say; what changes nothing is none") {
  Model model = withMaterial(
      {{"extensions",
        {{"KHR_materials_ior", {{"ior", 1.8}}},
         {"KHR_materials_specular", {{"specularFactor", 0.5}, {"specularColorFactor", {1, 0.5, 0.25}}}},
         {"KHR_materials_clearcoat", {{"clearcoatFactor", 0.75}, {"clearcoatRoughnessFactor", 0.25}}},
         {"KHR_materials_sheen", {{"sheenColorFactor", {0.5, 0, 1}}, {"sheenRoughnessFactor", 0.5}}},
         {"KHR_materials_anisotropy", {{"anisotropyStrength", 0.5}, {"anisotropyRotation", 1}}},
         {"KHR_materials_iridescence",
          {{"iridescenceFactor", 1}, {"iridescenceIor", 1.5}, {"iridescenceThicknessMinimum", 200}}},
         {"KHR_materials_transmission", {{"transmissionFactor", 0.5}}},
         {"KHR_materials_volume",
          {{"thicknessFactor", 2},
           {"attenuationDistance", 4},
           {"attenuationColor", {1, std::exp(-2.0), 1}}}}}}});
  MaterialLayers layers = model.materials[0].layers;
  CHECK(layers.absorption.g == doctest::Approx(0.5));
  layers.absorption = glm::vec3(0);
  CHECK(layers == MaterialLayers{.specularColor = {1, 0.5f, 0.25f},
                                 .specular = 0.5f,
                                 .ior = 1.8f,
                                 .coat = 0.75f,
                                 .coatRoughness = 0.25f,
                                 .sheen = {0.5f, 0, 1},
                                 .sheenRoughness = 0.5f,
                                 .anisotropy = 0.5f,
                                 .anisotropyTurn = 1,
                                 .layered = true,
                                 .film = 1,
                                 .filmIor = 1.5f,
                                 .filmMin = 200,
                                 .transmission = 0.5f,
                                 .thickness = 2});
  model = withMaterial(
      {{"extensions", {{"KHR_materials_ior", {{"ior", 1.5}}}, {"KHR_materials_specular", json::object()}}}});
  CHECK(model.materials[0].layers == MaterialLayers{});
}

TEST_CASE("unlit: the base color is what is seen, and nothing reflects") {
  const Model model = withMaterial({{"pbrMetallicRoughness", {{"baseColorFactor", {0.2, 0.4, 0.6, 1}}}},
                                    {"emissiveFactor", {1, 1, 1}},
                                    {"extensions", {{"KHR_materials_unlit", json::object()}}}});
  const Material& material = model.materials[0];
  CHECK(material.unlit);
  CHECK(material.emissive == glm::vec3(0.2f, 0.4f, 0.6f));
  CHECK(material.albedo == glm::vec3(0));
  CHECK(material.specular == glm::vec3(0));
}

TEST_CASE("specular-glossiness: the diffuse part and the reflectance along the normal stay") {
  for (const auto& [diffuse, specular, glossiness] :
       {std::tuple{glm::vec3(0.1f, 0.8f, 0.1f), glm::vec3(0.04f), 0.3f},
        {glm::vec3(0), glm::vec3(0.9f, 0.6f, 0.2f), 0.9f},
        {glm::vec3(0.5f), glm::vec3(0.04f), 1.0f}}) {
    const Model model = withMaterial({{"extensions",
                                       {{"KHR_materials_pbrSpecularGlossiness",
                                         {{"diffuseFactor", {diffuse.r, diffuse.g, diffuse.b, 1}},
                                          {"specularFactor", {specular.r, specular.g, specular.b}},
                                          {"glossinessFactor", glossiness}}}}}});
    const Material& m = model.materials[0];
    CHECK(m.roughness == doctest::Approx(1 - glossiness));
    for (int c = 0; c < 3; ++c) {
      const float f0 = 0.04f * (1 - m.metallic) + m.albedo[c] * m.metallic;
      CHECK(f0 == doctest::Approx(specular[c]).epsilon(0.02));
      // Of the extension: diffuse * (1 - max(specular)); of metallic-roughness: albedo * (1 - 0.04) * (1 - metallic).
      const float below = diffuse[c] * (1 - std::max({specular.r, specular.g, specular.b}));
      CHECK(std::abs(m.albedo[c] * 0.96f * (1 - m.metallic) - below) < 0.02f);
    }
  }
}

TEST_CASE("instances of EXT_mesh_gpu_instancing, and nodes that are invisible") {
  GltfMaker maker = plainSquare();
  const int moves = maker.floats({1, 0, 0, 0, 2, 0, 0, 0, 3}, 3),
            scales = maker.floats({1, 1, 1, 2, 2, 2, 1, 1, 3}, 3);
  const float root = std::sqrt(0.5f);
  const int turns = maker.floats({0, 0, 0, 1, 0, 0, root, root, 0, 0, 0, 1}, 4);
  maker.document["nodes"][0]["translation"] = {10, 0, 0};
  maker.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", moves}, {"ROTATION", turns}, {"SCALE", scales}};
  maker.document["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  const Model model = make(maker);
  REQUIRE(model.instances.size() == 3);
  // T * R * S of the instance, below the node's own.
  const glm::vec4 wanted[] = {{12, 0, 0, 1}, {10, 4, 0, 1}, {11, 0, 3, 1}};
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(glm::distance(worldOf(model, model.instances[i].node) * glm::vec4(1, 0, 0, 1), wanted[i]) < 1e-5f);

  maker = plainSquare();
  maker.document["nodes"].push_back(
      {{"children", {2}}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}});
  maker.document["nodes"].push_back({{"mesh", 0}});
  maker.document["scenes"][0]["nodes"] = {0, 1};
  CHECK(make(maker).instances.size() == 1);
  maker.document.erase("scenes");
  CHECK(make(maker).instances.size() == 1);
}

TEST_CASE("a matrix that shears is kept, a flat one too, and what is below it") {
  const std::vector<std::vector<float>> matrices = {
      {1, 0, 0, 0, 0.8f, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1},
      {-1, 0.2f, 0, 0, 0.5f, 2, 0.3f, 0, 1, 0, 3, 0, 0, 0, 0, 1},
      {1, 1, 0, 0, 2, 2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
  };
  for (const std::vector<float>& matrix : matrices) {
    GltfMaker maker = plainSquare();
    maker.document["nodes"][0] = {{"matrix", matrix}, {"children", {1}}};
    maker.document["nodes"].push_back({{"mesh", 0}, {"translation", {1, 2, 3}}});
    const Model model = make(maker);
    for (const glm::vec3 p : {glm::vec3(0), {1, 0, 0}, {0, 1, 0}, {0.3f, -2, 5}}) {
      glm::vec3 wanted(matrix[12], matrix[13], matrix[14]);
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
          wanted[r] += matrix[static_cast<std::size_t>(4 * c + r)] * (p[c] + static_cast<float>(c + 1));
      CHECK(glm::distance(glm::vec3(worldOf(model, model.instances[0].node) * glm::vec4(p, 1)), wanted) <
            1e-4f);
    }
  }
}

TEST_CASE("cameras of the file") {
  GltfMaker maker = plainSquare();
  maker.document["cameras"] = {
      {{"name", "lens"}, {"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.02}}}},
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"znear", 0}, {"zfar", 9}}}}};
  maker.document["nodes"].push_back({{"camera", 0}, {"translation", {0, 0, 5}}});
  maker.document["nodes"].push_back({{"camera", 1}, {"name", "flat"}});
  maker.document["scenes"][0]["nodes"] = {0, 1, 2};
  const Model model = make(maker);
  REQUIRE(model.cameras.size() == 2);
  CHECK(model.cameras[0].name == "lens");
  CHECK(model.cameras[0].fovDegrees == doctest::Approx(0.8 * 180 / M_PI));
  CHECK(model.cameras[0].nearPlane == doctest::Approx(0.02));
  CHECK(model.cameras[1].name == "flat");
  CHECK(model.cameras[1].height == doctest::Approx(4));
}

TEST_CASE("a path with backslashes is told so") {
  GltfMaker maker = plainSquare();
  maker.document["images"] = {{{"uri", "tex\\a.png"}}};
  maker.document["textures"] = {{{"source", 0}}};
  maker.document["materials"] = {{{"normalTexture", {{"index", 0}}}}};
  const TemporaryFolder folder;
  const text::Diagnostic d = test::failureOf(folder, "m.gltf", maker.gltf());
  CHECK(d.code == Code::outsideModelFolder);
  CHECK(d.hint.find("tex/a.png") != std::string::npos);
}

TEST_CASE("Draco: the square with joints that was packed, and one that is damaged") {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(2);
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32),
            uv = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32),
            normal = builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32),
            joint = builder.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_UINT16),
            weight = builder.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_FLOAT32);
  const float places[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
              uvs[4][2] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}},
              normals[4][3] = {{0.6f, 0, 0.8f}, {0, -0.8f, 0.6f}, {-0.48f, 0.6f, 0.64f}, {0, 0, -1}},
              weights[4][4] = {{0.5f, 0.25f, 0.25f}, {0.75f, 0.25f}, {0.625f, 0.375f}, {1}};
  const std::uint16_t joints[4][4] = {{3, 2, 1, 0}, {1, 0, 0, 0}, {0, 3, 0, 0}, {2, 0, 0, 0}};
  const int faces[2][3] = {{0, 1, 2}, {0, 2, 3}};
  for (std::uint32_t f = 0; f < 2; ++f) {
    const int* c = faces[f];
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(f), places[c[0]], places[c[1]],
                                      places[c[2]]);
    builder.SetAttributeValuesForFace(uv, draco::FaceIndex(f), uvs[c[0]], uvs[c[1]], uvs[c[2]]);
    builder.SetAttributeValuesForFace(normal, draco::FaceIndex(f), normals[c[0]], normals[c[1]],
                                      normals[c[2]]);
    builder.SetAttributeValuesForFace(joint, draco::FaceIndex(f), joints[c[0]], joints[c[1]], joints[c[2]]);
    builder.SetAttributeValuesForFace(weight, draco::FaceIndex(f), weights[c[0]], weights[c[1]],
                                      weights[c[2]]);
  }
  const auto mesh = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetAttributeQuantization(draco::GeometryAttribute::NORMAL, 12);
  draco::EncoderBuffer buffer;
  REQUIRE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  const std::string packed(buffer.data(), buffer.size());
  const auto makerOf = [&](const std::string& bytes) {
    GltfMaker maker;
    json attributes, ids;
    for (const auto& [name, attribute, kind, component] : {std::tuple("POSITION", position, "VEC3", 5126),
                                                           {"TEXCOORD_0", uv, "VEC2", 5126},
                                                           {"NORMAL", normal, "VEC3", 5126},
                                                           {"JOINTS_0", joint, "VEC4", 5123},
                                                           {"WEIGHTS_0", weight, "VEC4", 5126}}) {
      attributes[name] = maker.document["accessors"].size();
      ids[name] = mesh->attribute(attribute)->unique_id();
      maker.document["accessors"].push_back(
          {{"componentType", component}, {"count", mesh->num_points()}, {"type", kind}});
    }
    maker.document["accessors"].push_back({{"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}});
    const std::size_t view = viewOf(maker, bytes);
    maker.document["meshes"] = {
        {{"primitives",
          {{{"attributes", attributes},
            {"indices", 5},
            {"extensions",
             {{"KHR_draco_mesh_compression", {{"bufferView", view}, {"attributes", ids}}}}}}}}}};
    maker.document["nodes"] = {
        {{"mesh", 0}, {"skin", 0}}, json::object(), json::object(), json::object(), json::object()};
    maker.document["skins"] = {{{"joints", {1, 2, 3, 4}}}};
    maker.document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return maker;
  };
  const Model model = make(makerOf(packed));
  REQUIRE(model.indices.size() == 6);
  for (const std::uint32_t i : model.indices) {
    const Vertex& v = model.vertices[i];
    CHECK(std::abs(v.uv.x - v.position.x) < 1e-3f);
    CHECK(std::abs(v.uv.y - (1 - v.position.y)) < 1e-3f);
    std::size_t corner = 0;
    while (corner < 3 && v.position != glm::vec3(places[corner][0], places[corner][1], 0)) ++corner;
    const float* n = normals[corner];
    CHECK(glm::distance(v.normal, glm::vec3(n[0], n[1], n[2])) < 2e-3f);
    for (std::size_t k = 0; k < 4; ++k) {
      CHECK(model.skin[i].weights[k] == weights[corner][k]);
      if (weights[corner][k] > 0) CHECK(model.skin[i].joints[k] == joints[corner][k]);
    }
  }
  const TemporaryFolder folder;
  for (std::size_t length = 0; length < packed.size(); length += 7) {
    std::string damaged = packed.substr(0, length);
    damaged.resize(packed.size(), '\x7f');
    text::Diagnostics diagnostics;
    const auto found = loadModel(folder.write("m.gltf", makerOf(damaged).gltf()), diagnostics);
    CHECK(found.has_value() != diagnostics.hasErrors());
  }
}

TEST_CASE("meshopt: vertices and indices that were packed, a fallback without bytes, damage") {
  GltfMaker maker = plainSquare();
  // Each view of the square as meshoptimizer packs it.
  const std::string plain = maker.bytes;
  json views = maker.document["bufferViews"];
  std::string bytes;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const std::size_t offset = views[i]["byteOffset"], length = views[i]["byteLength"];
    const bool indices = i == 3;
    const std::size_t stride = indices ? 2 : i == 2 ? 8 : 12, count = length / stride;
    std::vector<unsigned char> out(4096);
    std::vector<unsigned short> corners(6);
    std::memcpy(corners.data(), plain.data() + offset, indices ? 12 : 0);
    out.resize(
        indices ? meshopt_encodeIndexBuffer(out.data(), out.size(), corners.data(), 6)
                : meshopt_encodeVertexBuffer(out.data(), out.size(), plain.data() + offset, count, stride));
    while (bytes.size() % 4 != 0) bytes.push_back(0);
    views[i]["buffer"] = 1;
    views[i]["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                         {"byteOffset", bytes.size()},
                                                         {"byteLength", out.size()},
                                                         {"byteStride", stride},
                                                         {"count", count},
                                                         {"mode", indices ? "TRIANGLES" : "ATTRIBUTES"}};
    bytes.append(out.begin(), out.end());
  }
  const Model wanted = make(plainSquare());
  const TemporaryFolder folder;
  const auto gltfOf = [&](const std::string& packed) {
    json out = maker.document;
    out["bufferViews"] = views;
    out["buffers"] = {
        {{"byteLength", packed.size()},
         {"uri", "data:application/octet-stream;base64," + GltfMaker::base64(packed)}},
        {{"byteLength", plain.size()}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    out["extensionsRequired"] = {"EXT_meshopt_compression"};
    return out.dump();
  };
  const Model model = test::loadGood(folder.write("m.gltf", gltfOf(bytes)));
  REQUIRE(model.indices.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) {
    const Vertex &a = model.vertices[model.indices[i]], &b = wanted.vertices[wanted.indices[i]];
    CHECK(a.position == b.position);
    CHECK(a.uv == b.uv);
  }
  for (std::size_t at = 0; at < bytes.size(); at += 5) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
    text::Diagnostics diagnostics;
    const auto found = loadModel(folder.write("m.gltf", gltfOf(damaged)), diagnostics);
    CHECK(found.has_value() != diagnostics.hasErrors());
  }
}

TEST_CASE("meshopt: filters and a sequence of indices give what their encoders took") {
  const float units[4][4] = {
      {0.6f, 0, 0.8f, 0}, {0, -0.8f, 0.6f, 0}, {-0.48f, 0.6f, -0.64f, 0}, {0, 0, -1, 0}};
  const float turns[4][4] = {
      {0.5f, 0.5f, 0.5f, 0.5f}, {0.1f, -0.5f, 0.7f, 0.5f}, {-0.7f, 0.1f, 0.1f, -0.7f}, {0.8f, 0, -0.6f, 0}};
  const float places[4][3] = {{-3, 0.3f, 700}, {1e-3f, 2, 5}, {41, -0.07f, 1}, {9, 8, 1000}};
  const std::uint16_t corners[6] = {3, 0, 2, 1, 2, 0};
  const auto vertices = [](const auto& encode, std::size_t stride, int bits, const float* values) {
    std::vector<unsigned char> filtered(4 * stride), out(4096);
    encode(filtered.data(), 4, stride, bits, values);
    out.resize(meshopt_encodeVertexBuffer(out.data(), out.size(), filtered.data(), 4, stride));
    return out;
  };
  for (const std::size_t normalStride : {4u, 8u}) {
    GltfMaker maker = plainSquare();
    const int rotations = maker.shorts(std::vector<std::uint16_t>(16), 4);
    // The view of an accessor is as it was packed; its plain bytes stay, and are wrong.
    const auto pack = [&](int accessor, const std::vector<unsigned char>& bytes, std::size_t stride,
                          json extension) {
      json& views = maker.document["bufferViews"];
      extension.update(views[viewOf(maker, std::string(bytes.begin(), bytes.end()))]);
      extension["byteStride"] = stride;
      json& view = views[maker.document["accessors"][accessor]["bufferView"].get<std::size_t>()];
      if (extension["mode"] == "ATTRIBUTES") view["byteStride"] = stride;
      view["extensions"]["EXT_meshopt_compression"] = extension;
    };
    const auto packVertices = [&](int accessor, const auto& encode, const char* filter, std::size_t stride,
                                  int bits, const float* values) {
      pack(accessor, vertices(encode, stride, bits, values), stride,
           {{"count", 4}, {"mode", "ATTRIBUTES"}, {"filter", filter}});
    };
    packVertices(0, meshopt_encodeFilterExp, "EXPONENTIAL", 12, 24, places[0]);
    packVertices(1, meshopt_encodeFilterOct, "OCTAHEDRAL", normalStride, normalStride == 4 ? 8 : 16,
                 units[0]);
    packVertices(rotations, meshopt_encodeFilterQuat, "QUATERNION", 8, 16, turns[0]);
    std::vector<unsigned char> sequence(4096);
    sequence.resize(meshopt_encodeIndexSequence(sequence.data(), sequence.size(), corners, 6));
    pack(3, sequence, 2, {{"count", 6}, {"mode", "INDICES"}});
    json& accessors = maker.document["accessors"];
    accessors[1].update({{"componentType", normalStride == 4 ? 5120 : 5122}, {"normalized", true}});
    accessors[4].update({{"componentType", 5122}, {"normalized", true}});
    maker.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"ROTATION", rotations}};
    maker.document["extensionsRequired"] = {"EXT_meshopt_compression", "KHR_mesh_quantization"};
    const Model model = make(maker);
    REQUIRE(model.indices.size() == 6);
    for (std::size_t i = 0; i < 6; ++i) {
      const Vertex& v = model.vertices[model.indices[i]];
      const float *place = places[corners[i]], *unit = units[corners[i]];
      CHECK(glm::distance(v.position, glm::vec3(place[0], place[1], place[2])) < 2e-4f);
      CHECK(glm::distance(v.normal, glm::vec3(unit[0], unit[1], unit[2])) <
            (normalStride == 4 ? 0.02f : 1e-4f));
    }
    REQUIRE(model.instances.size() == 4);
    for (std::size_t i = 0; i < 4; ++i) {
      const glm::quat turn(turns[i][3], turns[i][0], turns[i][1], turns[i][2]);
      const glm::mat3 world(worldOf(model, model.instances[i].node)), wanted = glm::mat3_cast(turn);
      for (int c = 0; c < 3; ++c) CHECK(glm::distance(world[c], wanted[c]) < 2e-4f);
    }
  }
}

TEST_CASE("WebP: the texels that were encoded") {
  const std::vector<std::uint8_t> texels = {10, 20, 30, 255, 200, 100, 50, 128};
  std::uint8_t* encoded = nullptr;
  const std::size_t size = WebPEncodeLosslessRGBA(texels.data(), 2, 1, 8, &encoded);
  REQUIRE(size > 0);
  GltfMaker maker = plainSquare();
  const std::size_t view = viewOf(maker, std::string(reinterpret_cast<const char*>(encoded), size));
  WebPFree(encoded);
  maker.document["images"] = {{{"bufferView", view}, {"mimeType", "image/webp"}}};
  maker.document["textures"] = {{{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}};
  maker.document["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  maker.document["extensionsRequired"] = {"EXT_texture_webp"};
  const Model model = make(maker);
  CHECK(model.textures[model.materials[0].albedoMap].image->texels == texels);
}
