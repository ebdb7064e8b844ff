// Logs of shader compilers and linkers as diagnostics with true places.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "engine/glsl/source.h"
#include "engine/text/diagnostic.h"

namespace weft::gl {

// Turns the log of a glsl::assembleSource() text into one diagnostic per message, with its true place. Understands Mesa's
// "0:12(5): error: text", NVIDIA's "0(12) : error C1234: text" and the common "ERROR: 0:12: text". Other lines become
// part of the message before them, or a message at the file itself. The driver's words stay. A name that is not declared gets a
// hint, such as the nearest one that is; of the errors of one line one is kept. `code` is W104 (compile) or W105 (link).
// `defines`: those the text was assembled with. Returns how many diagnostics were added.
std::size_t mapLog(std::string_view log, const glsl::ShaderSource& source, text::Code code,
                   text::Diagnostics& diagnostics, std::span<const glsl::Define> defines = {});

}  // namespace weft::gl
