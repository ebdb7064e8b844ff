#include "engine/scene/files/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <memory>

#include "engine/assets/material_library.h"
#include "engine/assets/models/model_file.h"
#include "engine/base/files/text_file.h"
#include "engine/base/json/fields.h"
#include "engine/base/nearest.h"
#include "engine/scene/files/ground.h"
#include "engine/scene/files/lights.h"
#include "engine/scene/files/lists.h"
#include "engine/scene/files/model_scene.h"
#include "engine/scene/files/models.h"
#include "engine/scene/files/reading.h"

namespace weft::scene {

using base::Code;
using base::Diagnostics;
using base::JsonFields;
using base::JsonMember;
using base::JsonValue;

namespace {

constexpr double kMaxSpheres = 1 << 24;

class Reader {
 public:
  Reader(const std::string& name, Diagnostics& diagnostics, const SceneChoice& choice,
         const assets::LoadObserver& observer)
      : name_(name),
        diagnostics_(diagnostics),
        choice_(choice),
        models_(scene_, name_, diagnostics, observer) {}

  std::optional<Scene> read(std::string_view text) {
    const std::size_t errorsBefore = diagnostics_.errorCount();
    const base::PointerScope pointers(name_, text, diagnostics_);
    const auto root = base::parseJson(text, std::make_shared<const std::string>(name_), diagnostics_);
    if (!root) return {};
    if (isGraph(*root)) return {};
    scene_.files.push_back(name_);
    JsonFields fields(*root, "the scene", Code::badSceneValue, diagnostics_);
    scene_.name = fields.text("name").value_or(std::filesystem::path(name_).stem().string());
    if (const JsonValue* library = fields.find("library")) readLibrary(*library, "'library' of the scene");
    if (const JsonValue* materials = fields.object("materials"))
      for (const JsonMember& member : materials->members) addMaterial(member.key, member.value, member.place);
    const JsonValue* cameras = fields.object("cameras");
    if (cameras) readCameras(*cameras);
    if (!choice_.camera.empty() && !findCamera(scene_, choice_.camera))
      failCamera(cameras ? *cameras : *root);
    if (scene_.cameras.size() == 0) scene_.cameras.add({.name = "default", .pose = {.position = {0, 0, 20}}});
    const JsonValue* grid = fields.find("grid");
    if (grid) readGrid(*grid);
    if (!grid && !choice_.materials.empty())
      fail(Code::unknownMaterial, *root,
           fmt::format("there is no grid to give the materials of '{}' to", choice_.materials));
    if (const JsonValue* spheres = fields.array("spheres"))
      for (std::size_t i = 0; i < spheres->items.size(); ++i) readSphere(spheres->items[i], i);
    readLights(fields, scene_, diagnostics_);
    readGround(fields, scene_, diagnostics_);
    models_.read(fields, [this](const JsonValue& value, const std::string& what) {
      return value.is(JsonValue::Type::object) ? addMaterial("", value, value.place)
                                               : findMaterial(value, what);
    });
    models_.finish();
    fields.finish();
    if (diagnostics_.errorCount() > errorsBefore || models_.failed()) return {};
    return std::move(scene_);
  }

  // Paths of the material libraries and of what belongs to models, readable or not.
  std::vector<std::string> others() const {
    std::vector<std::string> paths;
    for (const auto& [path, ids] : libraries_) paths.push_back(path);
    paths.insert(paths.end(), models_.files().begin(), models_.files().end());
    return paths;
  }

 private:
  // A graph in the place of a scene: one report says what it is.
  bool isGraph(const JsonValue& root) {
    for (const char* key : {"passes", "extends"}) {
      if (!root.find(key)) continue;
      auto& d =
          fail(Code::wrongType, root, fmt::format("this file has \"{}\": it is a graph, not a scene", key));
      d.expected = "a scene, with \"cameras\", \"grid\", \"spheres\", \"models\", \"sun\" or \"lamps\"";
      d.hint = fmt::format("a graph stands without --scene: weft render {} --scene SCENE", name_);
      return true;
    }
    return false;
  }

  base::Diagnostic& fail(Code code, const JsonValue& value, std::string message) {
    return failAt(diagnostics_, code, value, std::move(message));
  }

  MaterialId add(Material material) {
    const std::string name = material.name;
    const MaterialId id = scene_.materials.add(std::move(material));
    if (!name.empty()) byName_.emplace(name, id);
    return id;
  }

  // The presets of the library file that `value` names, each added to the scene once.
  std::vector<MaterialId> readLibrary(const JsonValue& value, const std::string& what) {
    const auto given = base::readText(value, what, diagnostics_);
    if (!given) return {};
    return readLibraryFile((std::filesystem::path(name_).parent_path() / *given).lexically_normal().string(),
                           value);
  }

  std::vector<MaterialId> readLibraryFile(const std::string& path, const JsonValue& value) {
    if (const auto known = libraries_.find(path); known != libraries_.end()) return known->second;
    std::vector<MaterialId>& ids = libraries_[path];
    const auto text = base::readTextFile(path, diagnostics_, Code::unreadableFile, value.place);
    if (text) scene_.files.push_back(path);
    const auto library = text ? assets::readMaterialLibrary(*text, path, diagnostics_) : std::nullopt;
    unread_ = unread_ || !library;
    if (!library) return {};
    if (library->materials.empty())
      fail(Code::unknownMaterial, value, fmt::format("the material library '{}' is empty", path));
    for (const assets::MaterialPreset& preset : library->materials) {
      if (byName_.contains(preset.name)) {
        fail(Code::duplicateMaterial, value,
             fmt::format("a second material '{}', from '{}'", preset.name, path));
        continue;
      }
      Material material;
      material.name = preset.name;
      material.albedo = {preset.albedo[0], preset.albedo[1], preset.albedo[2]};
      material.metallic = preset.metallic;
      material.roughness = preset.roughness;
      ids.push_back(add(std::move(material)));
    }
    return ids;
  }

  MaterialId addMaterial(const std::string& name, const JsonValue& value, const base::Place& place) {
    JsonFields fields(value, name.empty() ? "a material" : fmt::format("material '{}'", name),
                      Code::badMaterialValue, diagnostics_);
    fields.require({"albedo"});
    Material material;
    material.name = name;
    if (const auto albedo = fields.triple("albedo", kUnit)) material.albedo = toVec3(*albedo);
    material.metallic = static_cast<float>(fields.number("metallic", kUnit).value_or(0));
    material.roughness = static_cast<float>(fields.number("roughness", kUnit).value_or(0.5));
    fields.finish();
    if (byName_.contains(name)) {
      diagnostics_.error(Code::duplicateMaterial, place, fmt::format("a second material '{}'", name)).hint =
          "rename it; the library has one of this name";
      return byName_[name];
    }
    return add(std::move(material));
  }

  // A name of a known material.
  MaterialId findMaterial(const JsonValue& value, const std::string& what) {
    const auto name = base::readText(value, what, diagnostics_);
    if (!name) return {};
    if (const auto found = byName_.find(*name); found != byName_.end()) return found->second;
    if (unread_) return {};  // it may be one of a library that could not be read
    std::vector<std::string> names;
    for (const auto& [known, id] : byName_) names.push_back(known);
    fail(Code::unknownMaterial, value, fmt::format("unknown material '{}'", *name)).hint =
        names.empty() ? "name a \"library\", or define it under \"materials\""
                      : base::nearestHint(*name, names);
    return {};
  }

  void readGrid(const JsonValue& value) {
    JsonFields fields(value, "the grid", Code::badSceneValue, diagnostics_);
    fields.require({"count", "materials"});
    const auto count = fields.triple("count", kGridCount);
    const float spacing = static_cast<float>(fields.number("spacing", kSize).value_or(2.5));
    const glm::vec3 center = toVec3(fields.triple("center", kWorld).value_or(std::array<double, 3>{}));
    Sphere sphere;
    sphere.radius = static_cast<float>(fields.number("radius", kSize).value_or(1));
    sphere.velocity = toVec3(fields.triple("velocity", kWorld).value_or(std::array<double, 3>{}));
    sphere.lists = readLists(fields, "the grid", diagnostics_).value_or(maskOf(DrawList::spheres));
    const JsonValue* materials = fields.find("materials");
    fields.finish();

    std::vector<MaterialId> ids;
    if (!choice_.materials.empty()) {
      ids = readLibraryFile(choice_.materials, value);
    } else if (materials && materials->is(JsonValue::Type::array)) {
      if (materials->items.empty()) fail(Code::unknownMaterial, *materials, "the grid names no material");
      for (const JsonValue& item : materials->items)
        ids.push_back(findMaterial(item, "a material of the grid"));
    } else if (materials) {
      ids = readLibrary(*materials, "'materials' of the grid");
    }
    if (!count || ids.empty()) return;
    const double total = (*count)[0] * (*count)[1] * (*count)[2];
    if (total > kMaxSpheres) {
      base::Diagnostic& d = fail(Code::badSceneValue, *value.find("count"), "the grid has too many spheres");
      d.expected = fmt::format("at most {} in all", kMaxSpheres);
      d.found = fmt::format("{}", total);
      return;
    }
    const std::array<int, 3> n = {static_cast<int>((*count)[0]), static_cast<int>((*count)[1]),
                                  static_cast<int>((*count)[2])};
    scene_.spheres.reserve(scene_.spheres.size() + static_cast<std::size_t>(total));
    std::size_t index = 0;
    const auto offset = [&](int i, int axis) {
      return (static_cast<float>(i) - static_cast<float>(n[static_cast<std::size_t>(axis)] - 1) / 2) *
             spacing;
    };
    for (int z = 0; z < n[2]; ++z)
      for (int y = 0; y < n[1]; ++y)
        for (int x = 0; x < n[0]; ++x) {
          sphere.center = center + glm::vec3(offset(x, 0), -offset(y, 1), -offset(z, 2));
          sphere.material = ids[index++ % ids.size()];
          scene_.spheres.add(sphere);
        }
  }

  void readSphere(const JsonValue& value, std::size_t index) {
    const std::string what = fmt::format("sphere {}", index);
    JsonFields fields(value, what, Code::badSceneValue, diagnostics_);
    fields.require({"center", "material"});
    Sphere sphere;
    sphere.center = toVec3(fields.triple("center", kWorld).value_or(std::array<double, 3>{}));
    sphere.radius = static_cast<float>(fields.number("radius", kSize).value_or(1));
    sphere.velocity = toVec3(fields.triple("velocity", kWorld).value_or(std::array<double, 3>{}));
    sphere.lists = readLists(fields, what, diagnostics_).value_or(maskOf(DrawList::spheres));
    if (const JsonValue* material = fields.find("material"))
      sphere.material = material->is(JsonValue::Type::object)
                            ? addMaterial("", *material, material->place)
                            : findMaterial(*material, fmt::format("'material' of {}", what));
    fields.finish();
    scene_.spheres.add(sphere);
  }

  // The chosen one first.
  void readCameras(const JsonValue& cameras) {
    for (const JsonMember& member : cameras.members)
      if (member.key == choice_.camera) readCamera(member.key, member.value);
    for (const JsonMember& member : cameras.members)
      if (member.key != choice_.camera) readCamera(member.key, member.value);
  }

  void failCamera(const JsonValue& where) {
    std::vector<std::string> names;
    for (const Camera& camera : scene_.cameras.rows()) names.push_back(camera.name);
    fail(Code::badSceneValue, where, fmt::format("the scene has no camera '{}'", choice_.camera)).hint =
        names.empty() ? "name one under \"cameras\"" : base::nearestHint(choice_.camera, names);
  }

  void readCamera(const std::string& name, const JsonValue& value) {
    const std::string what = fmt::format("camera '{}'", name);
    JsonFields fields(value, what, Code::badSceneValue, diagnostics_);
    Camera camera{.name = name};
    if (const auto position = fields.triple("position", kWorld)) camera.pose.position = toDvec3(*position);
    if (const auto target = fields.triple("target", kWorld)) camera.pose.target = toDvec3(*target);
    camera.pose.fovDegrees = fields.number("fov", kFov).value_or(60);
    camera.pose.nearPlane = fields.number("near", kSize).value_or(0.1);
    camera.orbitDegreesPerSecond = fields.number("orbit", kWorld).value_or(0);
    const JsonValue* path = fields.array("path");
    if (!path) fields.require({"position"});
    fields.finish();
    if (!path) checkDirection(value, what, camera.pose.position, camera.pose.target);
    if (path && camera.orbitDegreesPerSecond != 0)
      fail(Code::badSceneValue, *path, fmt::format("{} has both 'path' and 'orbit'", what)).hint = "keep one";
    if (path) readPath(*path, what, camera);
    scene_.cameras.add(std::move(camera));
  }

  void checkDirection(const JsonValue& value, const std::string& what, glm::dvec3 position,
                      glm::dvec3 target) {
    if (glm::length(position - target) < 1e-6)
      fail(Code::badSceneValue, value, fmt::format("{} stands on its target", what)).hint =
          "move 'position' or 'target'";
  }

  void readPath(const JsonValue& path, const std::string& what, Camera& camera) {
    if (path.items.empty()) fail(Code::badSceneValue, path, fmt::format("the path of {} is empty", what));
    for (std::size_t i = 0; i < path.items.size(); ++i) {
      const std::string keyName = fmt::format("key {} of {}", i, what);
      JsonFields fields(path.items[i], keyName, Code::badSceneValue, diagnostics_);
      fields.require({"time", "position"});
      CameraKey key{.target = camera.pose.target, .fovDegrees = camera.pose.fovDegrees};
      key.time = fields.number("time", kWorld).value_or(0);
      if (const auto position = fields.triple("position", kWorld)) key.position = toDvec3(*position);
      if (const auto target = fields.triple("target", kWorld)) key.target = toDvec3(*target);
      if (const auto fov = fields.number("fov", kFov)) key.fovDegrees = *fov;
      fields.finish();
      checkDirection(path.items[i], keyName, key.position, key.target);
      if (!camera.path.empty() && key.time <= camera.path.back().time)
        fail(Code::badSceneValue, path.items[i],
             fmt::format("{} is not later than the one before it", keyName));
      camera.path.push_back(key);
    }
    if (camera.path.empty()) return;
    camera.pose.position = camera.path.front().position;
    camera.pose.target = camera.path.front().target;
    camera.pose.fovDegrees = camera.path.front().fovDegrees;
  }

  const std::string name_;
  Diagnostics& diagnostics_;
  const SceneChoice& choice_;
  Scene scene_;
  std::map<std::string, MaterialId> byName_;
  std::map<std::string, std::vector<MaterialId>> libraries_;  // by path
  bool unread_ = false;                                       // one of them could not be read
  SceneModels models_;
};

}  // namespace

namespace {

// `camera` becomes the first one. False when there is none of that name.
bool putFirst(Scene& scene, const std::string& camera) {
  const Camera* chosen = findCamera(scene, camera);
  if (!chosen) return false;
  Table<Camera> cameras;
  cameras.add(*chosen);
  for (const Camera& each : scene.cameras.rows())
    if (&each != chosen) cameras.add(each);
  scene.cameras = std::move(cameras);
  return true;
}

std::optional<Scene> loadModelFile(const std::string& path, Diagnostics& diagnostics,
                                   std::vector<std::string>* files, const SceneChoice& choice,
                                   const assets::LoadObserver& observer) {
  std::optional<Scene> scene = loadModelScene(path, diagnostics, files, observer);
  if (!scene) return {};
  const base::Place place{std::make_shared<const std::string>(path)};
  if (!choice.materials.empty()) {
    diagnostics.error(Code::unknownMaterial, place,
                      fmt::format("there is no grid to give the materials of '{}' to", choice.materials));
    return {};
  }
  if (putFirst(*scene, choice.camera)) return scene;
  std::vector<std::string> names;
  for (const Camera& camera : scene->cameras.rows()) names.push_back(camera.name);
  diagnostics.error(Code::badSceneValue, place, fmt::format("the scene has no camera '{}'", choice.camera))
      .hint = base::nearestHint(choice.camera, names);
  return {};
}

}  // namespace

std::optional<Scene> readScene(std::string_view text, const std::string& name, Diagnostics& diagnostics,
                               const SceneChoice& choice) {
  const assets::LoadObserver nobody;
  return Reader(name, diagnostics, choice, nobody).read(text);
}

std::optional<Scene> loadScene(const std::string& path, Diagnostics& diagnostics,
                               std::vector<std::string>* files, const SceneChoice& choice,
                               const assets::LoadObserver& observer) {
  if (files) *files = {path};
  if (assets::isModelName(path)) return loadModelFile(path, diagnostics, files, choice, observer);
  const std::optional<std::string> text = base::readTextFile(path, diagnostics);
  if (!text) return {};
  Reader reader(path, diagnostics, choice, observer);
  std::optional<Scene> scene = reader.read(*text);
  if (files)
    for (const std::string& other : reader.others()) files->push_back(other);
  return scene;
}

bool namesModels(const std::string& path) {
  if (assets::isModelName(path)) return true;
  Diagnostics unsaid;
  const std::optional<std::string> text = base::readTextFile(path, unsaid);
  const auto root = text ? base::parseJson(*text, nullptr, unsaid) : std::nullopt;
  return root && root->find("models") != nullptr;
}

}  // namespace weft::scene
