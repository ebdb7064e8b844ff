#include "engine/scene/files/ground.h"

#include "engine/scene/files/reading.h"

namespace weft::scene {

void readGround(base::JsonFields& fields, Scene& scene, base::Diagnostics& diagnostics) {
  const base::JsonValue* value = fields.find("ground");
  if (!value) return;
  base::JsonFields of(*value, "the ground", base::Code::badSceneValue, diagnostics);
  Ground ground;
  ground.height = static_cast<float>(of.number("height", kWorld).value_or(0));
  if (const auto albedo = of.triple("albedo", kUnit)) ground.albedo = toVec3(*albedo);
  ground.radius = static_cast<float>(of.number("radius", kSize).value_or(100));
  const base::JsonValue* radius = of.find("radius");
  if (radius && !of.find("albedo")) {
    base::Diagnostic& d =
        failAt(diagnostics, base::Code::badSceneValue, *radius, "the ground has a radius but no surface");
    d.expected = "an albedo beside it";
    d.found = "a ground that shows the environment, which ends nowhere";
    d.hint = "give it an \"albedo\", or leave \"radius\" out";
  }
  of.finish();
  scene.ground = ground;
}

}  // namespace weft::scene
