#include "app/view/camera_rig.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace weft::app {

namespace {

constexpr double kPole = 1.55;  // radians: how far a person can look up and down
constexpr double kFastFactor = 4;
constexpr double kZoomPerStep = 0.9, kSpeedPerStep = 1.15;
constexpr double kFarthest = 1e5;
// Head-bob of a person whose eye is 1.7 high and who covers twice that in two steps, in units of speed.
constexpr double kBobPerUnit = 4.5, kBobRise = 0.012, kBobSway = 0.008;
constexpr double kBobSeconds = 0.15;  // the time constant with which it begins and ends

// Where a value is that closes on a goal with the time constant kMouseSeconds, after `dt` in which the goal went evenly by `by` to
// where it is: the solution of y' = (g(t) - y) / tau.
template <class T>
T followed(const T& value, const T& goal, const T& by, double dt) {
  if (dt == 0) return value;
  const double k = -std::expm1(-dt / CameraRig::kMouseSeconds);
  return value + (goal - by - value) * k + by * (1 - k * CameraRig::kMouseSeconds / dt);
}

glm::dvec3 backOf(double yaw, double pitch) {
  return {std::cos(pitch) * std::sin(yaw), std::sin(pitch), std::cos(pitch) * std::cos(yaw)};
}

}  // namespace

void CameraRig::jumpTo(const scene::CameraPose& pose) {
  ++cuts_;
  mode_ = Mode::scene;
  keys_ = {0, 0, 0};
  follow(pose);
  speed_ = std::max(now_.distance * 0.4, pose.nearPlane);
}

void CameraRig::follow(const scene::CameraPose& pose) {
  exact_ = lens_ = pose;
  const glm::dvec3 offset = pose.position - pose.target;
  velocity_ = {0, 0, 0};
  bobPhase_ = bobAmount_ = 0;
  eye_ = pose.position;
  const double distance = glm::length(offset);
  // Straight up and down have no yaw of their own: 0 is what viewMatrix() shows there.
  now_ = goal_ = {.pivot = pose.target,
                  .yaw = std::abs(offset.y) < distance * (1 - 1e-12) ? std::atan2(offset.x, offset.z) : 0,
                  .pitch = std::asin(std::clamp(offset.y / distance, -1.0, 1.0)),
                  .distance = distance};
}

void CameraRig::setMode(Mode mode) {
  if (mode == mode_) return;
  if (mode_ == Mode::fly) now_.pivot = eye_ - backOf(now_.yaw, now_.pitch) * now_.distance;
  velocity_ = {0, 0, 0};
  if (mode != Mode::fly) bobAmount_ = 0;
  // The rest of a smoothed pan or wheel movement is dropped.
  goal_.pivot = now_.pivot;
  goal_.distance = now_.distance;
  mode_ = mode;
}

double CameraRig::lowest() const {
  if (mode_ != Mode::orbit || !ground || eye_.y < *ground) return -std::numeric_limits<double>::infinity();
  return std::min(eye_.y, *ground + 2 * lens_.nearPlane);
}

void CameraRig::advance(double seconds, CameraInput in) {
  if (mode_ == Mode::scene) {
    in.move = {0, 0, 0};
    if (!in.any()) return;
    setMode(Mode::orbit);
  }
  if (in.any()) exact_.reset();
  keys_ = in.move;
  const double dt = std::clamp(seconds, 0.0, kLongestFrame), yaw = now_.yaw, pitch = now_.pitch;
  const double turned = -in.turn.x * kTurnPerPixel, tilt = goal_.pitch, low = lowest();
  goal_.yaw += turned;
  if (in.turn.y != 0) {
    const double least = std::asin(std::clamp((low - goal_.pivot.y) / goal_.distance, -1.0, 1.0));
    goal_.pitch =
        std::clamp(tilt + in.turn.y * kTurnPerPixel, std::clamp(std::min(least, tilt), -kPole, kPole), kPole);
  }
  now_.yaw = followed(yaw, goal_.yaw, turned, dt);
  now_.pitch = followed(pitch, goal_.pitch, goal_.pitch - tilt, dt);
  // The axes in the middle of the frame.
  const double middle = (yaw + now_.yaw) / 2;
  const glm::dvec3 back = backOf(middle, (pitch + now_.pitch) / 2),
                   right(std::cos(middle), 0, -std::sin(middle));
  if (mode_ == Mode::fly) {
    if (dt > 0) fly(in, dt, back, right);
    return;
  }
  const double distance = goal_.distance, rise = std::sin(goal_.pitch);
  goal_.distance = std::clamp(distance * std::pow(kZoomPerStep, in.wheel), lens_.nearPlane * 2, kFarthest);
  // At the ground the wheel and a pan end.
  if (goal_.pivot.y + rise * goal_.distance < low && rise * (goal_.distance - distance) < 0)
    goal_.distance = std::clamp((low - goal_.pivot.y) / rise, std::min(distance, goal_.distance),
                                std::max(distance, goal_.distance));
  const double unit =
      goal_.distance * std::tan(lens_.fovDegrees * std::numbers::pi / 360) / 360;  // of a pixel in 720
  glm::dvec3 slid = (glm::cross(back, right) * in.pan.y - right * in.pan.x) * unit;
  slid.y = std::max(slid.y, std::min(low - (goal_.pivot.y + rise * goal_.distance), 0.0));
  goal_.pivot += slid;
  now_.distance = followed(now_.distance, goal_.distance, goal_.distance - distance, dt);
  now_.pivot = followed(now_.pivot, goal_.pivot, slid, dt);
  eye_ = now_.pivot + backOf(now_.yaw, now_.pitch) * now_.distance;
  eye_.y = std::max(eye_.y, low);  // between the goals it may be lower than at both
}

// Speed closes on what the keys ask for: acceleration and friction in one, exact for a constant wish.
void CameraRig::fly(const CameraInput& in, double dt, const glm::dvec3& back, const glm::dvec3& right) {
  const double before = speed_;
  speed_ = std::clamp(speed_ * std::pow(kSpeedPerStep, in.wheel), 1e-3, kFarthest);
  const double speed = std::sqrt(before * speed_);  // in the middle of the frame
  glm::dvec3 wish = right * in.move.x + glm::dvec3(0, in.move.y, 0) - back * in.move.z;
  if (const double size = glm::length(wish); size > 1) wish /= size;
  wish *= speed * (in.fast ? kFastFactor : 1.0);
  const double kept = std::exp(-kFriction * dt);
  // The way covered while the speed closes on the wish, integrated over the frame.
  const glm::dvec3 way = wish * dt + (velocity_ - wish) * ((1 - kept) / kFriction);
  velocity_ = wish + (velocity_ - wish) * kept;
  if (glm::length(velocity_) < speed * 1e-4 && wish == glm::dvec3(0)) velocity_ = {0, 0, 0};
  eye_ += way;
  const double walk = glm::length(glm::dvec2(way.x, way.z));
  bobPhase_ += walk / speed * kBobPerUnit;
  const double wanted = headBob ? std::min(1.0, walk / (dt * speed)) : 0.0;
  bobAmount_ += (wanted - bobAmount_) * (1 - std::exp(-dt / kBobSeconds));
  if (wanted == 0 && bobAmount_ < 1e-4) bobAmount_ = 0;
  now_.pivot = eye_ - backOf(now_.yaw, now_.pitch) * now_.distance;
}

scene::CameraPose CameraRig::pose() const {
  if (exact_) return *exact_;
  const glm::dvec3 right(std::cos(now_.yaw), 0, -std::sin(now_.yaw));
  const glm::dvec3 sway =
      bobAmount_ * speed_ *
      (glm::dvec3(0, kBobRise * std::sin(2 * bobPhase_), 0) + right * (kBobSway * std::sin(bobPhase_)));
  scene::CameraPose pose = lens_;
  pose.up = {0, 1, 0};
  pose.position = eye_ + sway;
  pose.target = now_.pivot + sway;
  return pose;
}

bool CameraRig::moving() const {
  if (mode_ == Mode::scene) return false;
  const auto near = [](double a, double b, double scale) { return std::abs(a - b) < 1e-6 * scale; };
  const bool still = near(now_.yaw, goal_.yaw, 1) && near(now_.pitch, goal_.pitch, 1) &&
                     near(now_.distance, goal_.distance, goal_.distance) &&
                     (mode_ == Mode::fly || glm::length(now_.pivot - goal_.pivot) < 1e-6 * goal_.distance) &&
                     velocity_ == glm::dvec3(0) && bobAmount_ == 0 && keys_ == glm::dvec3(0);
  return !still;
}

}  // namespace weft::app
