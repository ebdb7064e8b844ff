// FBX, read by Assimp, whose makers do not fuzz that reader: in a process of its own (engine/text/apart.h), which makes glTF of the
// file. That is read and judged as any other, and a file that makes the process crash, or take all memory or time, is one
// message. Internal to models, but for what main() calls.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/assets/models/parts/model_files.h"

namespace weft::assets {

// First argument of the process; its main() hands over to runModelReader(), with the arguments from that word on.
constexpr const char* kModelWord = "read-model";
[[noreturn]] void runModelReader(int argc, char** argv);

// The executable and what comes before kModelWord. Without, as in a program that embeds Weft, such models are read in this process.
// To be called before anything is read.
void readModelsApart(std::vector<std::string> command);

// The bytes of a .glb. Its images that are not in it have the paths that the file gives them. Empty after W164, W201 for a text that
// is too large, or when the observer gave up.
std::optional<std::string> glbOfFbx(const std::string& bytes, ModelFiles& files);

}  // namespace weft::assets
