#include "engine/scene/files/lights.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "engine/scene/files/reading.h"

namespace weft::scene {

namespace {

using base::Code;
using base::Diagnostics;
using base::JsonFields;
using base::JsonMember;
using base::JsonValue;
using base::NumberRange;

constexpr NumberRange kNits{.min = 1e-3, .max = 1e9};
constexpr NumberRange kPhotometric{.min = 0, .max = 1e12};
constexpr NumberRange kSunAngle{.min = 0, .max = 90};
constexpr NumberRange kConeAngle{.min = 0, .max = 90};

class LightReader {
 public:
  LightReader(Scene& scene, Diagnostics& diagnostics) : scene_(scene), diagnostics_(diagnostics) {}

  void read(JsonFields& fields) {
    scene_.nits = static_cast<float>(fields.number("nits", kNits).value_or(10000));
    if (const JsonValue* sun = fields.find("sun")) readSun(*sun);
    if (const JsonValue* lamps = fields.object("lamps"))
      for (const JsonMember& member : lamps->members) readLamp(member.key, member.value);
    if (const JsonValue* grids = fields.object("lamp_grids"))
      for (const JsonMember& member : grids->members) readGrid(member.key, member.value);
  }

 private:
  // A unit vector; empty after an error or when the key is absent.
  std::optional<glm::vec3> readDirection(JsonFields& fields, const std::string& what) {
    const auto direction = fields.triple("direction", kWorld);
    if (!direction) return {};
    const double length = glm::length(toDvec3(*direction));
    if (length >= 1e-6) return glm::vec3(toDvec3(*direction) / length);
    failAt(diagnostics_, Code::badSceneValue, *fields.find("direction"),
           fmt::format("the direction of {} has no length", what))
        .hint = "give a vector such as [0, 1, 0]";
    return {};
  }

  glm::vec3 toUnits(double photometric, glm::vec3 color) const {
    return color * static_cast<float>(photometric / static_cast<double>(scene_.nits));
  }

  static glm::vec3 readColor(JsonFields& fields) {
    return toVec3(fields.triple("color", kUnit).value_or(std::array<double, 3>{1, 1, 1}));
  }

  void readSun(const JsonValue& value) {
    JsonFields fields(value, "the sun", Code::badSceneValue, diagnostics_);
    fields.require({"direction", "lux"});
    Sun sun;
    if (const auto direction = readDirection(fields, "the sun")) sun.direction = *direction;
    const glm::vec3 color = readColor(fields);
    sun.irradiance = toUnits(fields.number("lux", kPhotometric).value_or(0), color);
    sun.angle = static_cast<float>(fields.number("angle", kSunAngle).value_or(0.53));
    sun.shadow = fields.boolean("shadow").value_or(true);
    fields.finish();
    scene_.sun = sun;
  }

  bool hasRoom(const JsonValue& value, std::size_t more) {
    if (scene_.lamps.size() + more <= kMaxLamps) return true;
    if (!full_) {
      base::Diagnostic& d = failAt(diagnostics_, Code::badSceneValue, value, "the scene has too many lamps");
      d.expected = fmt::format("at most {} in all", kMaxLamps);
      d.found = fmt::format("{}", scene_.lamps.size() + more);
    }
    full_ = true;
    return false;
  }

  void readLamp(const std::string& name, const JsonValue& value) {
    const std::string what = fmt::format("lamp '{}'", name);
    JsonFields fields(value, what, Code::badSceneValue, diagnostics_);
    fields.require({"position", "candela"});
    Lamp lamp;
    lamp.name = name;
    lamp.position = toVec3(fields.triple("position", kWorld).value_or(std::array<double, 3>{}));
    const glm::vec3 color = readColor(fields);
    setStrength(readStrength(fields), color, lamp);
    const auto direction = readDirection(fields, what);
    const auto inner = fields.number("inner", kConeAngle), outer = fields.number("outer", kConeAngle);
    if (direction) lamp.direction = *direction;
    lamp.shadow = fields.boolean("shadow").value_or(false);
    const bool aimed = fields.find("direction") != nullptr;
    fields.finish();
    if ((inner || outer) && !aimed)
      failAt(diagnostics_, Code::badSceneValue, value, fmt::format("{} has a cone but no 'direction'", what))
          .hint = "say where the lamp shines: \"direction\": [0, -1, 0]";
    if (aimed) setCone(value, what, inner.value_or(0), outer.value_or(45), lamp);
    if (hasRoom(value, 1)) scene_.lamps.add(std::move(lamp));
  }

  struct Strength {
    double candela = 0;
    float range = 0, radius = 0;
  };
  Strength readStrength(JsonFields& fields) {
    return {fields.number("candela", kPhotometric).value_or(0),
            static_cast<float>(fields.number("range", kSize).value_or(0)),
            static_cast<float>(fields.number("radius", kAmount).value_or(0))};
  }
  void setStrength(const Strength& strength, glm::vec3 color, Lamp& lamp) const {
    lamp.intensity = toUnits(strength.candela, color);
    lamp.range = strength.range > 0 ? strength.range : rangeOf(lamp.intensity);
    lamp.radius = strength.radius;
  }

  void setCone(const JsonValue& value, const std::string& what, double inner, double outer, Lamp& lamp) {
    if (inner > outer) {
      base::Diagnostic& d = failAt(diagnostics_, Code::badSceneValue, value,
                                   fmt::format("the inner cone of {} is wider than the outer one", what));
      d.expected = fmt::format("an 'inner' of at most {} degrees", outer);
      d.found = fmt::format("{}", inner);
      return;
    }
    lamp.cosInner = static_cast<float>(std::cos(inner * std::numbers::pi / 180));
    lamp.cosOuter = static_cast<float>(std::cos(outer * std::numbers::pi / 180));
  }

  void readGrid(const std::string& name, const JsonValue& value) {
    const std::string what = fmt::format("lamp grid '{}'", name);
    JsonFields fields(value, what, Code::badSceneValue, diagnostics_);
    fields.require({"count", "candela"});
    const auto count = fields.triple("count", kGridCount);
    const float spacing = static_cast<float>(fields.number("spacing", kSize).value_or(2.5));
    const glm::vec3 center = toVec3(fields.triple("center", kWorld).value_or(std::array<double, 3>{}));
    std::vector<glm::vec3> colors;
    if (const JsonValue* list = fields.array("colors"))
      for (const JsonValue& item : list->items)
        if (const auto color = base::readTriple(item, fmt::format("a color of {}", what), kUnit,
                                                Code::badSceneValue, diagnostics_))
          colors.push_back(toVec3(*color));
    if (colors.empty()) colors.emplace_back(1);
    const Strength strength = readStrength(fields);
    fields.finish();
    if (!count) return;
    const double total = (*count)[0] * (*count)[1] * (*count)[2];
    if (!hasRoom(*value.find("count"), static_cast<std::size_t>(total))) return;
    Lamp lamp;
    const glm::ivec3 n((*count)[0], (*count)[1], (*count)[2]);
    std::size_t index = 0;
    for (int z = 0; z < n.z; ++z)
      for (int y = 0; y < n.y; ++y)
        for (int x = 0; x < n.x; ++x, ++index) {
          setStrength(strength, colors[index % colors.size()], lamp);
          lamp.name = fmt::format("{}[{}]", name, index);
          lamp.position =
              center + (glm::vec3(x, -y, -z) - glm::vec3(n.x - 1, 1 - n.y, 1 - n.z) / 2.0f) * spacing;
          scene_.lamps.add(lamp);
        }
  }

  Scene& scene_;
  Diagnostics& diagnostics_;
  bool full_ = false;
};

}  // namespace

void readLights(JsonFields& fields, Scene& scene, Diagnostics& diagnostics) {
  LightReader(scene, diagnostics).read(fields);
}

}  // namespace weft::scene
