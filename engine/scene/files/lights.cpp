// The lights of a scene file. Declared in reading.h.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "engine/scene/files/reading.h"
#include "scene_sentences.h"

namespace weft::scene {

namespace {

using text::Code;
using text::Diagnostics;
using text::JsonMember;
using text::JsonValue;
using text::NumberRange;

constexpr NumberRange kNits{.min = 1e-3, .max = 1e9};
constexpr NumberRange kPhotometric{.min = 0, .max = 1e12};
constexpr NumberRange kSunAngle{.min = 0, .max = 90};
constexpr NumberRange kConeAngle{.min = 0, .max = 90};
constexpr NumberRange kSide{.min = 1e-6, .max = 1e9};

class LightReader {
 public:
  LightReader(Scene& scene, Diagnostics& diagnostics) : scene_(scene), diagnostics_(diagnostics) {}

  void read(SceneFields& fields) {
    fields.read("nits", kNits, scene_.nits);
    if (const JsonValue* sun = fields.find("sun")) readSun(*sun);
    if (const JsonValue* lamps = fields.object("lamps"))
      for (const JsonMember& member : lamps->members) readLamp(member.key, member.value);
    if (const JsonValue* grids = fields.object("lamp_grids"))
      for (const JsonMember& member : grids->members) readGrid(member.key, member.value);
  }

 private:
  // A unit vector; as it is after an error or when the key is absent.
  void readDirection(SceneFields& fields, const std::string& what, glm::vec3& out) {
    glm::dvec3 direction(out);
    fields.read("direction", kWorld, direction);
    if (const double length = glm::length(direction); length >= 1e-6)
      out = glm::vec3(direction / length);
    else
      diagnostics_.error(say::directionWithoutLength, fields.find("direction")->place, what);
  }

  void readSun(const JsonValue& value) {
    SceneFields fields(value, "the sun", Code::badSceneValue, diagnostics_);
    fields.require({"direction", "lux"});
    Sun sun;
    glm::vec3 color(1);
    double lux = 0;
    readDirection(fields, "the sun", sun.direction);
    fields.read("color", kUnit, color);
    fields.read("lux", kPhotometric, lux);
    fields.read("angle", kSunAngle, sun.angle);
    fields.read("shadow", sun.shadow);
    fields.finish();
    sun.irradiance = scene_.toUnits(lux, color);
    scene_.sun = sun;
  }

  bool hasRoom(const JsonValue& value, std::size_t more) {
    if (scene_.lamps.size() + more <= kMaxLamps) return true;
    if (!std::exchange(full_, true))
      diagnostics_.error(say::tooManyInAll, value.place, "the scene has too many lamps", kMaxLamps,
                         fmt::format("{}", scene_.lamps.size() + more), "");
    return false;
  }

  void readLamp(const std::string& name, const JsonValue& value) {
    const std::string what = fmt::format("lamp '{}'", name);
    SceneFields fields(value, what, Code::badSceneValue, diagnostics_);
    fields.require({"position", "candela"});
    Lamp lamp;
    lamp.name = name;
    glm::vec3 color(1);
    fields.read("position", kWorld, lamp.position);
    fields.read("color", kUnit, color);
    setIntensity(readStrength(fields, lamp), color, lamp);
    readDirection(fields, what, lamp.direction);
    const auto inner = fields.number("inner", kConeAngle), outer = fields.number("outer", kConeAngle);
    fields.read("shadow", lamp.shadow);
    const bool aimed = fields.find("direction") != nullptr;
    glm::vec2 size(0);
    fields.read("size", kSide, size);
    fields.finish();
    const bool sized = size.x > 0, cone = inner || outer;
    if (sized && (cone || lamp.radius > 0)) diagnostics_.error(say::sizeAndCone, value.place, what);
    if ((cone || sized) && !aimed) diagnostics_.error(say::coneWithoutDirection, value.place, what);
    // Shaders that know no sizes see a wide spot.
    if (aimed) setCone(value, what, inner.value_or(0), outer.value_or(sized ? 90 : 45), lamp);
    const glm::vec3 side = glm::cross(lamp.direction, glm::vec3(0, 1, 0));
    lamp.across = glm::length(side) > 1e-3f ? glm::normalize(side) : glm::vec3(1, 0, 0);
    lamp.up = glm::cross(lamp.across, lamp.direction) * (size.y / 2);
    lamp.across *= size.x / 2;
    if (hasRoom(value, 1)) scene_.lamps.add(std::move(lamp));
  }

  // Candela; range and radius go to the lamp.
  static double readStrength(SceneFields& fields, Lamp& lamp) {
    double candela = 0;
    fields.read("candela", kPhotometric, candela);
    fields.read("range", kSize, lamp.range);
    fields.read("radius", kAmount, lamp.radius);
    return candela;
  }
  void setIntensity(double candela, glm::vec3 color, Lamp& lamp) const {
    lamp.intensity = scene_.toUnits(candela, color);
    if (lamp.range == 0) lamp.range = rangeOf(lamp.intensity);
  }

  void setCone(const JsonValue& value, const std::string& what, double inner, double outer, Lamp& lamp) {
    if (inner > outer) diagnostics_.error(say::innerConeWider, value.place, what, outer, inner);
    lamp.cosInner = static_cast<float>(std::cos(inner * std::numbers::pi / 180));
    lamp.cosOuter = static_cast<float>(std::cos(outer * std::numbers::pi / 180));
  }

  void readGrid(const std::string& name, const JsonValue& value) {
    const std::string what = fmt::format("lamp grid '{}'", name);
    SceneFields fields(value, what, Code::badSceneValue, diagnostics_);
    fields.require({"count", "candela"});
    SceneGrid grid;
    grid.read(fields);
    fields.read("center", kWorld, grid.center);
    std::vector<glm::vec3> colors;
    if (const JsonValue* list = fields.array("colors"))
      for (const JsonValue& item : list->items)
        if (const auto color = text::readNumbers(item, fmt::format("a color of {}", what), kUnit,
                                                 Code::badSceneValue, diagnostics_))
          colors.emplace_back((*color)[0], (*color)[1], (*color)[2]);
    if (colors.empty()) colors.emplace_back(1);
    Lamp strength;
    const double candela = readStrength(fields, strength);
    fields.finish();
    if (grid.total() == 0 || !hasRoom(*value.find("count"), static_cast<std::size_t>(grid.total()))) return;
    grid.forEach([&](std::size_t index, glm::vec3 place) {
      Lamp lamp = strength;
      setIntensity(candela, colors[index % colors.size()], lamp);
      lamp.name = fmt::format("{}[{}]", name, index);
      lamp.position = place;
      scene_.lamps.add(std::move(lamp));
    });
  }

  Scene& scene_;
  Diagnostics& diagnostics_;
  bool full_ = false;
};

}  // namespace

void readLights(SceneFields& fields, Scene& scene, Diagnostics& diagnostics) {
  LightReader(scene, diagnostics).read(fields);
}

}  // namespace weft::scene
