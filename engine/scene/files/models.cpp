#include "engine/scene/files/models.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <numbers>

#include "engine/assets/models/model_file.h"
#include "engine/base/nearest.h"
#include "engine/scene/files/lights.h"
#include "engine/scene/files/lists.h"
#include "engine/scene/files/reading.h"

namespace weft::scene {

using base::Code;
using base::JsonFields;
using base::JsonMember;
using base::JsonValue;
using base::NumberRange;

namespace {

constexpr NumberRange kDegrees{.min = -1e6, .max = 1e6};
constexpr NumberRange kSpeed{.min = -1e3, .max = 1e3};

float toRadians(double degrees) {
  return static_cast<float>(degrees * std::numbers::pi / 180);
}

// About X, then Y, then Z.
glm::quat rotationOf(const std::array<double, 3>& degrees) {
  return glm::angleAxis(toRadians(degrees[2]), glm::vec3(0, 0, 1)) *
         glm::angleAxis(toRadians(degrees[1]), glm::vec3(0, 1, 0)) *
         glm::angleAxis(toRadians(degrees[0]), glm::vec3(1, 0, 0));
}

}  // namespace

void SceneModels::read(JsonFields& fields, const FindMaterial& findMaterial) {
  const JsonValue* models = fields.object("models");
  if (!models) return;
  for (const JsonMember& member : models->members) readModel(member.key, member.value, findMaterial);
}

const SceneModels::Loaded* SceneModels::load(const std::string& path) {
  if (const auto known = loaded_.find(path); known != loaded_.end()) return known->second.get();
  std::unique_ptr<Loaded>& loaded = loaded_[path];
  std::vector<std::string> files;
  std::optional<assets::Model> model = assets::loadModel(
      path, diagnostics_, observer_, &files, [this](assets::DecodeJob& job) { decoding_.run(job, 0); });
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

void SceneModels::readPlace(JsonFields& fields, const std::string& what, ModelCopy& copy) {
  Node& root = copy.root;
  root.local.translation = toVec3(fields.triple("position", kWorld).value_or(std::array<double, 3>{}));
  root.local.rotation = rotationOf(fields.triple("rotation", kDegrees).value_or(std::array<double, 3>{}));
  root.local.scale = glm::vec3(static_cast<float>(fields.number("scale", kSize).value_or(1)));
  root.spin = {0, toRadians(fields.number("spin", kDegrees).value_or(0)), 0};
  root.velocity = toVec3(fields.triple("velocity", kWorld).value_or(std::array<double, 3>{}));
  copy.lists = readLists(fields, what, diagnostics_);
  copy.speed = static_cast<float>(fields.number("speed", kSpeed).value_or(1));
  copy.lights = fields.boolean("lights").value_or(true);
  copy.lampShadows = fields.boolean("lamp_shadows").value_or(false);
}

void SceneModels::readModel(const std::string& name, const JsonValue& value,
                            const FindMaterial& findMaterial) {
  const std::string what = fmt::format("model '{}'", name);
  JsonFields fields(value, what, Code::badSceneValue, diagnostics_);
  fields.require({"file"});
  ModelCopy copy;
  readPlace(fields, what, copy);
  const auto file = fields.text("file");
  const auto count =
      fields.find("count") ? fields.triple("count", kGridCount) : std::array<double, 3>{1, 1, 1};
  const float spacing = static_cast<float>(fields.number("spacing", kSize).value_or(2.5));
  if (const JsonValue* material = fields.find("material"))
    copy.material = findMaterial(*material, fmt::format("'material' of {}", what));
  const JsonValue* animation = fields.find("animation");
  fields.finish();
  if (!file || !count) return;
  const Loaded* loaded =
      load((std::filesystem::path(sceneFile_).parent_path() / *file).lexically_normal().string());
  if (!loaded) return;
  if (animation) readAnimation(*animation, what, loaded->model, copy);
  if (copy.material && !scene_.materials.find(*copy.material)) return;
  addCopies(value, name, *loaded, std::move(copy), *count, spacing);
}

void SceneModels::readAnimation(const JsonValue& value, const std::string& what, const assets::Model& model,
                                ModelCopy& copy) {
  std::vector<std::string> names;
  for (const auto& animation : model.animations) names.push_back(animation->name);
  if (value.is(JsonValue::Type::number) && value.number >= 0 &&
      value.number < static_cast<double>(names.size()) && value.whole) {
    copy.animation = static_cast<std::uint32_t>(value.number);
    return;
  }
  if (!value.is(JsonValue::Type::number)) {
    const auto name = base::readText(value, fmt::format("'animation' of {}", what), diagnostics_);
    if (!name) return;
    if (const auto found = std::ranges::find(names, *name); found != names.end()) {
      copy.animation = static_cast<std::uint32_t>(found - names.begin());
      return;
    }
  }
  base::Diagnostic& d =
      failAt(diagnostics_, Code::unknownAnimation, value, fmt::format("{} has no such animation", what));
  d.expected = names.empty() ? "none: its file has no animation" : fmt::format("{}", fmt::join(names, ", "));
  d.found = describe(value);
  if (value.is(JsonValue::Type::string)) d.hint = base::nearestHint(value.text, names);
}

void SceneModels::addCopies(const JsonValue& value, const std::string& name, const Loaded& loaded,
                            ModelCopy copy, const std::array<double, 3>& count, float spacing) {
  const double total = count[0] * count[1] * count[2];
  const double rows =
      total * static_cast<double>(1 + std::max(loaded.model.nodes.size(), loaded.model.instances.size()));
  if (rows + static_cast<double>(scene_.nodes.size()) > static_cast<double>(kMaxNodes)) {
    base::Diagnostic& d = failAt(diagnostics_, Code::badSceneValue, value,
                                 fmt::format("with model '{}' the scene has too many nodes", name));
    d.expected = fmt::format("at most {} in all", kMaxNodes);
    d.found = fmt::format("{} copies of {} nodes", total, loaded.model.nodes.size() + 1);
    return;
  }
  const auto suns = static_cast<std::size_t>(
      std::ranges::count(loaded.model.lights, assets::ModelLightKind::sun, &assets::ModelLight::kind));
  const double lamps = copy.lights ? total * static_cast<double>(loaded.model.lights.size() - suns) : 0;
  if (lamps + static_cast<double>(scene_.lamps.size()) > static_cast<double>(kMaxLamps)) {
    base::Diagnostic& d = failAt(diagnostics_, Code::badSceneValue, value,
                                 fmt::format("with model '{}' the scene has too many lamps", name));
    d.expected = fmt::format("at most {} in all", kMaxLamps);
    d.found = fmt::format("{} copies of {} lamps", total, loaded.model.lights.size() - suns);
    d.hint = "leave them out: \"lights\": false";
    return;
  }
  if (copy.lights && suns > 0 && !scene_.sun) {
    sunOf_ = name;
  } else if (copy.lights && suns > 0 && !sunOf_.empty()) {  // a sun of the scene file takes the place of all
    base::Diagnostic& d = diagnostics_.warning(Code::modelPartLeftOut, value.place,
                                               fmt::format("the sun of model '{}' was left out", name));
    d.pointer = value.pointer;
    d.expected = "one model with a directional light, or a 'sun' in the scene file";
    d.found = fmt::format("the sun of model '{}'", sunOf_);
    d.hint = "\"lights\": false leaves the lights of a model out";
  }
  const glm::ivec3 n(count[0], count[1], count[2]);
  const glm::vec3 center = copy.root.local.translation;
  std::size_t index = 0;
  for (int z = 0; z < n.z; ++z)
    for (int y = 0; y < n.y; ++y)
      for (int x = 0; x < n.x; ++x, ++index) {
        copy.root.name = total > 1 ? fmt::format("{}[{}]", name, index) : name;
        copy.root.local.translation =
            center + (glm::vec3(x, -y, -z) - glm::vec3(n.x - 1, 1 - n.y, 1 - n.z) / 2.0f) * spacing;
        addModelCopy(scene_, loaded.rows, loaded.model, copy);
      }
}

bool SceneModels::addWhole(const std::string& path) {
  const Loaded* loaded = load(path);
  if (!loaded) return false;
  if (loaded->model.lights.size() > kMaxLamps) {
    base::Diagnostic& d = diagnostics_.error(Code::badSceneValue, {std::make_shared<const std::string>(path)},
                                             fmt::format("the model '{}' has too many lights", path));
    d.expected = fmt::format("at most {}", kMaxLamps);
    d.found = fmt::format("{}", loaded->model.lights.size());
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

}  // namespace weft::scene
