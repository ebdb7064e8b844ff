// A model file as a scene: the model at its own coordinates with its first animation, cameras that frame its box, and its
// lights; a sun where it has none.
// Does not: place anything else beside it; a scene file does (engine/scene/files/scene_file.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/assets/environments/environment_map.h"
#include "engine/base/diagnostic.h"
#include "engine/scene/scene.h"

namespace weft::scene {

// Cameras are `front`, `left`, `right`, `back` and `top`. `files`, when given, is set to everything that was read or should
// have been, also after errors.
std::optional<Scene> loadModelScene(const std::string& path, base::Diagnostics& diagnostics,
                                    std::vector<std::string>* files, const assets::LoadObserver& observer);

// A camera that looks along `towards`, a unit vector, at the whole of `box`.
CameraPose framePose(const Box& box, glm::dvec3 towards);

}  // namespace weft::scene
