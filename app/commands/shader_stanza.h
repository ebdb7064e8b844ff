// What a shader by itself would need of a pass: a stanza of its slots, parameters and defines, made of what it declares.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "engine/gl/programs/program_cache.h"
#include "engine/glsl/source.h"

namespace weft::app {

struct ShaderStanza {
  nlohmann::ordered_json pass;  // names of slots stand for resources, too
  gl::ProgramRequest request;   // the variant in which every slot and parameter is there
};

// Of the file `path`, and of the other stage of a draw beside it. Nothing after errors.
std::optional<ShaderStanza> stanzaFor(const std::string& path, glsl::SourceLoader& sources,
                                      text::Diagnostics& diagnostics);

}  // namespace weft::app
