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
  std::vector<bool> open(model.materials.size());
  for (const ModelInstance& each : model.instances) {
    const Mesh& mesh = model.meshes[each.mesh];
    for (std::size_t v = 0; v < mesh.vertexCount && !model.colors.empty(); ++v)
      if (model.colors[mesh.firstVertex + v].a < 1) open[each.material] = true;
  }
  for (std::size_t i = 0; i < open.size(); ++i) {
    Material& material = model.materials[i];
    if (!material.blend || material.alpha < 1 || open[i]) continue;
    material.blend = false;
    if (material.albedoMap == kNoRow) continue;
    const std::vector<std::uint8_t>& texels = model.textures[material.albedoMap].image->texels;
    for (std::size_t t = 3; t < texels.size() && !material.blend; t += 4) material.blend = texels[t] < 255;
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
