#include "app/bench/task_bench.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "app/session/session.h"
#include "engine/base/printable.h"
#include "engine/scene/camera.h"
#include "engine/scene/files/scene_file.h"
#include "engine/scene/frame/mesh_frame.h"
#include "engine/scene/frame/mesh_views.h"
#include "engine/scene/light_views.h"

namespace weft::app {

namespace {

using nlohmann::ordered_json;
using scene::DrawList;
using scene::MeshOrder;

constexpr int kFrames = 150, kUnmeasured = 2;
constexpr int kBetweenLooks = 10;  // frames that are measured and not compared
constexpr double kFramesPerSecond = 60;
constexpr std::uint32_t kSunTexels = 2048;
constexpr glm::uvec2 kScreen{1920, 1080};

struct Look {
  const char* name;
  DrawList list;
  MeshOrder order;
  bool sun = false;
};
// The views of graphs/deferred.json; the last draws opaque meshes in the order of transparent ones.
constexpr Look kLooks[] = {{"camera", DrawList::opaque, MeshOrder::by_mesh},
                           {"sun", DrawList::shadow_casters, MeshOrder::by_mesh, true},
                           {"camera, back to front", DrawList::opaque, MeshOrder::back_to_front}};

struct Samples {
  std::vector<double> wall, processor;  // microseconds, one per frame
};

// The frames of one number of threads.
struct Course {
  int threads = 1;
  scene::MeshFrame frame;
  scene::MeshViews views;
  std::vector<scene::MeshView> seen{std::size(kLooks)};
  Samples whole;
  std::vector<Samples> stages;  // tasks of `frame`, then of `views`
};

scene::ViewData viewOf(const scene::Scene& scene, const Look& look, const scene::MeshFrame& frame,
                       double time) {
  if (look.sun)
    return scene::sunView(frame.sun().value_or(scene::Sun{}), frame.sceneBounds(), kSunTexels).view;
  const scene::CameraPose pose = scene::poseAt(*scene::findCamera(scene, ""), time);
  return scene::makeView({.pose = pose, .previousPose = pose, .viewport = kScreen, .time = time});
}

void runFrame(Course& course, const scene::Scene& scene, int number) {
  const double time = number / kFramesPerSecond;
  const auto began = std::chrono::steady_clock::now();
  course.frame.update(scene, 1, time, time - 1 / kFramesPerSecond);
  std::vector<scene::MeshView*> views;
  for (std::size_t i = 0; i < std::size(kLooks); ++i) {
    const scene::ViewData view = viewOf(scene, kLooks[i], course.frame, time);
    course.seen[i].look(kLooks[i].list, view.view, view.view_projection, kLooks[i].order);
    views.push_back(&course.seen[i]);
  }
  course.views.update(scene, course.frame, views);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  if (number < kUnmeasured) return;
  course.whole.wall.push_back(took.count() * 1e6);
  double processor = 0;
  std::size_t stage = 0;
  for (const scene::FrameTasks* tasks : {&course.frame.tasks(), &course.views.tasks()})
    for (std::size_t i = 0; i < tasks->tasks().size(); ++i, ++stage) {
      if (stage == course.stages.size()) course.stages.emplace_back();
      course.stages[stage].wall.push_back(tasks->seconds()[i] * 1e6);
      course.stages[stage].processor.push_back(tasks->processorSeconds()[i] * 1e6);
      processor += tasks->processorSeconds()[i] * 1e6;
    }
  course.whole.processor.push_back(processor);
}

template <class T>
bool areSame(std::span<const T> a, std::span<const T> b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

bool madeTheSame(const Course& a, const Course& b) {
  bool same = areSame(a.frame.joints(), b.frame.joints()) && a.frame.sceneBounds() == b.frame.sceneBounds();
  for (const Look& look : kLooks)
    same = same && areSame(a.frame.rows(look.list), b.frame.rows(look.list)) &&
           areSame(a.frame.bounds(look.list), b.frame.bounds(look.list));
  for (std::size_t i = 0; i < a.seen.size(); ++i)
    same = same && areSame(a.seen[i].visible(), b.seen[i].visible()) &&
           areSame(a.seen[i].commands(), b.seen[i].commands());
  return same;
}

double tenths(double value) {
  return std::round(value * 10) / 10;
}

ordered_json toJson(Samples& samples) {
  std::ranges::sort(samples.wall);
  std::ranges::sort(samples.processor);
  return {{"us", tenths(samples.wall.front())},
          {"cpu_us", tenths(samples.processor[samples.processor.size() / 2])}};
}

ordered_json toJson(Course& course) {
  const ordered_json whole = toJson(course.whole);
  ordered_json stages = ordered_json::array();
  std::size_t stage = 0;
  for (const scene::FrameTasks* tasks : {&course.frame.tasks(), &course.views.tasks()})
    for (const scene::FrameTask& task : tasks->tasks()) {
      ordered_json each{{"stage", task.name}};
      each.update(toJson(course.stages[stage++]));
      stages.push_back(std::move(each));
    }
  return {{"threads", course.threads},
          {"frame_us", whole["us"]},
          {"cpu_us", whole["cpu_us"]},
          {"stages", std::move(stages)}};
}

}  // namespace

std::optional<std::string> benchTasks(const Options& options, base::Diagnostics& diagnostics) {
  const std::string path = options.scene.empty() ? dataFolder() + "/scenes/crowd.json" : options.scene;
  const auto scene = scene::loadScene(path, diagnostics, nullptr, sceneChoiceOf(options));
  if (!scene || diagnostics.hasErrors()) return std::nullopt;
  Course courses[2];
  for (int i = 0; i < 2; ++i) {
    Course& course = courses[i];
    course.threads = i + 1;
    course.frame.setThreads(course.threads);
    course.views.setThreads(course.threads);
    course.frame.tasks().measureProcessors(true);
    course.views.tasks().measureProcessors(true);
  }
  bool same = true;
  for (int number = 0; number < kFrames + kUnmeasured; ++number) {
    for (Course& course : courses) runFrame(course, *scene, number);
    if (number % kBetweenLooks == 0) same = same && madeTheSame(courses[0], courses[1]);
  }
  ordered_json views = ordered_json::array(), runs = ordered_json::array();
  for (std::size_t i = 0; i < std::size(kLooks); ++i)
    views.push_back({{"view", kLooks[i].name}, {"visible", courses[0].seen[i].visible().size()}});
  for (Course& course : courses) runs.push_back(toJson(course));
  const ordered_json all{{"scene", std::filesystem::path(path).filename().string()},
                         {"instances", scene->meshInstances.size()},
                         {"moving_nodes", courses[0].frame.movingNodes()},
                         {"frames", kFrames},
                         {"views", std::move(views)},
                         {"same_bytes", same},
                         {"runs", std::move(runs)}};
  return base::printableJson(all.dump(2, ' ', false, ordered_json::error_handler_t::replace));
}

}  // namespace weft::app
