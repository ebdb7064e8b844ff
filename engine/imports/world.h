// What a frame is a picture of, on the CPU: the scene, the environment image, and the camera of a moment. Holds what
// imports are made from, and a generation for each so that `on_change` passes know when to run. No GL.
#pragma once

#include <cstdint>
#include <memory>

#include "engine/assets/images/image.h"
#include "engine/scene/scene.h"

namespace weft::text {
class FileCache;
}

namespace weft::imports {

// The facts of a scene and an environment that a graph can ask for: size(environment), count(spheres), has(environment).
struct WorldFacts {
  bool environment = false;  // one was loaded, or is on its way
  std::uint32_t environmentWidth = 1024, environmentHeight = 512;
  std::shared_ptr<const scene::Scene> scene = std::make_shared<const scene::Scene>();  // never null
  bool known = false;  // false: `scene` is in place of one that could not be read; nothing is said of it
  double spheresOf(const scene::Selection& list) const {
    return static_cast<double>(scene::Members(list, *scene).count(scene->spheres));
  }
  double meshesOf(const scene::Selection& list) const {
    return static_cast<double>(scene::Members(list, *scene).count(scene->meshInstances));
  }
  friend bool operator==(const WorldFacts&, const WorldFacts&) = default;
};

class World {
 public:
  explicit World(scene::Scene scene);

  const scene::Scene& scene() const { return *scene_; }
  void setScene(scene::Scene scene);
  std::uint64_t sceneGeneration() const { return sceneGeneration_; }

  // Null: none was loaded.
  const std::shared_ptr<const assets::EnvironmentMap>& environment() const { return environment_; }
  void setEnvironment(std::shared_ptr<const assets::EnvironmentMap> map);
  std::uint64_t environmentGeneration() const { return environmentGeneration_; }

  // The first environment is on its way. Until setEnvironment(), or expectEnvironment(false) when it failed, graphs are
  // expanded as if there were one, of WorldFacts' size, and Renderer::frame() shows black instead of those that read it.
  // The arrival changes the facts when the size differs: then the graph is to be applied again; what persists carries over.
  void expectEnvironment(bool expected = true) { environmentExpected_ = expected; }
  bool environmentPending() const { return environmentExpected_ && !environment_; }

  WorldFacts facts() const;

 private:
  std::shared_ptr<const scene::Scene> scene_;
  std::shared_ptr<const assets::EnvironmentMap> environment_;
  bool environmentExpected_ = false;
  std::uint64_t sceneGeneration_ = 1, environmentGeneration_ = 1;
};

// The mouse over the presented picture. Points are in its pixels from the lower left corner, as gl_FragCoord counts them.
struct Pointer {
  glm::vec2 position{0};  // where it was last over the picture
  glm::vec2 dragged{0};   // where it was last while the left button was held
  glm::vec2 pressed{0};   // where the left button last went down
  bool down = false;      // the left button is held
  bool clicked = false;   // it went down in this frame
  friend bool operator==(const Pointer&, const Pointer&) = default;
};

// One frame's inputs. In headless runs everything here comes from the frame number.
struct FrameInput {
  std::uint32_t frame = 0;
  double time = 0, deltaTime = 1.0 / 60.0;  // seconds
  scene::CameraPose pose, previousPose;
  std::uint64_t cutGeneration = 0;  // changes when the camera jumps
  Pointer pointer{};                // all zero when there is no mouse
  bool headless = true;             // publications of the first frame count as infinitely old
};

// Frame `frame` of the world's default camera at `fps` steps per second. `pointer` is that of every frame; a button that is
// held went down in frame 0.
FrameInput headlessFrame(const World& world, std::uint32_t frame, double fps, const Pointer& pointer = {});

// A buffer of the device; id 0: none.
struct BufferRef {
  std::uint32_t id = 0;
  std::uint64_t bytes = 0;
};

// What imports read from files, for whoever asks for facts and whoever uploads.
using Files = text::FileCache;

class CameraProvider;
class Providers;
class SceneTables;

// What a provider makes its textures, buffers and views from: the inputs of one frame, and what providers of one device
// share. A bundle of references, made anew for each call.
struct Frame {
  const World& world;
  const FrameInput& input;
  std::uint64_t number = 0;  // of the frames of this device; not input.frame, which may stand still or jump
  Files& files;
  SceneTables& tables;     // rows of the draw lists
  CameraProvider& camera;  // the scene's camera as it is
  Providers& providers;    // of other imports
  std::uint64_t& generations;

  // A generation that nothing on this device has had.
  std::uint64_t newGeneration() const { return ++generations; }
};

}  // namespace weft::imports
