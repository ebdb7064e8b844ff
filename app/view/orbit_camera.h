// Orbit around the target of a pose: drags turn, the wheel moves nearer and farther. Never rolls, never
// reaches the poles. Does not: know keys or windows, smooth, or move the target.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "engine/scene/camera.h"

namespace weft::app {

class OrbitCamera {
 public:
  explicit OrbitCamera(const scene::CameraPose& pose) : pose_(pose) {
    const glm::dvec3 offset = pose.position - pose.target;
    distance_ = glm::length(offset);
    yaw_ = std::atan2(offset.x, offset.z);
    pitch_ = std::asin(std::clamp(offset.y / distance_, -1.0, 1.0));
  }
  // By pixels of the mouse.
  void turn(double dx, double dy) {
    yaw_ -= dx * 0.005;
    pitch_ = std::clamp(pitch_ + dy * 0.005, -1.55, 1.55);
  }
  void zoom(double steps) {
    distance_ = std::clamp(distance_ * std::pow(0.9, steps), pose_.nearPlane * 2, 1e5);
  }
  scene::CameraPose pose() const {
    scene::CameraPose pose = pose_;
    const glm::dvec3 direction(std::cos(pitch_) * std::sin(yaw_), std::sin(pitch_),
                               std::cos(pitch_) * std::cos(yaw_));
    pose.position = pose.target + direction * distance_;
    return pose;
  }

 private:
  scene::CameraPose pose_;
  double yaw_ = 0, pitch_ = 0, distance_ = 1;  // radians; world units
};

}  // namespace weft::app
