// Small glTF files for tests: a document that is right, to be made wrong in one place.
#pragma once

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace weft::test {

using nlohmann::json;

class GltfMaker {
 public:
  json document = {{"asset", {{"version", "2.0"}}}};
  std::string bytes;  // of the one buffer

  // An accessor over the values; its index.
  template <class T>
  int accessor(const std::vector<T>& values, int components, const char* kind, int componentType) {
    while (bytes.size() % 4 != 0) bytes.push_back(0);
    const std::size_t from = bytes.size(), size = values.size() * sizeof(T);
    bytes.append(reinterpret_cast<const char*>(values.data()), size);
    document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", from}, {"byteLength", size}});
    document["accessors"].push_back({{"bufferView", document["bufferViews"].size() - 1},
                                     {"componentType", componentType},
                                     {"count", values.size() / static_cast<std::size_t>(components)},
                                     {"type", kind}});
    return static_cast<int>(document["accessors"].size()) - 1;
  }
  int floats(const std::vector<float>& values, int components) {
    static const char* const kKinds[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    return accessor(values, components, components == 16 ? "MAT4" : kKinds[components], 5126);
  }
  int shorts(const std::vector<std::uint16_t>& values, int components = 1) {
    return accessor(values, components, components == 4 ? "VEC4" : "SCALAR", 5123);
  }

  // A square of 2 triangles in the plane z = 0, with normals, uv and indices, as mesh 0, node 0 and scene 0.
  GltfMaker& square() {
    const int positions = floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, 3);
    const int normals = floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
    const int uvs = floats({0, 1, 1, 1, 1, 0, 0, 0}, 2);
    const int indices = shorts({0, 1, 2, 0, 2, 3});
    document["meshes"] = {
        {{"name", "square"},
         {"primitives",
          {{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}}},
            {"indices", indices}}}}}};
    document["nodes"] = {{{"name", "node"}, {"mesh", 0}}};
    document["scenes"] = {{{"nodes", {0}}}};
    return *this;
  }

  std::string gltf() const {
    json out = document;
    out["buffers"] = {
        {{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}}};
    return out.dump();
  }
  std::string glb() const {
    json out = document;
    out["buffers"] = {{{"byteLength", bytes.size()}}};
    std::string text = out.dump(), binary = bytes;
    while (text.size() % 4 != 0) text.push_back(' ');
    while (binary.size() % 4 != 0) binary.push_back(0);
    const auto word = [](std::size_t value) {
      const auto small = static_cast<std::uint32_t>(value);
      std::string four(4, 0);
      std::memcpy(four.data(), &small, 4);
      return four;
    };
    return "glTF" + word(2) + word(28 + text.size() + binary.size()) + word(text.size()) + "JSON" + text +
           word(binary.size()) + std::string("BIN\0", 4) + binary;
  }

  static std::string base64(const std::string& bytes) {
    static const char* const kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
      std::uint32_t bits = 0;
      for (std::size_t k = 0; k < 3; ++k)
        bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
      for (std::size_t k = 0; k < 4; ++k)
        out.push_back(i + k <= bytes.size() ? kDigits[bits >> (18 - 6 * k) & 63] : '=');
    }
    return out;
  }
};

}  // namespace weft::test
