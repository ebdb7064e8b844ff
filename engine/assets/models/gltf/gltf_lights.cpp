#include "engine/assets/models/gltf/gltf_lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>

namespace weft::assets {

using base::JsonValue;

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
