#include "engine/assets/models/model_file.h"

#include <filesystem>
#include <vector>

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

// Whether a triangle can be seen, wherever nodes, joints and targets are.
bool hasArea(const Model& model, const Mesh& mesh) {
  const auto at = [&](std::uint32_t corner) {
    return glm::dvec3(model.vertices[mesh.firstVertex + model.indices[mesh.firstIndex + corner]].position);
  };
  for (std::uint32_t i = 0; i + 2 < mesh.indexCount; i += 3) {
    const glm::dvec3 a = at(i + 1) - at(i), b = at(i + 2) - at(i), area = glm::cross(a, b);
    if (glm::dot(area, area) > 1e-20 * glm::dot(a, a) * glm::dot(b, b)) return true;
  }
  return mesh.skinned || !mesh.targetBounds.empty();
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
  std::vector<bool> flat;
  for (const Mesh& mesh : model.meshes) flat.push_back(!hasArea(model, mesh));
  if (const auto first = std::ranges::find(flat, true); first != flat.end())
    diagnostics.warning(say::meshesLeftOut, mine.place(), std::ranges::count(flat, true), flat.size(),
                        model.meshes[static_cast<std::size_t>(first - flat.begin())].name);
  std::erase_if(model.instances, [&](const ModelInstance& each) { return flat[each.mesh]; });
  if (model.instances.empty()) {
    diagnostics.error(say::nothingToDraw, mine.place(), path);
    return {};
  }
  closeOpaque(model);
  windMirrored(model);
  return model;
}

}  // namespace weft::assets
