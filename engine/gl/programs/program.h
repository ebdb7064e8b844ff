// A linked program and what introspection says of it. Texture units, image units and block bindings are
// assigned here at link time, in order of name, so that equal programs get equal bindings; shaders write no
// `binding =`. Does not: bind anything for drawing, set uniforms other than units, or cache
// (program_cache.h).
#pragma once

#include <glad/gl.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/diagnostic.h"
#include "engine/gl/objects/objects.h"
#include "engine/glsl/source.h"

namespace weft::gl {

// A sampler or image uniform; arrays take `arraySize` consecutive units from `unit`.
struct OpaqueUniform {
  std::string name;  // without "[0]"
  GLenum type = 0;   // GL_SAMPLER_2D, GL_IMAGE_2D, …
  GLint location = -1;
  std::uint32_t arraySize = 1;
  std::uint32_t unit = 0;  // first texture unit, or first image unit
};

struct BlockMember {
  std::string
      name;  // without the block's name; "instance[0].center", "threshold", "weights" (no "[0]" at the end)
  GLenum type = 0;                // GL_FLOAT, GL_FLOAT_MAT4, …
  std::uint32_t offset = 0;       // bytes
  std::uint32_t arraySize = 1;    // 0: unsized, the last member of a storage block
  std::uint32_t arrayStride = 0;  // bytes, of the member's own array; 0 when it is none
  std::uint32_t matrixStride = 0;
  bool rowMajor = false;
  std::uint32_t topLevelArraySize = 1,
                topLevelArrayStride = 0;  // storage blocks: of the outermost array of structs
};

struct Block {
  std::string name;  // of the block, not of its instance
  bool storage = false;
  std::uint32_t binding = 0;         // assigned by us: uniform and storage blocks count separately
  std::uint32_t bytes = 0;           // minimum size; an unsized array counts one element
  std::vector<BlockMember> members;  // by offset
  const BlockMember* find(std::string_view member) const;
};

struct Interface {  // a fragment output or a vertex attribute
  std::string name;
  GLenum type = 0;
  GLint location = -1;
};

struct Reflection {
  std::vector<OpaqueUniform> samplers, images;      // by name
  std::vector<Block> uniformBlocks, storageBlocks;  // by name
  std::vector<Interface> outputs;                   // by location
  std::vector<Interface> attributes;                // by location, built-ins left out
  std::vector<Interface> looseUniforms;    // plain uniforms outside blocks, which the engine does not set
  std::uint32_t workGroup[3] = {0, 0, 0};  // compute; 0 otherwise

  const OpaqueUniform* findSampler(std::string_view name) const;
  const OpaqueUniform* findImage(std::string_view name) const;
  const Block* findUniformBlock(std::string_view name) const;
  const Block* findStorageBlock(std::string_view name) const;
  const Interface* findOutput(std::string_view name) const;
};

struct StageSource {
  GLenum stage = GL_FRAGMENT_SHADER;  // GL_VERTEX_SHADER, GL_FRAGMENT_SHADER or GL_COMPUTE_SHADER
  std::shared_ptr<const glsl::ShaderSource> source;
};

struct ProgramBinary {
  GLenum format = 0;
  std::vector<std::byte> bytes;
};

class Program : public Owner<ObjectKind::program> {
 public:
  // Compiles and links. `outputs` are bound to locations 0, 1, … before linking, in that order, so that attachment i
  // is outputs[i]. A name that the program lacks is ignored; `layout(location)` in the source wins. Reports the errors
  // of every stage (W104), or else those of linking (W105), with true places. Warnings of the driver become warnings.
  static std::optional<Program> compile(std::span<const StageSource> stages,
                                        std::span<const glsl::Define> defines,
                                        std::span<const std::string> outputs, std::string_view label,
                                        base::Diagnostics& diagnostics);
  // Nullopt when the driver rejects the binary, without an error or a message of the driver. `compute` says whether
  // the binary is a compute program, because OpenGL does not tell.
  static std::optional<Program> load(const ProgramBinary& binary, bool compute, std::string_view label);
  // The linked binary, or nullopt when the driver has no format for it.
  std::optional<ProgramBinary> binary() const;

  const Reflection& reflection() const { return reflection_; }
  const std::string& label() const { return label_; }

 private:
  using Owner::Owner;
  Reflection reflection_;
  std::string label_;
};

// Introspects a linked program and assigns its units and bindings (Program does it by itself).
Reflection reflectProgram(GLuint program, bool compute);

// "float", "vec3", "mat4", "sampler2D", …, or the enum's name.
std::string glslTypeName(GLenum type);
// Components of a scalar, vector or matrix type, and whether its base type is float, int, uint or bool
// (GL_FLOAT, …).
struct TypeShape {
  GLenum base = GL_FLOAT;
  std::uint32_t columns = 1, rows = 1;  // a vec3 has one column of three rows
};
std::optional<TypeShape> shapeOf(GLenum type);

}  // namespace weft::gl
