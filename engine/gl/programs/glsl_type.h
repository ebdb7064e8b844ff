// The table behind glslTypeName and shapeOf (program.h), with what introspection needs besides. Not for other
// rooms.
#pragma once

#include "engine/gl/programs/program.h"

namespace weft::gl {

enum class GlslKind : std::uint8_t { value, sampler, image };

struct GlslType {
  GLenum type;
  const char* name;
  GlslKind kind;
  TypeShape shape;  // of values
};

// Null for a type this engine does not know.
const GlslType* findGlslType(GLenum type);
const GlslType* findGlslType(std::string_view name);

}  // namespace weft::gl
