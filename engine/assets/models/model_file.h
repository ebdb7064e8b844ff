// Model files to Model: .gltf and .glb, .obj, and .fbx, of which a program of its own makes a .glb. Everything that a model
// names is looked for in its own folder and nowhere else. Failures are values: W164 (cannot be read), W165 (a value that
// cannot be), W166 (a file outside the folder), W201 (too many bytes, vertices or texels); warnings W167 (a
// texture is missing) and W168 (a part was left out). Thread safe: no state is shared between calls.
#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/assets/model.h"
#include "engine/text/diagnostic.h"

namespace weft::assets {

// Whether a name is that of a model, by its end.
bool isModelName(const std::string& name);

// Empty after errors, and without any when `stop` ended it. `files`, when given, is set to everything that was read or
// should have been, also after errors: what to watch.
std::optional<Model> loadModel(const std::string& path, text::Diagnostics& diagnostics,
                               const std::stop_token& stop = {}, std::vector<std::string>* files = nullptr);

}  // namespace weft::assets
