// What Assimp 5.2.5 does not survive, or answers with minutes and gigabytes: FBX files whose records reach beyond the file, nest without end, unpack
// to more than memory, or whose nodes are their own ancestors. These functions walk a file's structure without making
// anything of it. Internal to the folder.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/assets/model.h"
#include "engine/assets/models/parts/model_files.h"

namespace weft::assets {

// What is wrong with a file; `message` is empty when nothing is.
struct ModelProblem {
  std::string message, expected, found;
  std::uint32_t line = 0;  // of a text file
};

// `unpacked`: bytes that packed arrays hold.
ModelProblem checkFbx(std::string_view bytes, std::uint64_t& unpacked);
bool isBinaryFbx(std::string_view bytes);

// FBX to a Model, through Assimp. False after errors, or when `observer` gave up.
bool readFbx(std::string bytes, ModelFiles& files, const LoadObserver& observer,
             text::Diagnostics& diagnostics, Model& model);

}  // namespace weft::assets
