#include "engine/assets/models/gltf/gltf_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <numbers>
#include <optional>

#include "engine/assets/models/parts/decompose.h"

namespace weft::assets {

using base::JsonValue;

namespace {

bool readNode(GltfDocument& document, const JsonValue& value, std::size_t number, ModelNode& node) {
  node.name = document.text(value, "name");
  if (node.name.empty()) node.name = fmt::format("node {}", number);
  const JsonValue *matrix = value.find("matrix"), *t = value.find("translation"), *r = value.find("rotation"),
                  *s = value.find("scale");
  if (matrix) {
    glm::mat4 m(0);
    if (!document.numbers(value, "matrix", 16, &m[0].x)) return false;
    if (decompose(m, node.local)) return true;
    document.fail(*matrix,
                  fmt::format("the matrix of node {} is none of translation, rotation and scale", number));
    return false;
  }
  glm::vec4 rotation(0, 0, 0, 1);
  if (t && !document.numbers(value, "translation", 3, &node.local.translation.x)) return false;
  if (s && !document.numbers(value, "scale", 3, &node.local.scale.x)) return false;
  if (r && !document.numbers(value, "rotation", 4, &rotation.x)) return false;
  if (normalizeRotation(rotation)) {
    node.local.rotation = toRotation(rotation);
    return true;
  }
  document.fail(*r, fmt::format("the rotation of node {} has no length", number)).expected =
      "a quaternion x, y, z, w";
  return false;
}

// Each node's parent, by the file's index.
bool readParents(GltfDocument& document, std::vector<std::uint32_t>& parents) {
  const std::vector<JsonValue>& rows = document.rows("nodes");
  parents.assign(rows.size(), kNoRow);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const JsonValue* children = rows[i].find("children");
    if (!children) continue;
    for (const JsonValue& item : children->items) {
      const auto child = document.index("nodes", &item);
      if (!child) return false;
      if (parents[*child] != kNoRow || *child == i) {
        base::Diagnostic& d =
            document.fail(item, fmt::format("node {} cannot be a child of node {}", *child, i));
        d.expected = "one parent for each node";
        d.found = *child == i ? "itself" : fmt::format("a child of node {} already", parents[*child]);
        return false;
      }
      parents[*child] = static_cast<std::uint32_t>(i);
    }
  }
  return true;
}

}  // namespace

bool readGltfNodes(GltfDocument& document, Model& model, GltfNodes& nodes) {
  const std::vector<JsonValue>& rows = document.rows("nodes");
  std::vector<std::uint32_t> parents, work;
  if (!readParents(document, parents)) return false;
  nodes.rowOf.assign(rows.size(), kNoRow);
  for (std::size_t i = rows.size(); i-- > 0;)
    if (parents[i] == kNoRow) work.push_back(static_cast<std::uint32_t>(i));
  while (!work.empty()) {
    const std::uint32_t at = work.back();
    work.pop_back();
    ModelNode node;
    if (!readNode(document, rows[at], at, node)) return false;
    if (parents[at] != kNoRow) node.parent = nodes.rowOf[parents[at]];
    nodes.rowOf[at] = static_cast<std::uint32_t>(model.nodes.size());
    model.nodes.push_back(std::move(node));
    if (const JsonValue* children = rows[at].find("children"))
      for (std::size_t c = children->items.size(); c-- > 0;)
        work.push_back(static_cast<std::uint32_t>(children->items[c].number));
  }
  if (const auto missing = std::ranges::find(nodes.rowOf, kNoRow); missing != nodes.rowOf.end()) {
    const auto number = static_cast<std::size_t>(missing - nodes.rowOf.begin());
    base::Diagnostic& d = document.fail(rows[number], fmt::format("node {} is its own ancestor", number));
    d.expected = "nodes that form trees";
    d.found = "a circle of children";
    return false;
  }
  // What the scene shows: its roots and all below. Without a scene everything.
  nodes.shown.assign(rows.size(), document.rows("scenes").empty());
  if (nodes.shown.empty() || nodes.shown[0]) return true;
  const JsonValue* chosen = document.root().find("scene");
  const auto scene = chosen ? document.index("scenes", chosen) : std::optional<std::uint32_t>(0);
  if (!scene) return false;
  if (const JsonValue* roots = document.rows("scenes")[*scene].find("nodes"))
    for (const JsonValue& item : roots->items) {
      const auto root = document.index("nodes", &item);
      if (!root) return false;
      work.push_back(*root);
    }
  while (!work.empty()) {
    const std::uint32_t at = work.back();
    work.pop_back();
    if (nodes.shown[at]) continue;
    nodes.shown[at] = true;
    if (const JsonValue* children = rows[at].find("children"))
      for (const JsonValue& child : children->items) work.push_back(static_cast<std::uint32_t>(child.number));
  }
  return true;
}

bool readGltfSkins(GltfDocument& document, const GltfNodes& nodes, Model& model) {
  for (const JsonValue& row : document.rows("skins")) {
    ModelSkin& skin = model.skins.emplace_back();
    const JsonValue* joints = row.find("joints");
    if (!joints || joints->items.empty() || joints->items.size() > 65535) {
      document.fail(row, "a skin has no joints, or too many").expected = "1 to 65535 joints";
      return false;
    }
    for (const JsonValue& item : joints->items) {
      const auto joint = document.index("nodes", &item);
      if (!joint) return false;
      skin.joints.push_back(nodes.rowOf[*joint]);
    }
    skin.inverseBind.assign(skin.joints.size(), glm::mat4(1));
    const JsonValue* matrices = row.find("inverseBindMatrices");
    if (!matrices) continue;
    const GltfAccessor* accessor = document.accessor(matrices, "MAT4", true);
    if (!accessor) return false;
    if (accessor->count < skin.joints.size() || accessor->count > 65536 || accessor->type != 5126) {
      base::Diagnostic& d = document.fail(*matrices, "the skin's matrices do not fit its joints");
      d.expected = fmt::format("{} matrices of floats", skin.joints.size());
      d.found = fmt::format("{}, componentType {}", accessor->count, accessor->type);
      return false;
    }
    const std::vector<float> values = readFloats(*accessor);
    if (!std::ranges::all_of(values, [](float v) { return std::isfinite(v); })) {
      document.fail(*matrices, "a matrix of the skin holds what is no number").expected = "finite numbers";
      return false;
    }
    for (std::size_t j = 0; j < skin.joints.size(); ++j)
      skin.inverseBind[j] = glm::make_mat4(values.data() + 16 * j);
  }
  return true;
}

namespace {

class AnimationReader {
 public:
  AnimationReader(GltfDocument& document, ModelFiles& files, const GltfNodes& nodes)
      : document_(document), files_(files), nodes_(nodes) {}

  bool read(const JsonValue& row, std::size_t number, ModelAnimation& out) {
    out.name = document_.text(row, "name");
    if (out.name.empty()) out.name = fmt::format("animation {}", number);
    const JsonValue *channels = row.find("channels"), *samplers = row.find("samplers");
    if (!channels || !samplers) return true;
    for (const JsonValue& channel : channels->items) {
      const JsonValue* target = channel.find("target");
      const JsonValue* node = target ? target->find("node") : nullptr;
      const std::string path = target ? document_.text(*target, "path") : "";
      if (path == "weights") leaveOutWeights(channel, out.name);
      if (!node || (path != "translation" && path != "rotation" && path != "scale")) continue;
      ModelTrack track;
      const auto at = document_.index("nodes", node);
      if (!at) return false;
      track.node = nodes_.rowOf[*at];
      track.path = path == "rotation" ? TrackPath::rotation
                   : path == "scale"  ? TrackPath::scale
                                      : TrackPath::translation;
      const JsonValue* sampler = channel.find("sampler");
      if (!sampler || sampler->number < 0 ||
          !(sampler->number < static_cast<double>(samplers->items.size()))) {
        base::Diagnostic& d =
            document_.fail(sampler ? *sampler : channel, "there is no such sampler in the animation");
        d.expected = fmt::format("an index below {}", samplers->items.size());
        return false;
      }
      if (!readTrack(samplers->items[static_cast<std::size_t>(sampler->number)], track)) return false;
      out.duration = std::max(out.duration, track.times.back());
      out.tracks.push_back(std::move(track));
    }
    return true;
  }

 private:
  // Once for an animation, which may have such a channel for every mesh.
  void leaveOutWeights(const JsonValue& channel, const std::string& animation) {
    if (saidWeights_) return;
    saidWeights_ = true;
    base::Diagnostic& d = document_.leaveOut(
        channel, fmt::format("the moving morph targets of animation '{}' were left out", animation));
    d.expected = "channels of translation, rotation or scale";
    d.hint = "meshes are shown with the 'weights' that they or their nodes begin with";
  }

  bool readTrack(const JsonValue& sampler, ModelTrack& track) {
    const std::string how = document_.text(sampler, "interpolation");
    track.interpolation = how == "STEP"          ? TrackInterpolation::step
                          : how == "CUBICSPLINE" ? TrackInterpolation::cubic
                                                 : TrackInterpolation::linear;
    const bool rotation = track.path == TrackPath::rotation;
    const GltfAccessor* input = document_.accessor(sampler.find("input"), "SCALAR", true);
    const GltfAccessor* output = document_.accessor(sampler.find("output"), rotation ? "VEC4" : "VEC3", true);
    if (!input || !output) {
      if (!sampler.find("input") || !sampler.find("output"))
        document_.fail(sampler, "a sampler needs 'input' and 'output'").expected = "two accessors";
      return false;
    }
    const std::uint64_t values =
        std::uint64_t{input->count} * (track.interpolation == TrackInterpolation::cubic ? 3 : 1);
    if (output->count != values) {
      base::Diagnostic& d = document_.fail(sampler, "a sampler has not one value for each time");
      d.expected = fmt::format("{} values", values);
      d.found = fmt::format("{}", output->count);
      return false;
    }
    // The same accessor may serve any number of tracks.
    if (!files_.count(std::uint64_t{input->count} * 4 + values * 16, sampler.place)) return false;
    track.times = readFloats(*input);
    const std::vector<float> numbers = readFloats(*output);
    for (std::size_t i = 0; i < values; ++i) {
      glm::vec4& value = track.values.emplace_back(0.0f);
      for (std::size_t c = 0; c < output->components; ++c)
        value[static_cast<int>(c)] = numbers[i * output->components + c];
    }
    return check(sampler, track);
  }

  bool check(const JsonValue& sampler, ModelTrack& track) {
    for (std::size_t i = 0; i < track.times.size(); ++i)
      if (!(track.times[i] >= (i == 0 ? 0.0f : track.times[i - 1])) || !std::isfinite(track.times[i])) {
        base::Diagnostic& d = document_.fail(sampler, "the times of an animation do not ascend");
        d.expected = "seconds from 0 on, each later than the one before";
        d.found = fmt::format("{} after {}", track.times[i], i == 0 ? 0.0f : track.times[i - 1]);
        return false;
      }
    const bool cubic = track.interpolation == TrackInterpolation::cubic;
    for (std::size_t i = 0; i < track.values.size(); ++i) {
      glm::vec4& v = track.values[i];
      bool good = isFinite(v);
      if (good && track.path == TrackPath::rotation && (!cubic || i % 3 == 1)) good = normalizeRotation(v);
      if (good) continue;
      document_
          .fail(sampler, fmt::format("value {} of an animation is no {}", i,
                                     track.path == TrackPath::rotation ? "rotation" : "number"))
          .expected = "finite numbers, and quaternions with a length";
      return false;
    }
    return true;
  }

  GltfDocument& document_;
  ModelFiles& files_;
  const GltfNodes& nodes_;
  bool saidWeights_ = false;
};

}  // namespace

bool readGltfAnimations(GltfDocument& document, ModelFiles& files, const GltfNodes& nodes, Model& model) {
  const std::vector<JsonValue>& rows = document.rows("animations");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ModelAnimation animation;
    if (!AnimationReader(document, files, nodes).read(rows[i], i, animation)) return false;
    model.animations.push_back(std::make_shared<const ModelAnimation>(std::move(animation)));
  }
  return true;
}

namespace {

constexpr std::string_view kExtension = "KHR_lights_punctual";

const JsonValue* extensionOf(const JsonValue& object) {
  const JsonValue* extensions = object.find("extensions");
  return extensions ? extensions->find(kExtension) : nullptr;
}

class LightReader {
 public:
  LightReader(GltfDocument& document, const GltfNodes& nodes, base::Diagnostics& diagnostics, Model& model)
      : document_(document), nodes_(nodes), diagnostics_(diagnostics), model_(model) {}

  bool read() {
    const std::size_t before = diagnostics_.errorCount();
    const JsonValue* extension = extensionOf(document_.root());
    const JsonValue* table = extension ? extension->find("lights") : nullptr;
    const std::size_t count = table ? table->items.size() : 0;
    lights_.resize(count);
    const std::vector<JsonValue>& rows = document_.rows("nodes");
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const JsonValue* mine = nodes_.shown[i] ? extensionOf(rows[i]) : nullptr;
      const JsonValue* name = mine ? mine->find("light") : nullptr;
      if (!name) continue;
      const auto row = document_.indexOf("lights", count, *name);
      if (!row) return false;
      std::optional<Read>& light = lights_[*row];
      if (!light) light = readLight(table->items[*row], *row);
      if (diagnostics_.errorCount() > before) return false;
      if (light->known) add(light->light, nodes_.rowOf[i], *name);
    }
    return true;
  }

 private:
  struct Read {
    ModelLight light;
    bool known = false;
  };

  Read readLight(const JsonValue& value, std::uint32_t number) {
    Read out;
    ModelLight& light = out.light;
    light.name = document_.text(value, "name");
    if (light.name.empty()) light.name = fmt::format("light {}", number);
    const std::string kind = document_.text(value, "type");
    out.known = kind == "directional" || kind == "point" || kind == "spot";
    if (!out.known) {
      base::Diagnostic& d = document_.leaveOut(value, fmt::format("light '{}' was left out", light.name));
      d.expected = "a 'type' of \"directional\", \"point\" or \"spot\"";
      d.found = fmt::format("\"{}\"", kind);
      return out;
    }
    light.kind = kind == "directional" ? ModelLightKind::sun
                 : kind == "spot"      ? ModelLightKind::spot
                                       : ModelLightKind::point;
    light.intensity = static_cast<float>(document_.number(value, "intensity", 1, 0, 1e12));
    if (value.find("color") && document_.numbers(value, "color", 3, &light.color.x) &&
        glm::any(glm::lessThan(light.color, glm::vec3(0)))) {
      base::Diagnostic& d = document_.fail(*value.find("color"), "a light's 'color' is negative");
      d.expected = "3 numbers of at least 0";
      d.found = fmt::format("{}, {}, {}", light.color[0], light.color[1], light.color[2]);
    }
    if (light.kind == ModelLightKind::sun) return out;
    light.range = static_cast<float>(document_.number(value, "range", 0, 1e-6, 1e9));
    if (light.kind == ModelLightKind::spot) readCone(value, light);
    return out;
  }

  void readCone(const JsonValue& value, ModelLight& light) {
    light.outer = std::numbers::pi_v<float> / 4;
    const JsonValue* spot = value.find("spot");
    if (!spot) return;
    constexpr double kQuarter = 1.5708;  // turn, as files round it
    const double inner = document_.number(*spot, "innerConeAngle", 0, 0, kQuarter),
                 outer = document_.number(*spot, "outerConeAngle", std::numbers::pi / 4, 0, kQuarter);
    if (inner > outer) {
      base::Diagnostic& d = document_.fail(*spot, "the inner cone of a light is wider than the outer one");
      d.expected = fmt::format("an 'innerConeAngle' of at most {}", outer);
      d.found = fmt::format("{}", inner);
    }
    light.inner = static_cast<float>(inner);
    light.outer = static_cast<float>(outer);
  }

  void add(ModelLight light, std::uint32_t node, const JsonValue& where) {
    light.node = node;
    if (light.kind == ModelLightKind::sun) {
      const auto other = std::ranges::find(model_.lights, ModelLightKind::sun, &ModelLight::kind);
      if (other != model_.lights.end()) {
        const bool brighter = brightnessOf(light) > brightnessOf(*other);
        base::Diagnostic& d = document_.leaveOut(
            where, fmt::format("the light '{}' was left out", brighter ? other->name : light.name));
        d.expected = "one directional light: a scene has one sun";
        d.found = fmt::format("another one, '{}', that is as bright or brighter",
                              brighter ? light.name : other->name);
        if (brighter) *other = std::move(light);
        return;
      }
    }
    model_.lights.push_back(std::move(light));
  }

  static float brightnessOf(const ModelLight& light) {
    return light.intensity * std::max({light.color.x, light.color.y, light.color.z});
  }

  GltfDocument& document_;
  const GltfNodes& nodes_;
  base::Diagnostics& diagnostics_;
  Model& model_;
  std::vector<std::optional<Read>> lights_;  // by row of the extension's table
};

}  // namespace

bool readGltfLights(GltfDocument& document, const GltfNodes& nodes, base::Diagnostics& diagnostics,
                    Model& model) {
  return LightReader(document, nodes, diagnostics, model).read();
}

}  // namespace weft::assets
