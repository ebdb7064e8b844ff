// A pass type: what a graph may write of it (reflect), and the GL calls of such a pass (execute). When execute() is called,
// the executor has bound program, vertex array, textures, buffers, framebuffer, viewport and fixed-function state.
// CONTRIBUTING.md says how to add one.
#pragma once

#include <glad/gl.h>

#include <cstdint>

#include "engine/graph/flat_graph.h"
#include "engine/graph/registry.h"

namespace weft::passes {

// A range of levels and layers of a texture, as bound for a pass type without a shader.
struct BoundTexture {
  // A view of exactly the levels and layers below, or the texture itself; of a type with framebuffers all levels and layers.
  GLuint name = 0;
  GLuint framebuffer = 0;  // with level 0 of that range attached; 0 when the type does not blit
  std::uint32_t width = 1, height = 1;
  GLbitfield planes = GL_COLOR_BUFFER_BIT;
};

// A range of a buffer.
struct BoundBuffer {
  GLuint name = 0;
  GLintptr offset = 0;
  GLsizeiptr bytes = 0;
};

// Vertices of a draw.
struct Geometry {
  GLuint vertexArray = 0;
  GLenum mode = GL_TRIANGLES;
  GLsizei count = 0;  // indices, or vertices when indexType is 0
  GLenum indexType = 0;
  GLuint commands = 0;  // a buffer of `count` commands for glMultiDrawElementsIndirect instead
};

struct PassContext {
  const graph::PassSpec* spec = nullptr;
  std::uint32_t groupSize[3] = {1, 1, 1};  // compute: the program's local size
  std::uint32_t maxGroups[3] = {65535, 65535, 65535};
  BoundTexture source, destination;             // without a shader: what its slots name, of each access one
  BoundBuffer sourceBuffer, destinationBuffer;  // in their place, without a name where a slot has a texture
  bool linear = false;                          // blit: filter of the source slot
  Geometry geometry;
  std::uint32_t instances = 0;  // draw
  BoundBuffer commands;         // draw, compute: the arguments of the GL command, where it has a name
  // Slices [slice, slice + sliceCount) of `slices`. Rows of pixels are the executor's scissor; compute takes rows of groups.
  std::uint32_t slice = 0, sliceCount = 1, slices = 1;
};

class PassType {
 public:
  virtual ~PassType() = default;
  virtual graph::PassType reflect() const = 0;
  virtual void execute(const PassContext& context) const = 0;
};

// The pass types an engine knows, by name. An embedder adds its own before reading graphs.
class PassRegistry : public graph::PlugIns<PassType> {
 public:
  static PassRegistry builtin();
};

}  // namespace weft::passes
