#include "engine/imports/camera/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/imports/builtin.h"
#include "engine/scene/light_views.h"
#include "engine/text/nearest.h"

namespace weft::imports {

namespace {

using graph::Value;

double fovOf(const graph::ImportRequest& request) {
  const double focal = request.at("focal_length").v[0];
  const double sensor = std::clamp(request.at("sensor_height").v[0], 1e-3, 1e5);
  if (focal > 0) return scene::fovOfLens(std::clamp(focal, 0.01 * sensor, 1e4 * sensor), sensor);
  const double angle = request.at("angle").v[0];
  return angle > 0 ? std::clamp(angle, 1.0, 170.0) : 0;
}

glm::dvec3 pointOf(const Value& value) {
  return {value.v[0], value.v[1], value.v[2]};
}

std::vector<graph::ImportArgument> arguments() {
  const Value number = Value::number(0), origin = Value{Value::Type::list, 3, {}, {}};
  return {
      argument("jitter", number, "length of the sub-pixel Halton sequence; 0 for none"),
      argument("focal_length", number, "of its lens in mm: sets the angle of view; 0 for the scene's angle"),
      argument("sensor_height", Value::number(24), "mm that the picture's height stands for"),
      argument("name", Value::text(""), "of a camera of the scene; empty for the one that is looked through"),
      argument("position", origin, "world; it stands there when `target` differs"),
      argument("target", origin, "world; what it looks at from `position`"),
      argument("angle", number, "of view, vertical, degrees; 0 for the camera's"),
      argument("height", number, "over 0: orthographic, this many world units from bottom to top"),
      argument("around", Value::number(-1),
               "0 to 1: six views of 90 degrees, .face[f], from so far on the way to its target")};
}

}  // namespace

Columns<scene::ViewData> cameraColumns() {
  using Row = scene::ViewData;
  return {
      column<Row, &Row::eye>("position", "world"),
      column<Row, [](const Row& row) { return -glm::vec3(row.view[0][2], row.view[1][2], row.view[2][2]); }>(
          "direction", "unit, where it looks, world"),
      column<Row, &Row::near_plane>("near_plane",
                                    "world units before it; depth 1. A perspective has no far plane"),
      column<Row, &Row::target_distance>("target_distance", "from the eye to what it looks at"),
      column<Row,
             [](const Row& row) {
               const bool perspective = row.projection[2][3] != 0;
               return perspective ? 2 * std::atan(1 / row.projection[1][1]) * 180 / std::numbers::pi_v<float>
                                  : 0.0f;
             }>("angle", "of view, vertical, degrees; 0 of an orthographic one"),
      column<Row, &Row::view>("view", "world to what it sees, along -Z"),
      column<Row, &Row::projection>("projection",
                                    "that to clip space, with the picture's shape and its jitter"),
      column<Row, &Row::view_projection>("view_projection", "projection * view"),
      column<Row, &Row::inverse_view_projection>("inverse_view_projection")};
}

graph::ImportType CameraProvider::reflect() {
  return {.name = "camera",
          .kind = graph::ImportKind::view,
          .doc =
              "The scene's camera, or one that stands elsewhere. Declared under the name `camera` it is the "
              "view of every pass.",
          .arguments = arguments(),
          .columns = tell(cameraColumns()),
          .everyPass = true};
}

graph::ImportFacts CameraProvider::facts(const graph::ImportRequest& request, const WorldFacts& world,
                                         Files&) {
  graph::ImportFacts facts{.exists = true};
  const std::string& name = request.at("name").symbol;
  std::vector<std::string> known;
  for (const scene::Camera& camera : world.scene->cameras.rows()) known.push_back(camera.name);
  if (!name.empty() && !known.empty() && std::ranges::find(known, name) == known.end())
    facts.problems.push_back(badArgument(fmt::format("the scene has no camera '{}'", name), "", "",
                                         text::nearestHint(name, known)));
  return facts;
}

CameraProvider::CameraProvider(const graph::ImportRequest& request)
    : jitter_(static_cast<std::uint32_t>(std::clamp(request.at("jitter").v[0], 0.0, 4294967295.0))),
      around_(request.at("around").v[0]),
      poses_(placed(request)) {}

// Where a graph's own camera stands; empty: where the scene's does.
std::function<CameraProvider::Poses(const Frame&)> CameraProvider::placed(
    const graph::ImportRequest& request) {
  const std::string name = request.at("name").symbol;
  const glm::dvec3 position = pointOf(request.at("position"));
  const glm::dvec3 target = pointOf(request.at("target"));
  const double fov = fovOf(request), height = std::max(request.at("height").v[0], 0.0);
  const bool placed = position != target;
  if (name.empty() && !placed && fov == 0 && height == 0) return {};
  return [=](const Frame& frame) {
    const auto seen = [&](scene::CameraPose pose) {
      if (placed) {
        pose.position = position;
        pose.target = target;
      }
      if (fov > 0) pose.fovDegrees = fov;
      pose.height = height;
      return pose;
    };
    const FrameInput& input = frame.input;
    const scene::Camera* camera = name.empty() ? nullptr : scene::findCamera(frame.world.scene(), name);
    if (!camera) return std::pair(seen(input.pose), seen(input.previousPose));
    return std::pair(
        seen(scene::poseAt(*camera, input.time)),
        seen(scene::poseAt(*camera, input.frame == 0 ? input.time : input.time - input.deltaTime)));
  };
}

CameraProvider::Poses CameraProvider::posesOf(const Frame& frame) const {
  return poses_ ? poses_(frame) : std::pair(frame.input.pose, frame.input.previousPose);
}

std::uint64_t CameraProvider::generation(const Frame& frame) {
  const scene::CameraPose pose = posesOf(frame).first;
  if (generation_ == 0 || pose != seen_) generation_ = frame.newGeneration();
  seen_ = pose;
  return generation_;
}

const scene::ViewData& CameraProvider::view(const Frame& frame, const ViewPart& part) {
  const glm::uvec2 size(part.width, part.height);
  if (around_ >= 0) {
    const scene::CameraPose pose = posesOf(frame).first;
    const glm::vec3 eye(glm::mix(pose.position, pose.target, std::min(around_, 1.0)));
    return data_ = scene::cubeView(eye, static_cast<float>(pose.nearPlane), part.face, part.width);
  }
  if (made_ == frame.number && size == size_) return data_;
  const FrameInput& input = frame.input;
  const auto [pose, previous] = posesOf(frame);
  data_ = scene::makeView({.pose = pose,
                           .previousPose = previous,
                           .viewport = size,
                           .jitter = scene::jitterAt(input.frame, jitter_),
                           .frame = input.frame,
                           .time = input.time,
                           .deltaTime = input.deltaTime});
  made_ = frame.number;
  size_ = size;
  return data_;
}

std::unique_ptr<Import> makeCamera() {
  return std::make_unique<ImportOf<CameraProvider>>();
}

}  // namespace weft::imports
