#include "engine/scene/files/models.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "engine/assets/models/model_file.h"
#include "engine/scene/frame/mesh_frame.h"
#include "engine/text/nearest.h"

namespace weft::scene {

using text::Code;
using text::JsonMember;
using text::JsonValue;
using text::NumberRange;

namespace {

constexpr NumberRange kDegrees{.min = -1e6, .max = 1e6};
constexpr NumberRange kSpeed{.min = -1e3, .max = 1e3};

float toRadians(double degrees) {
  return static_cast<float>(degrees * std::numbers::pi / 180);
}

// About X, then Y, then Z.
glm::quat rotationOf(glm::dvec3 degrees) {
  return glm::angleAxis(toRadians(degrees[2]), glm::vec3(0, 0, 1)) *
         glm::angleAxis(toRadians(degrees[1]), glm::vec3(0, 1, 0)) *
         glm::angleAxis(toRadians(degrees[0]), glm::vec3(1, 0, 0));
}

}  // namespace

void SceneModels::read(SceneFields& fields, const FindMaterial& findMaterial) {
  const JsonValue* models = fields.object("models");
  if (!models) return;
  for (const JsonMember& member : models->members) readModel(member.key, member.value, findMaterial);
}

const SceneModels::Loaded* SceneModels::load(const std::string& path) {
  if (const auto known = loaded_.find(path); known != loaded_.end()) return known->second.get();
  std::unique_ptr<Loaded>& loaded = loaded_[path];
  std::vector<std::string> files;
  std::optional<assets::Model> model =
      assets::loadModel(path, diagnostics_, observer_, &files,
                        [](std::size_t count, const auto& decode) { decodeOnThreads(0, count, decode); });
  for (std::string& file : files)
    if (std::ranges::find(files_, file) == files_.end()) files_.push_back(std::move(file));
  failed_ = failed_ || !model;
  if (!model) return nullptr;
  loaded = std::make_unique<Loaded>(Loaded{std::move(*model), {}});
  loaded->rows = addModelTables(scene_, *data_, loaded->model);
  // They are in the scene's arrays now.
  static_cast<MeshData&>(loaded->model) = {};
  return loaded.get();
}

void SceneModels::readModel(const std::string& name, const JsonValue& value,
                            const FindMaterial& findMaterial) {
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
  fields.read("speed", kSpeed, copy.speed);
  fields.read("lights", copy.lights);
  fields.read("lamp_shadows", copy.lampShadows);
  const auto file = fields.text("file");
  if (!fields.find("count")) grid.count = {1, 1, 1};
  grid.read(fields);
  if (const JsonValue* material = fields.find("material"))
    copy.material = findMaterial(*material, fmt::format("'material' of {}", what));
  const JsonValue* animation = fields.find("animation");
  fields.finish();
  if (!file || grid.total() == 0) return;
  const Loaded* loaded =
      load((std::filesystem::path(sceneFile_).parent_path() / *file).lexically_normal().string());
  if (!loaded) return;
  if (animation) readAnimation(*animation, what, loaded->model, copy);
  if (copy.material && !scene_.materials.find(*copy.material)) return;
  addCopies(value, name, *loaded, std::move(copy), grid);
}

void SceneModels::readAnimation(const JsonValue& value, const std::string& what, const assets::Model& model,
                                ModelCopy& copy) {
  std::vector<std::string> names;
  for (const auto& animation : model.animations) names.push_back(animation->name);
  std::size_t row = names.size();
  if (value.is(JsonValue::Type::number)) {
    if (value.whole && value.number >= 0 && value.number < static_cast<double>(row))
      row = static_cast<std::size_t>(value.number);
  } else if (const auto name = text::readText(value, fmt::format("'animation' of {}", what), diagnostics_)) {
    row = static_cast<std::size_t>(std::ranges::find(names, *name) - names.begin());
  } else {
    return;
  }
  if (row < names.size()) {
    copy.animation = static_cast<std::uint32_t>(row);
    return;
  }
  text::Diagnostic& d =
      failAt(diagnostics_, Code::unknownAnimation, value, fmt::format("{} has no such animation", what));
  d.expected = names.empty() ? "none: its file has no animation" : fmt::format("{}", fmt::join(names, ", "));
  d.found = describe(value);
  if (value.is(JsonValue::Type::string)) d.hint = text::nearestHint(value.text, names);
}

void SceneModels::addCopies(const JsonValue& value, const std::string& name, const Loaded& loaded,
                            ModelCopy copy, const SceneGrid& grid) {
  const assets::Model& model = loaded.model;
  const double total = grid.total();
  const auto suns = static_cast<std::size_t>(
      std::ranges::count(model.lights, assets::ModelLightKind::sun, &assets::ModelLight::kind));
  const double rows = total * static_cast<double>(1 + std::max(model.nodes.size(), model.instances.size())),
               lamps = copy.lights ? total * static_cast<double>(model.lights.size() - suns) : 0;
  if (rows + static_cast<double>(scene_.nodes.size()) > static_cast<double>(kMaxNodes))
    return failTooMany(diagnostics_, value, fmt::format("with model '{}' the scene has too many nodes", name),
                       kMaxNodes, fmt::format("{} copies of {} nodes", total, model.nodes.size() + 1));
  if (lamps + static_cast<double>(scene_.lamps.size()) > static_cast<double>(kMaxLamps))
    return failTooMany(diagnostics_, value, fmt::format("with model '{}' the scene has too many lamps", name),
                       kMaxLamps, fmt::format("{} copies of {} lamps", total, model.lights.size() - suns),
                       "leave them out: \"lights\": false");
  if (copy.lights && suns > 0 && !scene_.sun) {
    sunOf_ = name;
  } else if (copy.lights && suns > 0 && !sunOf_.empty()) {  // a sun of the scene file takes the place of all
    text::Diagnostic& d = diagnostics_.warning(Code::modelPartLeftOut, value.place,
                                               fmt::format("the sun of model '{}' was left out", name));
    d.expected = "one model with a directional light, or a 'sun' in the scene file";
    d.found = fmt::format("the sun of model '{}'", sunOf_);
    d.hint = "\"lights\": false leaves the lights of a model out";
  }
  grid.forEach([&](std::size_t index, glm::vec3 place) {
    copy.root.name = total > 1 ? fmt::format("{}[{}]", name, index) : name;
    copy.root.local.translation = place;
    addModelCopy(scene_, loaded.rows, model, copy);
  });
}

bool SceneModels::addWhole(const std::string& path) {
  const Loaded* loaded = load(path);
  if (!loaded) return false;
  if (loaded->model.lights.size() > kMaxLamps) {
    JsonValue whole;
    whole.place.file = std::make_shared<const std::string>(path);
    failTooMany(diagnostics_, whole, fmt::format("the model '{}' has too many lights", path), kMaxLamps,
                fmt::format("{}", loaded->model.lights.size()));
    return false;
  }
  ModelCopy copy;
  copy.root.name = loaded->model.name;
  if (!loaded->model.animations.empty()) copy.animation = 0;
  addModelCopy(scene_, loaded->rows, loaded->model, copy);
  return true;
}

void SceneModels::finish() {
  for (const std::string& file : files_)
    if (std::ranges::find(scene_.files, file) == scene_.files.end()) scene_.files.push_back(file);
  if (!data_->vertices.empty()) scene_.meshData = data_;
}

namespace {

constexpr double kFovDegrees = 35;
constexpr float kSunLux = 50000;  // a bright day

// Looks along `towards`, a unit vector, at the whole of `box`.
CameraPose framePose(const Box& box, glm::dvec3 towards) {
  const glm::dvec3 center = (glm::dvec3(box.low) + glm::dvec3(box.high)) * 0.5;
  const double radius = std::max(glm::length(glm::dvec3(box.high) - glm::dvec3(box.low)) / 2, 1e-6);
  const double distance = radius / std::sin(kFovDegrees / 2 * std::numbers::pi / 180);
  CameraPose pose;
  pose.target = center;
  pose.position = center - towards * distance;
  pose.fovDegrees = kFovDegrees;
  pose.nearPlane = distance / 1000;
  return pose;
}

}  // namespace

std::optional<Scene> loadModelScene(const std::string& path, text::Diagnostics& diagnostics,
                                    std::vector<std::string>* files, const assets::LoadObserver& observer) {
  Scene scene;
  scene.name = std::filesystem::path(path).stem().string();
  SceneModels models(scene, path, diagnostics, observer);
  const bool good = models.addWhole(path);
  if (files) *files = models.files();
  if (!good) return {};
  models.finish();
  MeshFrame frame;
  frame.update(scene, 1, 0, 0);
  const Box box = frame.sceneBounds();
  const std::pair<const char*, glm::dvec3> kViews[] = {{"front", {0, 0, -1}},
                                                       {"left", {1, 0, 0}},
                                                       {"right", {-1, 0, 0}},
                                                       {"back", {0, 0, 1}},
                                                       {"top", {0, -1, 0}}};
  for (const auto& [name, towards] : kViews) {
    Camera camera;
    camera.name = name;
    camera.pose = framePose(box, towards);
    scene.cameras.add(std::move(camera));
  }
  if (scene.sun || scene.lamps.size() > 0) return scene;
  Sun sun;
  sun.direction = glm::normalize(glm::vec3(0.4f, 0.8f, 0.6f));
  sun.irradiance = glm::vec3(kSunLux / scene.nits);
  scene.sun = sun;
  return scene;
}

}  // namespace weft::scene
