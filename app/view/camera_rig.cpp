#include "app/view/camera_rig.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::app {

namespace {

constexpr double kPole = 1.55;  // radians: how far a person can look up and down
constexpr double kFastFactor = 4;
constexpr double kZoomPerStep = 0.9, kSpeedPerStep = 1.15;
constexpr double kFarthest = 1e5;
// Head-bob of a person whose eye is 1.7 high and who covers twice that in a pair of steps; all in units of
// speed.
constexpr double kBobPerUnit = 4.5, kBobRise = 0.012, kBobSway = 0.008;

double finite(double x, double low, double high) {
  return std::isfinite(x) ? std::clamp(x, low, high) : 0.0;
}

glm::dvec2 finite(glm::dvec2 v) {
  return {finite(v.x, -1e5, 1e5), finite(v.y, -1e5, 1e5)};
}

// How much of the way to a goal is covered in a step.
double closing(double timeConstant) {
  return 1 - std::exp(-CameraRig::kStep / timeConstant);
}

}  // namespace

glm::dvec3 CameraRig::backOf(double yaw, double pitch) {
  return {std::cos(pitch) * std::sin(yaw), std::sin(pitch), std::cos(pitch) * std::cos(yaw)};
}

void CameraRig::jumpTo(const scene::CameraPose& pose) {
  ++cuts_;
  mode_ = Mode::scene;
  pending_ = {};
  rest_ = 0;
  follow(pose);
  speed_ = std::max(now_.distance * 0.4, pose.nearPlane);
}

void CameraRig::follow(const scene::CameraPose& pose) {
  exact_ = lens_ = pose;
  const glm::dvec3 offset = pose.position - pose.target;
  now_ = {};
  now_.eye = pose.position;
  now_.pivot = goalPivot_ = pose.target;
  now_.distance = goalDistance_ = glm::length(offset);
  // Straight up and down have no yaw of their own: 0 is what viewMatrix() shows there.
  now_.yaw = goalYaw_ = std::abs(offset.y) < now_.distance * (1 - 1e-12) ? std::atan2(offset.x, offset.z) : 0;
  now_.pitch = goalPitch_ = std::asin(std::clamp(offset.y / now_.distance, -1.0, 1.0));
  before_ = now_;
}

void CameraRig::setMode(Mode mode) {
  if (mode == mode_) return;
  for (State* state : {&before_, &now_}) {
    if (mode_ == Mode::fly) state->pivot = state->eye - backOf(state->yaw, state->pitch) * state->distance;
    state->velocity = {0, 0, 0};
    if (mode != Mode::fly) state->bobAmount = 0;
  }
  // The rest of a smoothed pan or wheel movement is dropped.
  goalPivot_ = now_.pivot;
  goalDistance_ = now_.distance;
  mode_ = mode;
}

void CameraRig::advance(double seconds, const CameraInput& raw) {
  CameraInput input = raw;
  input.turn = finite(raw.turn);
  input.pan = finite(raw.pan);
  input.wheel = finite(raw.wheel, -100, 100);
  input.move = {finite(raw.move.x, -1, 1), finite(raw.move.y, -1, 1), finite(raw.move.z, -1, 1)};
  if (mode_ == Mode::scene) {
    input.move = {0, 0, 0};
    if (!input.any()) return;
    setMode(Mode::orbit);
  }
  const double length = finite(seconds, 0, kLongestFrame);
  double covered = 0;
  const auto share = [&](double until) {
    const double part = length > 0 ? (until - covered) / length : 1;
    covered = until;
    pending_.turn += input.turn * part;
    pending_.pan += input.pan * part;
    pending_.wheel += input.wheel * part;
  };
  pending_.move = input.move;
  pending_.fast = input.fast;
  // Rounding must not decide whether there is one step more or less: twice 1/120 s is a step.
  while (rest_ + (length - covered) >= kStep * (1 - 1e-9)) {
    share(std::clamp(covered + kStep - rest_, covered, length));
    rest_ = 0;
    step(pending_);
    pending_.turn = pending_.pan = {0, 0};
    pending_.wheel = 0;
  }
  rest_ = std::min(rest_ + (length - covered), kStep);
  share(length);
}

void CameraRig::step(const CameraInput& in) {
  before_ = now_;
  if (in.any()) exact_.reset();
  const double turned = in.turn.y * kTurnPerPixel;
  goalYaw_ -= in.turn.x * kTurnPerPixel;
  if (turned != 0) goalPitch_ = std::clamp(goalPitch_ + turned, -kPole, kPole);
  const double k = closing(kMouseSeconds);
  now_.yaw += (goalYaw_ - now_.yaw) * k;
  now_.pitch += (goalPitch_ - now_.pitch) * k;
  if (mode_ == Mode::fly) {
    flyStep(in);
    return;
  }
  goalDistance_ =
      std::clamp(goalDistance_ * std::pow(kZoomPerStep, in.wheel), lens_.nearPlane * 2, kFarthest);
  const glm::dvec3 back = backOf(now_.yaw, now_.pitch), right(std::cos(now_.yaw), 0, -std::sin(now_.yaw));
  const double unit =
      goalDistance_ * std::tan(lens_.fovDegrees * std::numbers::pi / 360) / 360;  // of a pixel in 720
  goalPivot_ += (glm::cross(back, right) * in.pan.y - right * in.pan.x) * unit;
  now_.distance += (goalDistance_ - now_.distance) * k;
  now_.pivot += (goalPivot_ - now_.pivot) * k;
  place(now_);
}

// Speed closes on what the keys ask for: acceleration and friction in one, exact for a constant wish.
void CameraRig::flyStep(const CameraInput& in) {
  speed_ = std::clamp(speed_ * std::pow(kSpeedPerStep, in.wheel), 1e-3, kFarthest);
  const glm::dvec3 back = backOf(now_.yaw, now_.pitch), right(std::cos(now_.yaw), 0, -std::sin(now_.yaw));
  glm::dvec3 wish = right * in.move.x + glm::dvec3(0, in.move.y, 0) - back * in.move.z;
  if (const double size = glm::length(wish); size > 1) wish /= size;
  wish *= speed_ * (in.fast ? kFastFactor : 1.0);
  const double kept = std::exp(-kFriction * kStep);
  // The way covered while the speed closes on the wish, integrated over the step.
  const glm::dvec3 way = wish * kStep + (now_.velocity - wish) * ((1 - kept) / kFriction);
  now_.velocity = wish + (now_.velocity - wish) * kept;
  if (glm::length(now_.velocity) < speed_ * 1e-4 && wish == glm::dvec3(0)) now_.velocity = {0, 0, 0};
  now_.eye += way;
  const double walk = glm::length(glm::dvec2(way.x, way.z));
  now_.bobPhase += walk / speed_ * kBobPerUnit;
  const double wanted = headBob ? std::min(1.0, walk / (kStep * speed_)) : 0.0;
  now_.bobAmount += (wanted - now_.bobAmount) * closing(0.15);
  if (wanted == 0 && now_.bobAmount < 1e-4) now_.bobAmount = 0;
  place(now_);
}

// In flight the eye gives the pivot; otherwise the pivot gives the eye.
void CameraRig::place(State& state) const {
  const glm::dvec3 back = backOf(state.yaw, state.pitch) * state.distance;
  if (mode_ == Mode::fly)
    state.pivot = state.eye - back;
  else
    state.eye = state.pivot + back;
}

scene::CameraPose CameraRig::pose() const {
  if (exact_) return *exact_;
  const double f = std::clamp(rest_ / kStep, 0.0, 1.0);
  const auto mix = [f](const auto& a, const auto& b) { return a + (b - a) * f; };
  State state;
  state.yaw = mix(before_.yaw, now_.yaw);
  state.pitch = mix(before_.pitch, now_.pitch);
  state.distance = mix(before_.distance, now_.distance);
  state.pivot = mix(before_.pivot, now_.pivot);
  state.eye = mix(before_.eye, now_.eye);
  place(state);
  const double bob = mix(before_.bobAmount, now_.bobAmount), phase = mix(before_.bobPhase, now_.bobPhase);
  const glm::dvec3 right(std::cos(state.yaw), 0, -std::sin(state.yaw));
  const glm::dvec3 sway =
      bob * speed_ *
      (glm::dvec3(0, kBobRise * std::sin(2 * phase), 0) + right * (kBobSway * std::sin(phase)));
  scene::CameraPose pose = lens_;
  pose.position = state.eye + sway;
  pose.target = state.pivot + sway;
  return pose;
}

bool CameraRig::moving() const {
  if (mode_ == Mode::scene) return false;
  const auto near = [](double a, double b, double scale) { return std::abs(a - b) < 1e-6 * scale; };
  const bool still = near(now_.yaw, goalYaw_, 1) && near(now_.pitch, goalPitch_, 1) &&
                     near(now_.distance, goalDistance_, goalDistance_) &&
                     (mode_ == Mode::fly || glm::length(now_.pivot - goalPivot_) < 1e-6 * goalDistance_) &&
                     now_.velocity == glm::dvec3(0) && now_.bobAmount == 0 && pending_.move == glm::dvec3(0);
  return !still || pending_.turn != glm::dvec2(0) || pending_.pan != glm::dvec2(0) || pending_.wheel != 0;
}

}  // namespace weft::app
