// A linked program and what introspection says of it. Texture units, image units and block bindings are
// assigned here at link time, in order of name, so that equal programs get equal bindings; shaders write no
// `binding =`.
#pragma once

#include <glad/gl.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/gl/objects/objects.h"
#include "engine/glsl/source.h"
#include "engine/text/diagnostic.h"

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
  // Without the block's name; "instance[0].center", "threshold", "weights" (no "[0]" at the end).
  std::string name;
  GLenum type = 0;                // GL_FLOAT, GL_FLOAT_MAT4, …
  std::uint32_t offset = 0;       // bytes
  std::uint32_t arraySize = 1;    // 0: unsized, the last member of a storage block
  std::uint32_t arrayStride = 0;  // bytes, of the member's own array; 0 when it is none
  std::uint32_t matrixStride = 0;
  bool rowMajor = false;
  // Of the outermost array of structs, in storage blocks.
  std::uint32_t topLevelArraySize = 1, topLevelArrayStride = 0;
};

// Null when there is none of that name.
template <class Item>
const Item* findNamed(const std::vector<Item>& items, std::string_view name) {
  for (const Item& item : items)
    if (item.name == name) return &item;
  return nullptr;
}

struct Block {
  std::string name;  // of the block, not of its instance
  bool storage = false;
  std::uint32_t binding = 0;         // assigned by us: uniform and storage blocks count separately
  std::uint32_t bytes = 0;           // minimum size; an unsized array counts one element
  std::vector<BlockMember> members;  // by offset
  const BlockMember* find(std::string_view member) const { return findNamed(members, member); }
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

  const OpaqueUniform* findSampler(std::string_view name) const { return findNamed(samplers, name); }
  const OpaqueUniform* findImage(std::string_view name) const { return findNamed(images, name); }
  const Block* findUniformBlock(std::string_view name) const { return findNamed(uniformBlocks, name); }
  const Block* findStorageBlock(std::string_view name) const { return findNamed(storageBlocks, name); }
  const Interface* findOutput(std::string_view name) const { return findNamed(outputs, name); }
};

struct StageSource {
  GLenum stage = GL_FRAGMENT_SHADER;  // GL_VERTEX_SHADER, GL_FRAGMENT_SHADER or GL_COMPUTE_SHADER
  std::shared_ptr<const glsl::ShaderSource> source;
  bool clamped = false;  // see glsl::clampShared()
};

struct ProgramBinary {
  GLenum format = 0;
  std::string bytes;
};

class Program : public Owner<ObjectKind::program> {
 public:
  // Compiles and links. `outputs` are bound to locations 0, 1, … before linking, in that order, so that attachment i
  // is outputs[i]. A name that the program lacks is ignored; `layout(location)` in the source wins. Reports the errors
  // of every stage (W104), or else those of linking (W105), with true places.
  static std::optional<Program> compile(std::span<const StageSource> stages,
                                        std::span<const glsl::Define> defines,
                                        std::span<const std::string> outputs, std::string_view label,
                                        text::Diagnostics& diagnostics);
  // Nullopt when the driver rejects the binary, without an error or a message of the driver. Its format must be one that the
  // driver has given. `compute` says whether the binary is a compute program, because OpenGL does not tell.
  static std::optional<Program> load(const ProgramBinary& binary, bool compute, std::string_view label);
  // The linked binary, or nullopt when the driver has no format for it.
  std::optional<ProgramBinary> binary() const;

  const Reflection& reflection() const { return reflection_; }

 private:
  using Owner::Owner;
  Reflection reflection_;
};

// Turns the log of a glsl::assembleSource() text into one diagnostic per message, with its true place. Understands Mesa's
// "0:12(5): error: text", NVIDIA's "0(12) : error C1234: text" and the common "ERROR: 0:12: text". Other lines become
// part of the message before them. The driver's words stay. A name that is not declared gets a
// hint, such as the nearest one that is; of the errors of one line one is kept. `code` is W104 (compile) or W105 (link).
// `defines`: those the text was assembled with. Returns how many diagnostics were added.
std::size_t mapLog(std::string_view log, const glsl::ShaderSource& source, text::Code code,
                   text::Diagnostics& diagnostics, std::span<const glsl::Define> defines = {});

// Introspects a linked program and assigns its units and bindings (Program does it by itself).
Reflection reflectProgram(GLuint program, bool compute);

// A type of values, or one of samplers or images that the engine binds.
struct GlslType {
  enum class Kind : std::uint8_t { value, sampler, image };
  GLenum type = 0;   // GL_FLOAT_VEC3, GL_SAMPLER_2D, …
  std::string name;  // "vec3", "usampler2D", …
  Kind kind = Kind::value;
  GLenum base = GL_FLOAT;  // of values and texels: GL_FLOAT, GL_INT, GL_UNSIGNED_INT, GL_BOOL or GL_DOUBLE
  std::uint32_t columns = 1, rows = 1;  // of values: a vec3 has one column of three rows
  GLenum target = 0;                    // of samplers and images: GL_TEXTURE_2D, …
  bool shadow = false;
};
// Null for a type that the engine does not know.
const GlslType* findGlslType(GLenum type);
const GlslType* findGlslType(std::string_view name);
// Null for samplers and images, too.
const GlslType* shapeOf(GLenum type);
// "float", "vec3", "mat4", "sampler2D", …, or the enum's number.
std::string glslTypeName(GLenum type);

}  // namespace weft::gl
