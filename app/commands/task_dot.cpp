// `weft dot --tasks`: what the CPU does for a frame, as a drawing.
#include <fmt/format.h>

#include <filesystem>

#include "app/commands/commands.h"
#include "app/output/standard_streams.h"
#include "app/session/session.h"
#include "engine/scene/frame/mesh_frame.h"
#include "engine/scene/frame/mesh_views.h"
#include "engine/scene/models/decode_work.h"
#include "engine/scene/probes/probe_work.h"

namespace weft::app {

int runTaskDot(const Options& options) {
  base::Diagnostics diagnostics;
  const auto scene = scene::loadScene(scenePathOf(options), diagnostics, nullptr, sceneChoiceOf(options));
  if (scene && !diagnostics.hasErrors()) {
    const scene::MeshFrame frame;
    const scene::MeshViews views;
    const scene::ProbeWork probes;
    const scene::DecodeWork decoding;
    const std::vector<std::string> lines = {
        fmt::format("{} nodes, {} animations, {} skins", scene->nodes.size(), scene->animations.size(),
                    scene->skins.size()),
        fmt::format("{} instances of {} meshes, {} spheres", scene->meshInstances.size(),
                    scene->meshes.size(), scene->spheres.size())};
    // Providers of imports make these on the thread that has the device; the sun's follows the box of the scene.
    const scene::FrameTask looks[] = {
        {"views", {"cameras", "lights in the world", "scene box"}, {"views"}, {}}};
    const scene::TaskGroup groups[] = {
        {"where meshes are", frame.tasks().tasks()},
        {"from where they are seen, on the thread of the device", looks},
        {"what each view sees of them", views.tasks().tasks()},
        {"light probes, beside the frames", probes.tasks().tasks()},
        {"images of models, while a scene is loaded beside the frames", decoding.tasks().tasks()},
    };
    print(scene::taskDot("frame of " + std::filesystem::path(scenePathOf(options)).filename().string(), lines,
                         groups));
  }
  return report(diagnostics);
}

}  // namespace weft::app
