#include "engine/assets/models/model_file.h"

#include <fmt/format.h>

#include <filesystem>

#include "assets_sentences.h"
#include "engine/assets/models/fbx/fbx.h"
#include "engine/assets/models/gltf/gltf_document.h"
#include "engine/assets/models/obj/obj.h"
#include "engine/assets/models/parts/mesh_builder.h"
#include "engine/assets/models/parts/model_files.h"
#include "engine/text/files/file.h"

namespace weft::assets {

namespace {

// What says that it blends but lets nothing through is opaque: its triangles need no order.
void closeOpaque(Model& model) {
  std::vector<bool> clear(model.materials.size());
  for (const ModelInstance& each : model.instances)
    if (model.meshes[each.mesh].clear) clear[each.material] = true;
  for (std::size_t i = 0; i < clear.size(); ++i) {
    Material& material = model.materials[i];
    const bool map = material.albedoMap != kNoRow && model.textures[material.albedoMap].clear;
    material.blend = material.blend && (material.alpha < 1 || map || clear[i]);
  }
}

}  // namespace

bool isModelName(const std::string& name) {
  const std::string extension = text::lowerExtension(name);
  return extension == ".gltf" || extension == ".glb" || extension == ".obj" || extension == ".fbx";
}

std::optional<Model> loadModel(const std::string& path, text::Diagnostics& diagnostics,
                               const std::stop_token& stop, std::vector<std::string>* files) {
  text::Diagnostics said;
  ModelFiles mine(path, said, stop);
  Model model;
  model.name = std::filesystem::path(path).stem().string();
  bool good = false;
  const std::string kind = text::lowerExtension(path);
  const bool made = kind == ".fbx";
  if (!isModelName(path)) {
    said.error(say::unknownModelKind, mine.place(), path, kind.empty() ? "no extension" : kind);
  } else if (auto bytes = mine.readModel()) {
    if (made) bytes = glbOfFbx(*bytes, mine);
    good = kind == ".obj" ? bytes && readObj(*bytes, mine, model)
                          : bytes && readGltf(std::move(*bytes), mine, model, made);
  }
  if (stop.stop_requested()) return {};
  for (text::Diagnostic each : said.items()) {
    if (made) each.pointer.clear();  // lines are those of what was made of the file
    if (made && each.place.line > 0) each.place = mine.place();
    diagnostics.add(std::move(each));
  }
  model.files = mine.files();
  if (files) *files = model.files;
  if (!good) return {};
  if (model.instances.empty()) {
    diagnostics.error(say::nothingToDraw, mine.place(), path);
    return {};
  }
  closeOpaque(model);
  windMirrored(model);
  return model;
}

}  // namespace weft::assets
