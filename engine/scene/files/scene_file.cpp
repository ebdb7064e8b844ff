#include "engine/scene/files/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <numbers>
#include <set>
#include <utility>

#include "engine/assets/models/model_file.h"
#include "engine/scene/files/reading.h"
#include "engine/scene/frame/mesh_frame.h"
#include "engine/scene/models/add_model.h"
#include "engine/text/chars.h"
#include "engine/text/files/file.h"
#include "engine/text/nearest.h"
#include "scene_sentences.h"

namespace weft::scene {

using text::Code;
using text::Diagnostics;
using text::JsonMember;
using text::JsonValue;

namespace {

constexpr text::NumberRange kFov{.min = 1, .max = 170};
constexpr text::NumberRange kDegrees{.min = -1e6, .max = 1e6};
constexpr text::NumberRange kSpeed{.min = -1e3, .max = 1e3};
constexpr std::size_t kMaxSpheres = 1 << 24, kMaxNodes = 1 << 21;

float toRadians(double degrees) {
  return static_cast<float>(degrees * std::numbers::pi / 180);
}

// About X, then Y, then Z.
glm::quat rotationOf(glm::dvec3 degrees) {
  return glm::angleAxis(toRadians(degrees[2]), glm::vec3(0, 0, 1)) *
         glm::angleAxis(toRadians(degrees[1]), glm::vec3(0, 1, 0)) *
         glm::angleAxis(toRadians(degrees[0]), glm::vec3(1, 0, 0));
}

constexpr double kFovDegrees = 35, kMargin = 1.08;
constexpr std::pair<const char*, glm::dvec3> kViews[] = {{"front", {0, 0, -1}}, {"left", {1, 0, 0}},
                                                         {"right", {-1, 0, 0}}, {"back", {0, 0, 1}},
                                                         {"top", {0, -1, 0}},   {"bottom", {0, 1, 0}}};
constexpr std::uint32_t kMeasuredCorners = 3 << 20;  // of meshes, at most, to choose a view

// Looks along an axis at the whole of `box`, in a picture that is at least as wide as high.
CameraPose framePose(const Box& box, glm::dvec3 towards) {
  const glm::dvec3 center = (glm::dvec3(box.low) + glm::dvec3(box.high)) * 0.5;
  const glm::dvec3 half = (glm::dvec3(box.high) - glm::dvec3(box.low)) * 0.5;
  const double depth = glm::dot(half, glm::abs(towards));
  const glm::dvec3 across = half * (1.0 - glm::abs(towards));
  const double largest = std::max({across.x, across.y, across.z, depth / 100, 1e-6});
  const double distance = kMargin * largest / std::tan(kFovDegrees / 2 * std::numbers::pi / 180) + depth;
  CameraPose pose;
  pose.target = center;
  pose.position = center - towards * distance;
  pose.fovDegrees = kFovDegrees;
  pose.nearPlane = distance / 1000;
  return pose;
}

Material readMaterial(SceneFields& fields) {
  Material material;
  fields.read("albedo", kUnit, material.albedo);
  fields.read("metallic", kUnit, material.metallic);
  fields.read("roughness", kUnit, material.roughness);
  return material;
}

// A view in numbers, as SceneChoice::camera has it; nothing when it is none.
std::optional<CameraPose> poseOf(const std::string& words, CameraPose pose) {
  double* const numbers[] = {&pose.position.x, &pose.position.y, &pose.position.z, &pose.target.x,
                             &pose.target.y,   &pose.target.z,   &pose.fovDegrees, &pose.nearPlane};
  std::size_t count = 0;
  for (std::size_t at = 0; at <= words.size(); ++count) {
    const std::string word = words.substr(at, words.find(',', at) - at);
    const auto number = text::numberIn<double>(word);
    if (!number || count == std::size(numbers)) return std::nullopt;
    *numbers[count] = *number;
    at += word.size() + 1;
  }
  const bool good = count >= 6 && pose.position != pose.target && pose.fovDegrees > 0 &&
                    pose.fovDegrees < 180 && pose.nearPlane > 0;
  return good ? std::optional(pose) : std::nullopt;
}

class Reader {
 public:
  Reader(const std::string& name, Diagnostics& diagnostics, const SceneChoice& choice,
         const std::stop_token& stop)
      : name_(name), diagnostics_(diagnostics), choice_(choice), stop_(stop) {}

  // Everything that was read or should have been, the scene's own file first.
  const std::vector<std::string>& files() const { return files_; }

  std::optional<Scene> read(std::string_view text) {
    const std::size_t errorsBefore = diagnostics_.errorCount();
    const auto root = text::parseJson(text, name_, diagnostics_);
    if (!root) return {};
    for (const char* key : {"passes", "extends"})
      if (root->find(key)) {
        fail(say::graphAsScene, *root, key, name_);
        return {};
      }
    SceneFields fields(*root, "the scene", Code::badSceneValue, diagnostics_);
    scene_.name = fields.text("name").value_or(std::filesystem::path(name_).stem().string());
    if (const JsonValue* library = fields.find("library")) readLibrary(*library, "'library' of the scene");
    if (const JsonValue* materials = fields.object("materials"))
      for (const JsonMember& member : materials->members) addMaterial(member.key, member.value, member.place);
    const JsonValue* cameras = fields.object("cameras");
    if (cameras)
      for (const JsonMember& member : cameras->members) readCamera(member.key, member.value);
    chooseCamera(cameras ? *cameras : *root, choice_.camera);
    if (scene_.cameras.size() == 0) scene_.cameras.add({.name = "default", .pose = {.position = {0, 0, 20}}});
    const JsonValue* grid = fields.find("grid");
    if (grid) readGrid(*grid);
    if (!grid && !choice_.materials.empty()) failNoGrid(*root);
    if (const JsonValue* spheres = fields.array("spheres"))
      for (std::size_t i = 0; i < spheres->items.size(); ++i) readSphere(spheres->items[i], i);
    readLights(fields, scene_, diagnostics_);
    if (const JsonValue* ground = fields.find("ground")) readGround(*ground);
    if (const JsonValue* models = fields.object("models"))
      for (const JsonMember& member : models->members) readModel(member.key, member.value);
    fields.finish();
    if (diagnostics_.errorCount() > errorsBefore || modelMissing_) return {};
    return finish();
  }

  // A model file as a scene: the model at its own coordinates with its first animation, cameras that frame its box (kViews), the
  // first of which that sees its surface is the default, those of the file, and its lights.
  std::optional<Scene> readModelFile() {
    JsonValue whole;
    whole.place.file = name_;
    scene_.name = std::filesystem::path(name_).stem().string();
    const Loaded* loaded = load(name_);
    if (!loaded) return {};
    if (loaded->model.lights.size() > kMaxLamps) {
      fail(say::tooManyInAll, whole, fmt::format("the model '{}' has too many lights", name_), kMaxLamps,
           fmt::format("{}", loaded->model.lights.size()), "");
      return {};
    }
    ModelCopy copy;
    copy.root.name = loaded->model.name;
    copy.labels = addLabels(scene_, loaded->model, scene_.name, {});
    if (!loaded->model.animations.empty()) copy.animation = 0;
    const std::vector<NodeId> nodes = addModelCopy(scene_, loaded->rows, loaded->model, copy);
    MeshFrame frame;
    frame.update(scene_, 1, 0, 0);
    const Box box = frame.sceneBounds();
    const std::vector<double> seen = surfaceSeen(frame);
    const double most = *std::ranges::max_element(seen);
    const glm::dvec3 size(box.high - box.low), sides(size.y * size.z, size.z * size.x, size.x * size.y);
    std::string first;  // that shows more than an edge of it, and of its box
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (first.empty() && seen[i] >= 0.02 * most &&
          glm::dot(sides, glm::abs(kViews[i].second)) >= 0.06 * std::max({sides.x, sides.y, sides.z}))
        first = kViews[i].first;
      if (std::ranges::find(loaded->model.cameras, kViews[i].first, &assets::ModelCamera::name) ==
          loaded->model.cameras.end())
        scene_.cameras.add({.name = kViews[i].first, .pose = framePose(box, kViews[i].second)});
    }
    addCameras(loaded->model, nodes, box);
    if (!choice_.materials.empty()) {
      failNoGrid(whole);
      return {};
    }
    return chooseCamera(whole, choice_.camera.empty() ? first : choice_.camera) ? std::optional(finish())
                                                                                : std::nullopt;
  }

 private:
  // How much of the meshes' surface turns towards each of kViews; of skinned ones as they lie in the file.
  std::vector<double> surfaceSeen(const MeshFrame& frame) const {
    std::vector<double> seen(std::size(kViews), 0);
    std::uint32_t corners = 0;
    for (const DrawList list : {DrawList::opaque, DrawList::transparent, DrawList::transmissive})
      for (const MeshRow& row : frame.rows(list)) {
        const Mesh& mesh = scene_.meshes.rows()[row.mesh];
        const bool both = scene_.materials.rows()[row.material].doubleSided;
        for (std::uint32_t i = 0; i + 2 < mesh.indexCount && corners < kMeasuredCorners;
             i += 3, corners += 3) {
          const auto at = [&](std::uint32_t corner) {
            const std::uint32_t v = mesh.firstVertex + data_->indices[mesh.firstIndex + i + corner];
            return glm::dvec3(row.transform * glm::vec4(data_->vertices[v].position, 1));
          };
          const glm::dvec3 normal = glm::cross(at(1) - at(0), at(2) - at(0));
          for (std::size_t view = 0; view < seen.size(); ++view) {
            const double facing = -glm::dot(normal, kViews[view].second);
            seen[view] += both ? std::abs(facing) : std::max(facing, 0.0);
          }
        }
      }
    return seen;
  }

  // The cameras of a model as they stand at the beginning. `box`: of the model.
  void addCameras(const assets::Model& model, const std::vector<NodeId>& nodes, const Box& box) {
    WorldTransforms transforms;
    transforms.update(scene_, 1, 0, 0);
    for (const assets::ModelCamera& from : model.cameras) {
      const NodeId node = nodes[from.node];
      const glm::mat4 world = node.valid() ? transforms.now()[node.index] : glm::mat4(1);
      Camera camera{.name = from.name};
      const glm::dvec3 towards(turnDirection(world, {0, 0, -1}));
      // What it looks at: the model's center, or what it has before the camera.
      double ahead = glm::dot(glm::dvec3(box.center()) - glm::dvec3(world[3]), towards);
      if (ahead <= 0) ahead += glm::dot(glm::dvec3(box.high - box.low) * 0.5, glm::abs(towards));
      camera.pose.position = glm::dvec3(world[3]);
      camera.pose.target = camera.pose.position + towards * std::max(ahead, 10 * from.nearPlane);
      camera.pose.up = glm::dvec3(turnDirection(world, {0, 1, 0}));
      camera.pose.fovDegrees = from.fovDegrees;
      camera.pose.nearPlane = from.nearPlane;
      camera.pose.height = from.height;
      if (node.valid() && transforms.isMoving(node.index))
        diagnostics_.warning(say::cameraMotionLeftOut, {name_}, from.name);
      scene_.cameras.add(std::move(camera));
    }
  }

  template <class... Args>
  void fail(text::Saying<Args...> what, const JsonValue& value, Args&&... args) {
    diagnostics_.error<Args...>(what, value.place, std::forward<Args>(args)...);
  }

  // Of a file that the scene names.
  std::string pathOf(const std::string& file) const {
    return (std::filesystem::path(name_).parent_path() / file).lexically_normal().string();
  }

  void failNoGrid(const JsonValue& where) { fail(say::materialsWithoutGrid, where, choice_.materials); }

  Scene finish() {
    scene_.files = files_;
    if (!data_->vertices.empty()) scene_.meshData = data_;
    return std::move(scene_);
  }

  // The chosen camera becomes the first one. False after W160: there is none of that name.
  bool chooseCamera(const JsonValue& where, const std::string& name) {
    std::vector<Camera> cameras(scene_.cameras.rows().begin(), scene_.cameras.rows().end());
    if (name.empty()) return true;
    if (const auto pose = poseOf(name, cameras.empty() ? CameraPose{} : cameras.front().pose))
      cameras.push_back({.name = name, .pose = *pose});
    const auto chosen = std::ranges::find(cameras, name, &Camera::name);
    if (chosen == cameras.end()) {
      std::vector<std::string> names;
      for (const Camera& camera : cameras) names.push_back(camera.name);
      fail(say::unknownCamera, where, name,
           names.empty() ? "name one under \"cameras\"" : text::nearestHint(name, names));
      return false;
    }
    std::rotate(cameras.begin(), chosen, chosen + 1);
    scene_.cameras = {};
    for (Camera& camera : cameras) scene_.cameras.add(std::move(camera));
    return true;
  }

  void readGround(const JsonValue& value) {
    SceneFields fields(value, "the ground", Code::badSceneValue, diagnostics_);
    Ground ground;
    fields.read("height", kWorld, ground.height);
    fields.read("radius", kSize, ground.radius);
    if (fields.find("albedo"))
      fields.read("albedo", kUnit, ground.albedo.emplace());
    else if (const JsonValue* radius = fields.find("radius"))
      fail(say::radiusWithoutSurface, *radius);
    fields.finish();
    scene_.ground = ground;
  }

  // The first of a name, after an error, where it is known already.
  MaterialId add(Material material, const text::Place& place, std::string_view found, std::string_view hint) {
    const std::string name = material.name;
    if (byName_.contains(name)) {
      diagnostics_.error(say::secondMaterialOfScene, place, name, found, hint);
      return byName_[name];
    }
    const MaterialId id = scene_.materials.add(std::move(material));
    if (!name.empty()) byName_.emplace(name, id);
    return id;
  }

  // The presets of the library file that `value` names, each added to the scene once.
  std::vector<MaterialId> readLibrary(const JsonValue& value, const std::string& what) {
    const auto given = text::readText(value, what, diagnostics_);
    if (!given) return {};
    return readLibraryFile(pathOf(*given), value);
  }

  std::vector<MaterialId> readLibraryFile(const std::string& path, const JsonValue& value) {
    if (const auto known = libraries_.find(path); known != libraries_.end()) return known->second;
    std::vector<MaterialId>& ids = libraries_[path];
    const auto text = text::readTextFile(path, diagnostics_, Code::unreadableFile, value.place);
    files_.push_back(path);
    auto library = text ? readMaterialLibrary(*text, path, diagnostics_) : std::nullopt;
    libraryMissing_ = libraryMissing_ || !library;
    if (!library) return {};
    if (library->empty()) fail(say::emptyLibrary, value, path);
    for (Material& preset : *library)
      ids.push_back(add(std::move(preset), value.place, fmt::format("one of '{}'", path), ""));
    return ids;
  }

  MaterialId addMaterial(const std::string& name, const JsonValue& value, const text::Place& place) {
    SceneFields fields(value, name.empty() ? "a material" : fmt::format("material '{}'", name),
                       Code::badMaterialValue, diagnostics_);
    fields.require({"albedo"});
    Material material = readMaterial(fields);
    material.name = name;
    fields.finish();
    return add(std::move(material), place, "", "rename it; the library has one of this name");
  }

  // A name of a known material.
  MaterialId findMaterial(const JsonValue& value, const std::string& what) {
    const auto name = text::readText(value, what, diagnostics_);
    if (!name) return {};
    if (const auto found = byName_.find(*name); found != byName_.end()) return found->second;
    if (libraryMissing_) return {};  // it may be one of a library that could not be read
    std::vector<std::string> names;
    for (const auto& [known, id] : byName_) names.push_back(known);
    fail(say::unknownMaterial, value, *name,
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
    Label label;
    if (const auto name = fields.text("name")) label.names.push_back(*name);
    label.tags = readTags(fields, what, diagnostics_);
    if (label != Label{}) sphere.label = scene_.labels.add(std::move(label));
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
      if (materials->items.empty()) fail(say::gridNamesNoMaterial, *materials);
      for (const JsonValue& item : materials->items)
        ids.push_back(findMaterial(item, "a material of the grid"));
    } else if (materials) {
      ids = readLibrary(*materials, "'materials' of the grid");
    }
    if (grid.total() == 0 || ids.empty()) return;
    if (grid.total() > static_cast<double>(kMaxSpheres))
      return fail(say::tooManyInAll, *value.find("count"), "the grid has too many spheres", kMaxSpheres,
                  fmt::format("{}", grid.total()), "");
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
    if (path && camera.orbitDegreesPerSecond != 0) fail(say::pathAndOrbit, *path, what);
    if (path) readPath(*path, what, camera);
    scene_.cameras.add(std::move(camera));
  }

  void checkDirection(const JsonValue& value, const std::string& what, glm::dvec3 position,
                      glm::dvec3 target) {
    if (glm::length(position - target) < 1e-6) fail(say::standsOnTarget, value, what);
  }

  void readPath(const JsonValue& path, const std::string& what, Camera& camera) {
    if (path.items.empty()) return fail(say::pathEmpty, path, what);
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
        fail(say::notLater, path.items[i], keyName);
      camera.path.push_back(key);
    }
    camera.pose.position = camera.path.front().position;
    camera.pose.target = camera.path.front().target;
    camera.pose.fovDegrees = camera.path.front().fovDegrees;
  }

  // --- models: a file that several entries name is read once

  struct Loaded {
    assets::Model model;
    ModelRows rows;
  };

  // `named`: what the scene names it by; null: the command line does.
  const Loaded* load(const std::string& path, const JsonValue* named = nullptr) {
    const auto [known, isNew] = models_.try_emplace(path);
    std::unique_ptr<Loaded>& loaded = known->second;
    if (!isNew) return loaded.get();
    std::vector<std::string> files;
    text::Diagnostics said;
    std::optional<assets::Model> model = assets::loadModel(path, said, stop_, &files);
    for (text::Diagnostic each : said.items()) {
      if (named && each.place.line == 0) each.place = named->textPlace();
      diagnostics_.add(std::move(each));
    }
    for (std::string& file : files)
      if (std::ranges::find(files_, file) == files_.end()) files_.push_back(std::move(file));
    modelMissing_ = modelMissing_ || !model;
    if (!model) return nullptr;
    loaded = std::make_unique<Loaded>(Loaded{std::move(*model), {}});
    loaded->rows = addModelTables(scene_, *data_, loaded->model);
    return loaded.get();
  }

  void readModel(const std::string& name, const JsonValue& value) {
    const std::string what = fmt::format("model '{}'", name);
    SceneFields fields(value, what, Code::badSceneValue, diagnostics_);
    fields.require({"file"});
    ModelCopy copy;
    Node& root = copy.root;
    SceneGrid grid;
    glm::dvec3 rotation(0);
    float scale = 1;
    double spin = 0;
    fields.read("position", kWorld, grid.center);
    fields.read("rotation", kDegrees, rotation);
    fields.read("scale", kSize, scale);
    fields.read("spin", kDegrees, spin);
    fields.read("velocity", kWorld, root.velocity);
    root.local.rotation = rotationOf(rotation);
    root.local.scale = glm::vec3(scale);
    root.spin = {0, toRadians(spin), 0};
    copy.lists = readLists(fields, what, diagnostics_);
    const std::vector<std::string> tags = readTags(fields, what, diagnostics_);
    fields.read("speed", kSpeed, copy.speed);
    fields.read("lights", copy.lights);
    fields.read("lamp_shadows", copy.lampShadows);
    const auto file = fields.text("file");
    if (!fields.find("count")) grid.count = {1, 1, 1};
    grid.read(fields);
    if (const JsonValue* material = fields.find("material"))
      copy.material = materialOf(*material, fmt::format("'material' of {}", what));
    const JsonValue* animation = fields.find("animation");
    fields.finish();
    if (!file || grid.total() == 0) return;
    const Loaded* loaded = load(pathOf(*file), fields.find("file"));
    if (!loaded) return;
    if (animation) readAnimation(*animation, what, loaded->model, copy);
    if (copy.material && !scene_.materials.find(*copy.material)) return;
    copy.labels = addLabels(scene_, loaded->model, name, tags);
    addCopies(value, name, *loaded, std::move(copy), grid);
  }

  void readAnimation(const JsonValue& value, const std::string& what, const assets::Model& model,
                     ModelCopy& copy) {
    std::vector<std::string> names;
    for (const auto& animation : model.animations) names.push_back(animation->name);
    std::size_t row = names.size();
    if (value.is(JsonValue::Type::number)) {
      if (value.whole && value.number >= 0 && value.number < static_cast<double>(row))
        row = static_cast<std::size_t>(value.number);
    } else if (const auto name =
                   text::readText(value, fmt::format("'animation' of {}", what), diagnostics_)) {
      row = static_cast<std::size_t>(std::ranges::find(names, *name) - names.begin());
    } else {
      return;
    }
    if (row < names.size()) {
      copy.animation = static_cast<std::uint32_t>(row);
      return;
    }
    fail(say::unknownAnimation, value, what,
         names.empty() ? "none: its file has no animation" : fmt::format("{}", fmt::join(names, ", ")),
         describe(value), value.is(JsonValue::Type::string) ? text::nearestHint(value.text, names) : "");
  }

  void addCopies(const JsonValue& value, const std::string& name, const Loaded& loaded, ModelCopy copy,
                 const SceneGrid& grid) {
    const assets::Model& model = loaded.model;
    const double total = grid.total();
    const auto suns = static_cast<std::size_t>(
        std::ranges::count(model.lights, assets::ModelLightKind::sun, &assets::ModelLight::kind));
    std::size_t each = 1 + std::max(model.nodes.size(), model.instances.size());
    for (const assets::ModelNode& node : model.nodes) each += node.weights.size();
    const double rows = total * static_cast<double>(each),
                 lamps = copy.lights ? total * static_cast<double>(model.lights.size() - suns) : 0;
    if (rows + static_cast<double>(scene_.nodes.size()) > static_cast<double>(kMaxNodes))
      return fail(say::tooManyInAll, value, fmt::format("with model '{}' the scene has too many nodes", name),
                  kMaxNodes, fmt::format("{} copies of {} nodes, instances or animated weights", total, each),
                  "");
    if (lamps + static_cast<double>(scene_.lamps.size()) > static_cast<double>(kMaxLamps))
      return fail(say::tooManyInAll, value, fmt::format("with model '{}' the scene has too many lamps", name),
                  kMaxLamps, fmt::format("{} copies of {} lamps", total, model.lights.size() - suns),
                  "leave them out: \"lights\": false");
    const bool sunny = copy.lights && suns > 0;  // a sun of the scene file takes the place of all
    if (sunny && !sunOf_.empty()) diagnostics_.warning(say::sunLeftOut, value.place, name, sunOf_);
    if (sunny && !scene_.sun) sunOf_ = name;
    grid.forEach([&](std::size_t index, glm::vec3 place) {
      copy.root.name = total > 1 ? fmt::format("{}[{}]", name, index) : name;
      copy.root.local.translation = place;
      addModelCopy(scene_, loaded.rows, model, copy);
    });
  }

  const std::string name_;
  Diagnostics& diagnostics_;
  const SceneChoice& choice_;
  const std::stop_token& stop_;
  Scene scene_;
  std::vector<std::string> files_{name_};
  std::map<std::string, MaterialId> byName_;
  std::map<std::string, std::vector<MaterialId>> libraries_;  // by path
  bool libraryMissing_ = false;
  std::map<std::string, std::unique_ptr<Loaded>> models_;  // by path; null: it failed
  bool modelMissing_ = false;                              // after errors, or because the load was stopped
  std::shared_ptr<MeshData> data_ = std::make_shared<MeshData>();
  std::string sunOf_;  // the model that gave the scene its sun
};

}  // namespace

std::optional<std::vector<Material>> readMaterialLibrary(std::string_view text, const std::string& name,
                                                         Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errorCount();
  const auto root = text::parseJson(text, name, diagnostics);
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
      diagnostics.error(say::secondMaterial, item.place, material.name);
    materials.push_back(std::move(material));
  }
  if (diagnostics.errorCount() > before) return {};
  return materials;
}

std::optional<Scene> loadScene(const std::string& path, Diagnostics& diagnostics,
                               std::vector<std::string>* files, const SceneChoice& choice,
                               const std::stop_token& stop) {
  Reader reader(path, diagnostics, choice, stop);
  std::optional<Scene> scene;
  if (assets::isModelName(path))
    scene = reader.readModelFile();
  else if (const auto text = text::readTextFile(path, diagnostics))
    scene = reader.read(*text);
  if (files) *files = reader.files();
  return scene;
}

bool namesModels(const std::string& path) {
  if (assets::isModelName(path)) return true;
  Diagnostics unsaid;
  const std::optional<std::string> text = text::readTextFile(path, unsaid);
  const auto root = text ? text::parseJson(*text, {}, unsaid) : std::nullopt;
  return root && root->find("models") != nullptr;
}

}  // namespace weft::scene
