#include "engine/assets/models/model_file.h"

#include <fmt/format.h>

#include <filesystem>

#include "engine/assets/images/image_codecs.h"
#include "engine/assets/models/apart/model_apart.h"
#include "engine/assets/models/gltf/gltf_document.h"
#include "engine/assets/models/obj/obj.h"
#include "engine/assets/models/parts/mesh_builder.h"
#include "engine/assets/models/parts/model_files.h"

namespace weft::assets {

bool isModelName(const std::string& name) {
  const std::string extension = lowerExtension(name);
  return extension == ".gltf" || extension == ".glb" || extension == ".obj" || extension == ".fbx";
}

std::optional<Model> loadModel(const std::string& path, text::Diagnostics& diagnostics,
                               const LoadObserver& observer, std::vector<std::string>* files) {
  ModelFiles mine(path, diagnostics, observer);
  Model model;
  model.name = std::filesystem::path(path).stem().string();
  bool good = false;
  const std::string kind = lowerExtension(path);
  if (!isModelName(path)) {
    text::Diagnostic& d = diagnostics.error(text::Code::unreadableModel, mine.place(),
                                            fmt::format("'{}' is no kind of model that is known", path));
    d.expected = ".gltf, .glb, .obj or .fbx";
    d.found = kind.empty() ? "no extension" : kind;
  } else if (auto bytes = mine.readModel()) {
    good = kind == ".gltf" || kind == ".glb" ? readGltf(std::move(*bytes), mine, observer, diagnostics, model)
           : kind == ".obj"                  ? readObj(*bytes, mine, observer, diagnostics, model)
                            : readApart(std::move(*bytes), mine, observer, diagnostics, model);
  }
  model.files = mine.files();
  if (files) *files = model.files;
  if (!good || mine.gaveUp()) return {};
  if (model.instances.empty()) {
    text::Diagnostic& d = diagnostics.error(text::Code::unreadableModel, mine.place(),
                                            fmt::format("the model '{}' has nothing to draw", path));
    d.expected = "at least one mesh of triangles in its scene";
    return {};
  }
  windMirrored(model);
  return model;
}

}  // namespace weft::assets
