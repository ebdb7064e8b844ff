// FBX, read by Assimp, whose makers do not fuzz that reader: in a program of its own (reader.cpp), which makes glTF of the file. That
// is read and judged as any other, and a file that makes the program crash, or take all memory or time, is one message. Internal
// to models.
#pragma once

#include <optional>
#include <string>

#include "engine/assets/models/parts/model_files.h"

namespace weft::assets {

// What the process says at its end.
constexpr char kMade = 1, kUnreadable = 2, kTooLarge = 3;

// The bytes of a .glb. Its images that are not in it have the paths that the file gives them. Empty after W164, W201 for a text that
// is too large, or when the load was stopped.
std::optional<std::string> glbOfFbx(const std::string& bytes, ModelFiles& files);

}  // namespace weft::assets
