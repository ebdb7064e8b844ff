// What Assimp 5.2.5 does not survive, or answers with minutes and gigabytes: OBJ files of one endless line, faces of a
// million corners; FBX files whose records reach beyond the file, nest without end, unpack
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

struct ModelCounts {
  std::uint64_t vertices = 0, corners = 0;
  std::uint64_t unpacked = 0;  // bytes that packed arrays hold
  bool colorless = false;      // some vertices of an OBJ file have no color
};

ModelProblem checkObj(std::string_view bytes, ModelCounts& counts);
ModelProblem checkFbx(std::string_view bytes, ModelCounts& counts);
bool isBinaryFbx(std::string_view bytes);

// Wavefront OBJ and FBX to a Model, through Assimp. `obj`: else FBX. False after errors, or when `observer` gave up.
bool readWithAssimp(std::string bytes, bool obj, ModelFiles& files, const LoadObserver& observer,
                    text::Diagnostics& diagnostics, Model& model);

}  // namespace weft::assets
