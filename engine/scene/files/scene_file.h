// Scene files (scenes/*.json) to Scene. Everything wrong is reported at once: JSON mistakes as W002..W006 with
// their place, values out of range and an unknown camera as W160, unknown materials as W161, unknown draw
// lists as W162, unknown animations as W169, and what its material library and its models report. The format is described in docs/scenes.md.
#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/scene.h"
#include "engine/text/diagnostic.h"

namespace weft::scene {

// What is chosen from outside the file. Empty: as the file says.
struct SceneChoice {
  // Becomes the first, the default one; unknown: W160. A name, or a place to look from, a point to look at and, where they are not
  // those of the first camera, degrees of view and the near plane: "X,Y,Z,X,Y,Z,60,0.1".
  std::string camera;
  std::string materials;  // path of a library in place of the grid's `materials`; without a grid: W161
};

// A model file (.gltf, .glb, .obj, .fbx) is a scene too: the model at its own coordinates with its first animation, cameras that frame
// its box, and its lights, or a sun. `stop` ends the loading of models: empty then, without a message.
// Paths in the file are relative to it. Empty after any error. `files`, when given, is set to every file that took part or should have,
// also after errors: what to watch.
std::optional<Scene> loadScene(const std::string& path, text::Diagnostics& diagnostics,
                               std::vector<std::string>* files = nullptr, const SceneChoice& choice = {},
                               const std::stop_token& stop = {});

// The presets of a material library (materials/*.json): an array of {"name", "albedo", "metallic", "roughness"} and, where known,
// "category" and "source". W155 for a value out of range, W156 for a name that is there twice.
std::optional<std::vector<Material>> readMaterialLibrary(std::string_view text, const std::string& name,
                                                         text::Diagnostics& diagnostics);

// Whether a scene has models to load, as far as its file can be read: for whoever wants to show something meanwhile.
bool namesModels(const std::string& path);

}  // namespace weft::scene
