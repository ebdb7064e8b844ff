// The sun and lamps. Quantities are in scene units: Scene::nits cd/m² are one unit of radiance, so that an irradiance is
// lux / nits and an intensity candela / nits, per colour channel.
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "engine/scene/table.h"

namespace weft::scene {

struct Node;

struct Sun {
  glm::vec3 direction{0, 1, 0};  // unit, from the scene towards the sun
  glm::vec3 irradiance{1};       // linear RGB, on a surface that faces it
  float angle = 0.53f;           // degrees: diameter of the disc
  bool shadow = true;
  base::Id<Node> node{};  // that turns it, as a lamp's does
};

struct Lamp {
  std::string name;
  glm::vec3 position{0};
  glm::vec3 intensity{1};  // linear RGB radiant intensity: irradiance at distance d is intensity / d²
  float range =
      0;  // over 0: no light beyond. A scene file without it: where irradiance falls below kLeastIrradiance
  glm::vec3 direction{0, -1, 0};  // unit, from the lamp; of a spot
  float cosInner = -1,
        cosOuter = -1;  // full light within the inner, none outside the outer half angle; -1: all round
  bool shadow = false;
  float radius = 0;  // world units: of the ball that shines, for soft shadows
  // What it stands on: position and direction are in this node's coordinates then. Lengths are not scaled. None: the world.
  base::Id<Node> node{};
};
using LampId = Table<Lamp>::Id;

constexpr float kLeastIrradiance = 1e-3f;  // scene units
float rangeOf(glm::vec3 intensity);        // where its brightest channel falls to kLeastIrradiance

// In the world, by the matrix of the node that a light stands on.
struct LightPose {
  glm::vec3 position{0}, direction{0, -1, 0};
};
LightPose placeLight(const LightPose& light, const glm::mat4& node);

}  // namespace weft::scene
