// Keys of passes and textures in the files of other programs: Unity, Unreal, Falcor, Filament, Vulkan, three.js. A part of
// foreign_words.cpp, not for others. Does not: know the keys of Weft.
#pragma once

#include <span>

#include "engine/base/words/foreign_shader_names.h"

namespace weft::base {

std::span<const ForeignWord> foreignPassKeys();
std::span<const ForeignWord> foreignTextureKeys();

}  // namespace weft::base
