#include "engine/scene/camera.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

namespace weft::scene {

namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

// Radical inverse of `index` in `base` (Halton 1964).
double radicalInverse(std::uint32_t index, std::uint32_t base) {
  double result = 0, digit = 1.0 / base;
  for (; index > 0; index /= base, digit /= base) result += digit * (index % base);
  return result;
}

// Depth 1 at `nearPlane`, 0 at nearPlane + reach.
glm::dmat4 orthographicMatrix(double height, double aspect, double nearPlane, double reach,
                              glm::dvec2 jitterNdc) {
  assert(height > 0 && aspect > 0 && reach > 0);
  glm::dmat4 projection(1);
  projection[0][0] = 2 / (height * aspect);
  projection[1][1] = 2 / height;
  projection[2][2] = 1 / reach;
  projection[3] = {jitterNdc.x, jitterNdc.y, (nearPlane + reach) / reach, 1};
  return projection;
}

}  // namespace

CameraPose poseAt(const Camera& camera, double time) {
  CameraPose pose = camera.pose;
  if (!camera.path.empty()) {
    const auto after = std::upper_bound(camera.path.begin(), camera.path.end(), time,
                                        [](double t, const CameraKey& key) { return t < key.time; });
    const CameraKey& b = after == camera.path.end() ? camera.path.back() : *after;
    const CameraKey& a = after == camera.path.begin() ? camera.path.front() : *(after - 1);
    const double f = b.time > a.time ? (time - a.time) / (b.time - a.time) : 0;
    pose.position = a.position + (b.position - a.position) * f;
    pose.target = a.target + (b.target - a.target) * f;
    pose.fovDegrees = a.fovDegrees + (b.fovDegrees - a.fovDegrees) * f;
    return pose;
  }
  if (camera.orbitDegreesPerSecond != 0 && time != 0) {
    const double radians = std::fmod(camera.orbitDegreesPerSecond * time, 360.0) * kRadiansPerDegree;
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1), radians, glm::dvec3(0, 1, 0)));
    pose.position = pose.target + turn * (pose.position - pose.target);
  }
  return pose;
}

bool isMoving(const Camera& camera) {
  return camera.path.size() > 1 || camera.orbitDegreesPerSecond != 0;
}

glm::dmat4 viewMatrix(const CameraPose& pose) {
  const double back = glm::dot(glm::normalize(pose.position - pose.target), pose.up);
  const bool vertical = std::abs(back) > 1 - 1e-12;
  return glm::lookAt(pose.position, pose.target, vertical ? glm::dvec3(0, 0, back > 0 ? -1 : 1) : pose.up);
}

// Upchurch and Desbrun, "Tightening the Precision of Perspective Rendering", 2012: reversed, far plane at infinity.
glm::dmat4 projectionMatrix(double fovDegrees, double aspect, double nearPlane, glm::dvec2 jitterNdc) {
  assert(fovDegrees > 0 && fovDegrees < 180 && aspect > 0 && nearPlane > 0);
  const double f = 1 / std::tan(fovDegrees * kRadiansPerDegree / 2);
  glm::dmat4 projection(0);
  projection[0][0] = f / aspect;
  projection[1][1] = f;
  projection[2] = {-jitterNdc.x, -jitterNdc.y, 0, -1};
  projection[3][2] = nearPlane;
  return projection;
}

ViewData viewOf(const glm::dmat4& view, const glm::dmat4& projection, glm::dvec3 eye, glm::vec2 viewport) {
  ViewData data;
  data.view = glm::mat4(view);
  data.projection = glm::mat4(projection);
  data.view_projection = data.previous_view_projection = glm::mat4(projection * view);
  data.inverse_view_projection = glm::mat4(glm::inverse(view) * glm::inverse(projection));
  data.eye = data.previous_eye = glm::vec3(eye);
  data.viewport = viewport;
  return data;
}

ViewData makeView(const ViewRequest& request) {
  assert(request.viewport.x > 0 && request.viewport.y > 0);
  const glm::dvec2 size(request.viewport);
  const glm::dvec2 jitter = glm::dvec2(request.jitter) * 2.0 / size;
  const auto projectionOf = [&](const CameraPose& pose) {
    if (pose.height > 0)
      return orthographicMatrix(pose.height, size.x / size.y, pose.nearPlane,
                                kOrthographicReach * pose.height, jitter);
    return projectionMatrix(pose.fovDegrees, size.x / size.y, pose.nearPlane, jitter);
  };
  ViewData data = viewOf(viewMatrix(request.pose), projectionOf(request.pose), request.pose.position,
                         glm::vec2(request.viewport));
  data.previous_view_projection =
      glm::mat4(projectionOf(request.previousPose) * viewMatrix(request.previousPose));
  data.previous_eye = glm::vec3(request.previousPose.position);
  data.near_plane = static_cast<float>(request.pose.nearPlane);
  data.target_distance = static_cast<float>(glm::distance(request.pose.position, request.pose.target));
  data.jitter = request.jitter;
  data.frame = request.frame;
  data.time = static_cast<float>(request.time);
  data.delta_time = static_cast<float>(request.deltaTime);
  return data;
}

double fovOfLens(double focalLength, double sensorHeight) {
  return 2 * std::atan(sensorHeight / (2 * focalLength)) / kRadiansPerDegree;
}

glm::vec2 jitterAt(std::uint32_t frame, std::uint32_t count) {
  if (count <= 1) return {0, 0};
  const std::uint32_t index = frame % count + 1;  // element 0 of the sequence is the corner
  return {static_cast<float>(radicalInverse(index, 2) - 0.5),
          static_cast<float>(radicalInverse(index, 3) - 0.5)};
}

}  // namespace weft::scene
