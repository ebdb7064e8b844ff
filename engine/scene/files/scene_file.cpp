#include "engine/scene/files/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <set>

#include "engine/assets/models/model_file.h"
#include "engine/scene/files/models.h"
#include "engine/scene/files/reading.h"
#include "engine/text/files/text_file.h"
#include "engine/text/nearest.h"

namespace weft::scene {

using text::Code;
using text::Diagnostics;
using text::JsonMember;
using text::JsonValue;

namespace {

constexpr text::NumberRange kFov{.min = 1, .max = 170};
constexpr std::size_t kMaxSpheres = 1 << 24;

void failNoGrid(const SceneChoice& choice, const JsonValue& where, Diagnostics& diagnostics) {
  failAt(diagnostics, Code::unknownMaterial, where,
         fmt::format("there is no grid to give the materials of '{}' to", choice.materials));
}

// The chosen camera becomes the first one. False after W160: there is none of that name.
bool chooseCamera(Scene& scene, const SceneChoice& choice, const JsonValue& where, Diagnostics& diagnostics) {
  std::vector<Camera> cameras(scene.cameras.rows().begin(), scene.cameras.rows().end());
  const auto chosen =
      choice.camera.empty() ? cameras.begin() : std::ranges::find(cameras, choice.camera, &Camera::name);
  if (chosen == cameras.end() && !choice.camera.empty()) {
    std::vector<std::string> names;
    for (const Camera& camera : cameras) names.push_back(camera.name);
    failAt(diagnostics, Code::badSceneValue, where,
           fmt::format("the scene has no camera '{}'", choice.camera),
           names.empty() ? "name one under \"cameras\"" : text::nearestHint(choice.camera, names));
    return false;
  }
  if (chosen != cameras.begin()) {
    std::rotate(cameras.begin(), chosen, chosen + 1);
    scene.cameras = {};
    for (Camera& camera : cameras) scene.cameras.add(std::move(camera));
  }
  return true;
}

Material readMaterial(SceneFields& fields) {
  Material material;
  fields.read("albedo", kUnit, material.albedo);
  fields.read("metallic", kUnit, material.metallic);
  fields.read("roughness", kUnit, material.roughness);
  return material;
}

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
    const text::PointerScope pointers(name_, text, diagnostics_);
    const auto root = text::parseJson(text, std::make_shared<const std::string>(name_), diagnostics_);
    if (!root) return {};
    for (const char* key : {"passes", "extends"})
      if (root->find(key)) {
        fail(Code::wrongType, *root, fmt::format("this file has \"{}\": it is a graph, not a scene", key),
             fmt::format("a graph stands without --scene: weft render {} --scene SCENE", name_))
            .expected = "a scene, with \"cameras\", \"grid\", \"spheres\", \"models\", \"sun\" or \"lamps\"";
        return {};
      }
    scene_.files.push_back(name_);
    SceneFields fields(*root, "the scene", Code::badSceneValue, diagnostics_);
    scene_.name = fields.text("name").value_or(std::filesystem::path(name_).stem().string());
    if (const JsonValue* library = fields.find("library")) readLibrary(*library, "'library' of the scene");
    if (const JsonValue* materials = fields.object("materials"))
      for (const JsonMember& member : materials->members) addMaterial(member.key, member.value, member.place);
    const JsonValue* cameras = fields.object("cameras");
    if (cameras)
      for (const JsonMember& member : cameras->members) readCamera(member.key, member.value);
    chooseCamera(scene_, choice_, cameras ? *cameras : *root, diagnostics_);
    if (scene_.cameras.size() == 0) scene_.cameras.add({.name = "default", .pose = {.position = {0, 0, 20}}});
    const JsonValue* grid = fields.find("grid");
    if (grid) readGrid(*grid);
    if (!grid && !choice_.materials.empty()) failNoGrid(choice_, *root, diagnostics_);
    if (const JsonValue* spheres = fields.array("spheres"))
      for (std::size_t i = 0; i < spheres->items.size(); ++i) readSphere(spheres->items[i], i);
    readLights(fields, scene_, diagnostics_);
    if (const JsonValue* ground = fields.find("ground")) readGround(*ground);
    models_.read(fields,
                 [this](const JsonValue& value, const std::string& what) { return materialOf(value, what); });
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
  text::Diagnostic& fail(Code code, const JsonValue& value, std::string message, std::string hint = "") {
    return failAt(diagnostics_, code, value, std::move(message), std::move(hint));
  }

  void readGround(const JsonValue& value) {
    SceneFields fields(value, "the ground", Code::badSceneValue, diagnostics_);
    Ground ground;
    fields.read("height", kWorld, ground.height);
    fields.read("radius", kSize, ground.radius);
    if (fields.find("albedo")) fields.read("albedo", kUnit, ground.albedo.emplace());
    if (fields.find("radius") && !fields.find("albedo")) {
      text::Diagnostic& d =
          fail(Code::badSceneValue, *fields.find("radius"), "the ground has a radius but no surface",
               "give it an \"albedo\", or leave \"radius\" out");
      d.expected = "an albedo beside it";
      d.found = "a ground that shows the environment, which ends nowhere";
    }
    fields.finish();
    scene_.ground = ground;
  }

  MaterialId add(Material material) {
    const std::string name = material.name;
    const MaterialId id = scene_.materials.add(std::move(material));
    if (!name.empty()) byName_.emplace(name, id);
    return id;
  }

  // The presets of the library file that `value` names, each added to the scene once.
  std::vector<MaterialId> readLibrary(const JsonValue& value, const std::string& what) {
    const auto given = text::readText(value, what, diagnostics_);
    if (!given) return {};
    return readLibraryFile((std::filesystem::path(name_).parent_path() / *given).lexically_normal().string(),
                           value);
  }

  std::vector<MaterialId> readLibraryFile(const std::string& path, const JsonValue& value) {
    if (const auto known = libraries_.find(path); known != libraries_.end()) return known->second;
    std::vector<MaterialId>& ids = libraries_[path];
    const auto text = text::readTextFile(path, diagnostics_, Code::unreadableFile, value.place);
    if (text) scene_.files.push_back(path);
    auto library = text ? readMaterialLibrary(*text, path, diagnostics_) : std::nullopt;
    unread_ = unread_ || !library;
    if (!library) return {};
    if (library->empty())
      fail(Code::unknownMaterial, value, fmt::format("the material library '{}' is empty", path));
    for (Material& preset : *library) {
      if (byName_.contains(preset.name)) {
        fail(Code::duplicateMaterial, value,
             fmt::format("a second material '{}', from '{}'", preset.name, path));
        continue;
      }
      ids.push_back(add(std::move(preset)));
    }
    return ids;
  }

  MaterialId addMaterial(const std::string& name, const JsonValue& value, const text::Place& place) {
    SceneFields fields(value, name.empty() ? "a material" : fmt::format("material '{}'", name),
                       Code::badMaterialValue, diagnostics_);
    fields.require({"albedo"});
    Material material = readMaterial(fields);
    material.name = name;
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
    const auto name = text::readText(value, what, diagnostics_);
    if (!name) return {};
    if (const auto found = byName_.find(*name); found != byName_.end()) return found->second;
    if (unread_) return {};  // it may be one of a library that could not be read
    std::vector<std::string> names;
    for (const auto& [known, id] : byName_) names.push_back(known);
    fail(Code::unknownMaterial, value, fmt::format("unknown material '{}'", *name),
         names.empty() ? "name a \"library\", or define it under \"materials\""
                       : text::nearestHint(*name, names));
    return {};
  }

  // A name, or a material of its own.
  MaterialId materialOf(const JsonValue& value, const std::string& what) {
    return value.is(JsonValue::Type::object) ? addMaterial("", value, value.place)
                                             : findMaterial(value, what);
  }

  // What a sphere has in common with those of a grid.
  Sphere sphereOf(SceneFields& fields, const std::string& what) {
    Sphere sphere;
    fields.read("radius", kSize, sphere.radius);
    fields.read("velocity", kWorld, sphere.velocity);
    sphere.lists = readLists(fields, what, diagnostics_).value_or(sphere.lists);
    return sphere;
  }

  void readGrid(const JsonValue& value) {
    SceneFields fields(value, "the grid", Code::badSceneValue, diagnostics_);
    fields.require({"count", "materials"});
    SceneGrid grid;
    grid.read(fields);
    fields.read("center", kWorld, grid.center);
    Sphere sphere = sphereOf(fields, "the grid");
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
    if (grid.total() == 0 || ids.empty()) return;
    if (grid.total() > static_cast<double>(kMaxSpheres))
      return failTooMany(diagnostics_, *value.find("count"), "the grid has too many spheres", kMaxSpheres,
                         fmt::format("{}", grid.total()));
    scene_.spheres.reserve(scene_.spheres.size() + static_cast<std::size_t>(grid.total()));
    grid.forEach([&](std::size_t index, glm::vec3 place) {
      sphere.center = place;
      sphere.material = ids[index % ids.size()];
      scene_.spheres.add(sphere);
    });
  }

  void readSphere(const JsonValue& value, std::size_t index) {
    const std::string what = fmt::format("sphere {}", index);
    SceneFields fields(value, what, Code::badSceneValue, diagnostics_);
    fields.require({"center", "material"});
    Sphere sphere = sphereOf(fields, what);
    fields.read("center", kWorld, sphere.center);
    if (const JsonValue* material = fields.find("material"))
      sphere.material = materialOf(*material, fmt::format("'material' of {}", what));
    fields.finish();
    scene_.spheres.add(sphere);
  }

  void readCamera(const std::string& name, const JsonValue& value) {
    const std::string what = fmt::format("camera '{}'", name);
    SceneFields fields(value, what, Code::badSceneValue, diagnostics_);
    Camera camera{.name = name};
    fields.read("position", kWorld, camera.pose.position);
    fields.read("target", kWorld, camera.pose.target);
    fields.read("fov", kFov, camera.pose.fovDegrees);
    fields.read("near", kSize, camera.pose.nearPlane);
    fields.read("orbit", kWorld, camera.orbitDegreesPerSecond);
    const JsonValue* path = fields.array("path");
    if (!path) fields.require({"position"});
    fields.finish();
    if (!path) checkDirection(value, what, camera.pose.position, camera.pose.target);
    if (path && camera.orbitDegreesPerSecond != 0)
      fail(Code::badSceneValue, *path, fmt::format("{} has both 'path' and 'orbit'", what), "keep one");
    if (path) readPath(*path, what, camera);
    scene_.cameras.add(std::move(camera));
  }

  void checkDirection(const JsonValue& value, const std::string& what, glm::dvec3 position,
                      glm::dvec3 target) {
    if (glm::length(position - target) < 1e-6)
      fail(Code::badSceneValue, value, fmt::format("{} stands on its target", what),
           "move 'position' or 'target'");
  }

  void readPath(const JsonValue& path, const std::string& what, Camera& camera) {
    if (path.items.empty()) fail(Code::badSceneValue, path, fmt::format("the path of {} is empty", what));
    for (std::size_t i = 0; i < path.items.size(); ++i) {
      const std::string keyName = fmt::format("key {} of {}", i, what);
      SceneFields fields(path.items[i], keyName, Code::badSceneValue, diagnostics_);
      fields.require({"time", "position"});
      CameraKey key{.target = camera.pose.target, .fovDegrees = camera.pose.fovDegrees};
      fields.read("time", kWorld, key.time);
      fields.read("position", kWorld, key.position);
      fields.read("target", kWorld, key.target);
      fields.read("fov", kFov, key.fovDegrees);
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

std::optional<Scene> loadModelFile(const std::string& path, Diagnostics& diagnostics,
                                   std::vector<std::string>* files, const SceneChoice& choice,
                                   const assets::LoadObserver& observer) {
  std::optional<Scene> scene = loadModelScene(path, diagnostics, files, observer);
  JsonValue whole;
  whole.place.file = std::make_shared<const std::string>(path);
  if (scene && !choice.materials.empty()) {
    failNoGrid(choice, whole, diagnostics);
    return {};
  }
  if (!scene || !chooseCamera(*scene, choice, whole, diagnostics)) return {};
  return scene;
}

}  // namespace

std::optional<std::vector<Material>> readMaterialLibrary(std::string_view text, const std::string& name,
                                                         Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errorCount();
  const text::PointerScope pointers(name, text, diagnostics);
  const auto root = text::parseJson(text, std::make_shared<const std::string>(name), diagnostics);
  if (!root || !text::expectType(*root, "a material library", JsonValue::Type::array, diagnostics)) return {};
  std::vector<Material> materials;
  std::set<std::string> names;
  for (const JsonValue& item : root->items) {
    SceneFields fields(item, fmt::format("material {}", materials.size()), Code::badMaterialValue,
                       diagnostics);
    fields.require({"name", "albedo", "metallic", "roughness"});
    Material material = readMaterial(fields);
    material.name = fields.text("name").value_or("");
    for (const char* told : {"category", "source"}) fields.text(told);  // to people
    fields.finish();
    if (!material.name.empty() && !names.insert(material.name).second)
      failAt(diagnostics, Code::duplicateMaterial, item, fmt::format("a second material '{}'", material.name),
             "rename one");
    materials.push_back(std::move(material));
  }
  if (diagnostics.errorCount() > before) return {};
  return materials;
}

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
  const std::optional<std::string> text = text::readTextFile(path, diagnostics);
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
  const std::optional<std::string> text = text::readTextFile(path, unsaid);
  const auto root = text ? text::parseJson(*text, nullptr, unsaid) : std::nullopt;
  return root && root->find("models") != nullptr;
}

}  // namespace weft::scene
