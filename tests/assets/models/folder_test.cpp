// A model reads files of its own folder, and no others, however they are named.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include "engine/assets/models/model_file.h"
#include "engine/text/files/file.h"
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

const char* const kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

}  // namespace

TEST_CASE("nothing outside the model's folder is read, in whatever spelling") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.at("model"));
  folder.write("secret.bin", std::string(4096, 's'));
  std::filesystem::create_symlink(folder.at("secret.bin"), folder.at("model/link.bin"));
  for (const std::string uri :
       {"../secret.bin", "x/../../secret.bin", "%2e%2e/secret.bin", "..%2Fsecret.bin", "..\\secret.bin",
        "file:///etc/passwd", "http://example.com/a.bin", "C:/secret.bin", "link.bin"}) {
    CAPTURE(uri);
    GltfMaker maker;
    maker.square();
    json document = maker.document;
    document["buffers"] = {{{"byteLength", maker.bytes.size()}, {"uri", uri}}};
    CHECK(failureOf(folder, "model/m.gltf", document.dump()).code == Code::outsideModelFolder);
    document = json::parse(maker.gltf());
    document["images"] = {{{"uri", uri}}};
    document["textures"] = {{{"source", 0}}};
    document["materials"] = {{{"emissiveTexture", {{"index", 0}}}}};
    CHECK(failureOf(folder, "model/m.gltf", document.dump()).code == Code::outsideModelFolder);
  }
  CHECK(failureOf(folder, "model/m.gltf",
                  R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":1,"uri":")" +
                      folder.at("secret.bin") + "\"}]}")
            .code == Code::outsideModelFolder);
  for (const char* library : {"../secret.bin", "/etc/passwd", "file:///etc/passwd", "link.bin"}) {
    CAPTURE(library);
    CHECK(failureOf(folder, "model/m.obj", fmt::format("mtllib {}\n{}", library, kTriangle)).code ==
          Code::outsideModelFolder);
  }
}

TEST_CASE("a model that is named without a folder has one") {
  const TemporaryFolder folder;
  GltfMaker maker;
  maker.square();
  json document = maker.document;
  document["buffers"] = {{{"byteLength", maker.bytes.size()}, {"uri", "data.bin"}}};
  folder.write("m.gltf", document.dump());
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.at(""));
  CHECK(failureOf("m.gltf").code == Code::unreadableModel);  // missing, not outside
  folder.write("data.bin", maker.bytes);
  text::Diagnostics diagnostics;
  CHECK_MESSAGE(loadModel("m.gltf", diagnostics), diagnostics.text());
  std::filesystem::current_path(before);
}

TEST_CASE("pipes and folders beside a model are refused, and --confine holds") {
  const TemporaryFolder folder;
  REQUIRE(::mkfifo(folder.at("pipe.bin").c_str(), 0600) == 0);
  std::filesystem::create_directory(folder.at("folder.bin"));
  GltfMaker maker;
  maker.square();
  json document = maker.document;
  for (const char* uri : {"pipe.bin", "folder.bin", "missing.bin"}) {
    document["buffers"] = {{{"byteLength", maker.bytes.size()}, {"uri", uri}}};
    CHECK(failureOf(folder, "m.gltf", document.dump()).code == Code::unreadableModel);
  }
  folder.write("data.bin", maker.bytes);
  document["buffers"][0]["uri"] = "data.bin";
  const std::string path = folder.write("m.gltf", document.dump());
  text::Diagnostics diagnostics;
  CHECK_MESSAGE(loadModel(path, diagnostics), diagnostics.text());
  const TemporaryFolder other;
  REQUIRE_FALSE(text::confineTo(other.at("")));
  text::chooseFile(path);
  CHECK(failureOf(path).code == Code::outsideConfinement);  // the buffer; the model itself was named
  text::resetFileAccess();
}
