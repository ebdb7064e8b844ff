#include "engine/assets/models/assimp/assimp_model.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <filesystem>

#include "engine/assets/models/assimp/assimp_io.h"
#include "engine/assets/models/assimp/assimp_scene.h"
#include "engine/assets/models/assimp/model_check.h"
#include "engine/assets/models/parts/mesh_builder.h"
#include "engine/base/limits.h"

namespace weft::assets {

using base::Code;
using base::Diagnostics;

namespace {

bool isObj(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".obj";
}

bool checkBefore(const std::string& bytes, bool obj, ModelCounts& counts, ModelFiles& files,
                 Diagnostics& diagnostics) {
  const bool text = obj || !isBinaryFbx(bytes);
  if (text && bytes.size() > base::raised(kMostModelTextBytes)) {
    base::reportLimit(diagnostics, files.place(), "the model's text is too large", kMostModelTextBytes,
                      "bytes of one OBJ or text FBX file", bytes.size())
        .found = fmt::format("{} bytes", bytes.size());
    return false;
  }
  const ModelProblem problem = obj ? checkObj(bytes, counts) : checkFbx(bytes, counts);
  if (!problem.message.empty()) {
    base::Place place = files.place();
    place.line = problem.line;
    base::Diagnostic& d =
        diagnostics.error(problem.line > 0 ? Code::badModelValue : Code::unreadableModel, place,
                          fmt::format("cannot read model '{}': {}", files.path(), problem.message));
    d.expected = problem.expected;
    d.found = problem.found;
    return false;
  }
  // Assimp makes a vertex of each corner.
  Model none;
  return MeshBuilder(none).hasRoom(std::max(counts.vertices, counts.corners), counts.corners, files.place(),
                                   diagnostics) &&
         files.count(counts.unpacked, files.place());
}

bool hasEndlessFace(const aiScene& scene) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m)
    for (unsigned f = 0; f < scene.mMeshes[m]->mNumFaces; ++f)
      if (scene.mMeshes[m]->mFaces[f].mNumIndices > 4096) return true;
  return false;
}

}  // namespace

bool readWithAssimp(std::string bytes, ModelFiles& files, const LoadObserver& observer,
                    const DecodeRunner& decode, Diagnostics& diagnostics, Model& model) {
  const bool obj = isObj(files.path());
  ModelCounts counts;
  if (!checkBefore(bytes, obj, counts, files, diagnostics)) return false;
  const std::size_t before = diagnostics.errorCount();
  Assimp::Importer importer;  // owns what is set here
  const std::string name = obj ? "model.obj" : "model.fbx";
  importer.SetIOHandler(new ModelIo(name, std::move(bytes), files));
  importer.SetProgressHandler(new Progress(observer));
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene = importer.ReadFile(name, 0);
  const auto unreadable = [&](const std::string& why) {
    if (diagnostics.errorCount() == before)
      diagnostics
          .error(Code::unreadableModel, files.place(),
                 fmt::format("cannot read model '{}': {}", files.path(), why))
          .expected = obj ? "a Wavefront OBJ file" : "an FBX file of version 7.1 or later";
    return false;
  };
  if (files.gaveUp()) return false;
  if (!scene || !scene->mRootNode) return unreadable(importer.GetErrorString());
  if (diagnostics.errorCount() > before) return false;
  if (hasEndlessFace(*scene)) return unreadable("a face of it has more than 4096 corners");
  scene = importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_SortByPType);
  if (!scene) return unreadable(importer.GetErrorString());
  return readAssimpScene(*scene, counts.colorlessLine, files, observer, decode, diagnostics, model);
}

}  // namespace weft::assets
