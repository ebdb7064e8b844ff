// The person's camera: follows one of the scene, orbits, or flies. The same input over the same time gives the same path at any frame
// rate. Never rolls, never passes the poles. What a mouse can do makes no pose that is not finite.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "engine/scene/camera.h"

namespace weft::app {

// What a person did since the last frame.
struct CameraInput {
  glm::dvec2 turn{0};  // pixels of the mouse, right and down
  glm::dvec2 pan{0};   // the same, orbit only: slides the pivot in the picture's plane
  double wheel = 0;    // steps: nearer; flying: faster
  glm::dvec3 move{0};  // held keys, flying only: right, up, forward, each -1 to 1
  bool fast = false;   // held: flies four times as fast
  bool any() const {
    return turn != glm::dvec2(0) || pan != glm::dvec2(0) || wheel != 0 || move != glm::dvec3(0);
  }
};

class CameraRig {
 public:
  enum class Mode : std::uint8_t { scene, orbit, fly };

  static constexpr double kLongestFrame = 0.5;    // seconds; the rest of a longer one is lost, its mouse not
  static constexpr double kTurnPerPixel = 0.005;  // radians
  static constexpr double kMouseSeconds = 0.04;   // the view closes on the mouse with this time constant
  static constexpr double kFriction = 6;          // per second: speed falls to 1/e in 1/6 s without keys

  explicit CameraRig(const scene::CameraPose& pose) { jumpTo(pose); }

  // A cut: shows `pose` at once, at rest, as a camera of the scene.
  void jumpTo(const scene::CameraPose& pose);
  // In Mode::scene, where the scene's camera stands now. No cut.
  void follow(const scene::CameraPose& pose);
  // Keeps the pose, bit for bit until something moves.
  void setMode(Mode mode);
  Mode mode() const { return mode_; }

  // `seconds` have passed with this input. The first turn, pan or wheel in Mode::scene takes the camera to orbit.
  void advance(double seconds, CameraInput input);

  scene::CameraPose pose() const;
  std::uint64_t cuts() const { return cuts_; }
  // Whether it will be elsewhere after a while without input.
  bool moving() const;

  bool headBob = false;                    // flying: the view rises and sways with the way covered
  std::optional<double> ground;            // height that a camera above it does not orbit below
  double speed() const { return speed_; }  // flying: world units per second that held keys end up at

 private:
  // Angles in radians; in orbit `pivot` and `distance` rule, in flight `eye`.
  struct Aim {
    glm::dvec3 pivot{0};
    double yaw = 0, pitch = 0, distance = 1;
  };
  // How low the eye of an orbit may come: a little above the ground, unless it is there or below it already.
  double lowest() const;
  // A frame of more than no seconds.
  void fly(const CameraInput& in, double seconds, const glm::dvec3& back, const glm::dvec3& right);

  Mode mode_ = Mode::scene;
  std::optional<scene::CameraPose> exact_;  // what pose() says while nothing has moved
  scene::CameraPose lens_;                  // field of view and near plane
  Aim now_, goal_;                          // the view closes on the goal
  glm::dvec3 eye_{0}, velocity_{0};
  double bobPhase_ = 0, bobAmount_ = 0;  // radians; 0 to 1
  double speed_ = 1;
  glm::dvec3 keys_{0};  // held in the last frame
  std::uint64_t cuts_ = 0;
};

}  // namespace weft::app
