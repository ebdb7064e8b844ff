// Cameras: where they stand at a time, and the matrices a shader's View block wants. Right-handed world, +Y
// up, view space looks along -Z; perspective is reversed-Z with an infinite far plane and [0,1] clip depth:
// the near plane maps to 1, infinity to 0 (glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE), depth test
// "greater"). Everything is a pure function of its arguments.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace weft::scene {

// A camera at one moment.
struct CameraPose {
  glm::dvec3 position{0, 0, 5};
  glm::dvec3 target{0, 0, 0};  // differs from position
  double fovDegrees = 60;      // vertical, over 0 and under 180
  double nearPlane = 0.1;      // world units, over 0
  double height = 0;  // over 0: orthographic, this many world units high, and kOrthographicReach of them deep
  glm::dvec3 up{0, 1, 0};  // of the picture, as far as the direction leaves it free
  friend bool operator==(const CameraPose&, const CameraPose&) = default;
};

// Depth of an orthographic view behind its near plane, in heights of its picture.
constexpr double kOrthographicReach = 100;

struct CameraKey {
  double time = 0;  // seconds, ascending within a path
  glm::dvec3 position{0};
  glm::dvec3 target{0};
  double fovDegrees = 60;
};

// A row of Scene::cameras. A path of keys replaces position, target and fov; an orbit turns the position
// about the vertical axis through the target. At most one of the two (the scene file says so when both are
// given).
struct Camera {
  std::string name;
  CameraPose pose{};                 // at time 0, without a path
  double orbitDegreesPerSecond = 0;  // positive is counter-clockwise seen from above (+Z towards +X)
  std::vector<CameraKey> path{};     // linear in between, held before the first and after the last
};

CameraPose poseAt(const Camera& camera, double time);
bool isMoving(const Camera& camera);

// What common/view.glsl declares, spelled the same. Matrices are column-major, world to view, view to clip and so on.
struct ViewData {
  glm::mat4 view{1}, projection{1}, view_projection{1}, inverse_view_projection{1};
  // The previous frame's view with the previous projection, but this frame's jitter: the difference of the
  // two projections of a point is its motion, free of jitter.
  glm::mat4 previous_view_projection{1};
  glm::vec3 eye{0}, previous_eye{0};
  float near_plane = 0.1f, target_distance = 1;
  glm::vec2 viewport{1};  // pixels
  glm::vec2 jitter{0};    // pixels; already in projection
  std::uint32_t frame = 0;
  float time = 0, delta_time = 0;  // seconds
};

struct ViewRequest {
  CameraPose pose, previousPose;
  glm::uvec2 viewport{1, 1};
  glm::vec2 jitter{0};  // pixels: a point moves this far right and up in the picture
  std::uint32_t frame = 0;
  double time = 0, deltaTime = 0;
};

ViewData makeView(const ViewRequest& request);
// One that stood still, without a jitter, at no moment.
ViewData viewOf(const glm::dmat4& view, const glm::dmat4& projection, glm::dvec3 eye, glm::vec2 viewport);

// The parts, for tests and for other views.
glm::dmat4 viewMatrix(
    const CameraPose& pose);  // straight down shows -Z upwards, straight up shows +Z upwards
glm::dmat4 projectionMatrix(double fovDegrees, double aspect, double nearPlane,
                            glm::dvec2 jitterNdc = {0, 0});

// The angle of view, degrees, of a lens of this focal length before a sensor of this height, both in one unit and over 0.
double fovOfLens(double focalLength, double sensorHeight);

// Offset of frame `frame` in [-0.5, 0.5) pixels: Halton (2, 3) with period `count`; zero when count is 0 or 1.
glm::vec2 jitterAt(std::uint32_t frame, std::uint32_t count);

}  // namespace weft::scene
