// Models whose reader is not fuzzed by its makers (Assimp) are read in a process of their own (engine/text/apart.h), so that a file
// which makes it crash, or take all memory or time, is one message. Internal to models, but for what main() calls.
#pragma once

#include <string>
#include <vector>

#include "engine/assets/model.h"
#include "engine/assets/models/parts/model_files.h"

namespace weft::assets {

// First argument of the process; its main() hands over to runModelReader().
constexpr const char* kModelWord = "read-model";

// The executable and what comes before kModelWord. Without, as in a program that embeds Weft, such models are read in this process.
// To be called before anything is read.
void readModelsApart(std::vector<std::string> command);

// As readFbx(), which it calls here or there.
bool readApart(std::string bytes, ModelFiles& files, const LoadObserver& observer,
               text::Diagnostics& diagnostics, Model& model);

[[noreturn]] void runModelReader();

}  // namespace weft::assets
