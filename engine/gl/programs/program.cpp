#include "engine/gl/programs/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>
#include <tuple>

#include "engine/gl/context/debug.h"

namespace weft::gl {

namespace {

using text::Code;
using text::Diagnostics;

// Deleted when it goes out of scope; a linked program does not need it.
struct Shader : Owner<ObjectKind::shader> {
  explicit Shader(GLenum stage) : Owner(glCreateShader(stage)) {}
};

// Of a shader or a program.
std::string logOf(GLuint id, void (*ask)(GLuint, GLenum, GLint*),
                  void (*read)(GLuint, GLsizei, GLsizei*, GLchar*)) {
  GLint length = 0;
  ask(id, GL_INFO_LOG_LENGTH, &length);
  std::string text(static_cast<std::size_t>(std::max(length, 1)), '\0');
  read(id, static_cast<GLsizei>(text.size()), nullptr, text.data());
  return text.c_str();
}

// The log of what failed as diagnostics, at least one error. Of what succeeded a driver says what it likes, and only while its
// caches are cold: that is not passed on.
void reportLog(const std::string& log, const glsl::ShaderSource& source, Code code,
               const std::string& failure, Diagnostics& diagnostics,
               std::span<const glsl::Define> defines = {}) {
  Diagnostics found;
  mapLog(log, source, code, found, defines);
  diagnostics.append(found);
  if (!found.hasErrors())
    diagnostics.add({.code = code,
                     .message = failure + (log.empty() ? ", and the driver does not say why" : ": " + log),
                     .place = {source.file, 0, 0}});
}

bool compileStage(const Shader& shader, const StageSource& stage, std::span<const glsl::Define> defines,
                  Diagnostics& diagnostics) {
  const std::string text = glsl::assembleSource(*stage.source, defines);
  const auto isCompiled = [&](const std::string& of) {
    const GLchar* start = of.data();
    const auto length = static_cast<GLint>(of.size());
    glShaderSource(shader.id(), 1, &start, &length);
    glCompileShader(shader.id());
    GLint compiled = 0;
    glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
    return compiled != 0;
  };
  const std::string clamped = stage.clamped ? glsl::clampShared(text) : text;
  // What is wrong is told of the text as it is, unless that is nothing.
  if (isCompiled(clamped)) return true;
  if (clamped != text && isCompiled(text)) isCompiled(clamped);
  reportLog(logOf(shader.id(), glGetShaderiv, glGetShaderInfoLog), *stage.source, Code::shaderDoesNotCompile,
            "the shader does not compile", diagnostics, defines);
  return false;
}

}  // namespace

// ---- program interface queries (OpenGL 4.5 core, 7.3.1) to plain data, and the assignment of units and bindings ----

namespace {

constexpr std::string_view kFirst = "[0]";

GLint countOf(GLuint program, GLenum interface) {
  GLint n = 0;
  glGetProgramInterfaceiv(program, interface, GL_ACTIVE_RESOURCES, &n);
  return n;
}

std::string nameOf(GLuint program, GLenum interface, GLuint index) {
  GLint length = 0;
  const GLenum property = GL_NAME_LENGTH;
  glGetProgramResourceiv(program, interface, index, 1, &property, 1, nullptr, &length);
  std::string name(static_cast<std::size_t>(std::max(length, 1)), '\0');
  glGetProgramResourceName(program, interface, index, static_cast<GLsizei>(name.size()), nullptr,
                           name.data());
  name.pop_back();  // the terminator
  return name;
}

template <std::size_t kCount>
std::array<GLint, kCount> propertiesOf(GLuint program, GLenum interface, GLuint index,
                                       const std::array<GLenum, kCount>& names) {
  std::array<GLint, kCount> values{};
  glGetProgramResourceiv(program, interface, index, static_cast<GLsizei>(kCount), names.data(),
                         static_cast<GLsizei>(kCount), nullptr, values.data());
  return values;
}

std::string withoutIndex(std::string name) {
  if (name.ends_with(kFirst)) name.resize(name.size() - kFirst.size());
  return name;
}

std::uint32_t toUnsigned(GLint value) {
  return value < 0 ? 0 : static_cast<std::uint32_t>(value);
}

void readUniforms(GLuint program, Reflection& out) {
  const GLint count = countOf(program, GL_UNIFORM);
  for (GLuint i = 0; i < static_cast<GLuint>(count); ++i) {
    const auto [block, type, size, location] =
        propertiesOf<4>(program, GL_UNIFORM, i, {GL_BLOCK_INDEX, GL_TYPE, GL_ARRAY_SIZE, GL_LOCATION});
    if (block != -1 || location < 0) continue;
    const std::string name = withoutIndex(nameOf(program, GL_UNIFORM, i));
    const GlslType* known = findGlslType(static_cast<GLenum>(type));
    const OpaqueUniform uniform{name, static_cast<GLenum>(type), location, std::max(1u, toUnsigned(size)), 0};
    if (known && known->kind == GlslType::Kind::sampler)
      out.samplers.push_back(uniform);
    else if (known && known->kind == GlslType::Kind::image)
      out.images.push_back(uniform);
    else
      out.looseUniforms.push_back({name, static_cast<GLenum>(type), location});
  }
}

void assignUnits(GLuint program, std::vector<OpaqueUniform>& uniforms) {
  std::ranges::sort(uniforms, {}, &OpaqueUniform::name);
  std::uint32_t next = 0;
  std::vector<GLint> units;
  for (OpaqueUniform& uniform : uniforms) {
    uniform.unit = next;
    units.resize(uniform.arraySize);
    std::iota(units.begin(), units.end(), static_cast<GLint>(next));
    glProgramUniform1iv(program, uniform.location, static_cast<GLsizei>(units.size()), units.data());
    next += uniform.arraySize;
  }
}

BlockMember readMember(GLuint program, bool storage, GLuint index, const std::string& block) {
  const GLenum interface = storage ? GL_BUFFER_VARIABLE : GL_UNIFORM;
  const auto [type, offset, size, stride, matrixStride, rowMajor] = propertiesOf<6>(
      program, interface, index,
      {GL_TYPE, GL_OFFSET, GL_ARRAY_SIZE, GL_ARRAY_STRIDE, GL_MATRIX_STRIDE, GL_IS_ROW_MAJOR});
  BlockMember member;
  member.name = withoutIndex(nameOf(program, interface, index));
  // With an instance name, members are called "Block.member" (and an array of blocks "Block[0]", members "Block.member").
  const std::string prefix = block.substr(0, block.find('[')) + ".";
  if (member.name.starts_with(prefix)) member.name.erase(0, prefix.size());
  member.type = static_cast<GLenum>(type);
  member.offset = toUnsigned(offset);
  member.arraySize = toUnsigned(size);
  member.arrayStride = toUnsigned(stride);
  member.matrixStride = toUnsigned(matrixStride);
  member.rowMajor = rowMajor != 0;
  if (storage) {
    const auto [topSize, topStride] =
        propertiesOf<2>(program, interface, index, {GL_TOP_LEVEL_ARRAY_SIZE, GL_TOP_LEVEL_ARRAY_STRIDE});
    member.topLevelArraySize = toUnsigned(topSize);
    member.topLevelArrayStride = toUnsigned(topStride);
  }
  return member;
}

std::vector<Block> readBlocks(GLuint program, bool storage) {
  const GLenum interface = storage ? GL_SHADER_STORAGE_BLOCK : GL_UNIFORM_BLOCK;
  const GLint count = countOf(program, interface);
  std::vector<std::pair<Block, GLuint>> found;
  for (GLuint i = 0; i < static_cast<GLuint>(count); ++i) {
    const auto [bytes, variables] =
        propertiesOf<2>(program, interface, i, {GL_BUFFER_DATA_SIZE, GL_NUM_ACTIVE_VARIABLES});
    Block block;
    block.name = nameOf(program, interface, i);
    block.storage = storage;
    block.bytes = toUnsigned(bytes);
    std::vector<GLint> indices(toUnsigned(variables));
    const GLenum property = GL_ACTIVE_VARIABLES;
    glGetProgramResourceiv(program, interface, i, 1, &property, variables, nullptr, indices.data());
    for (const GLint index : indices)
      block.members.push_back(readMember(program, storage, static_cast<GLuint>(index), block.name));
    std::ranges::sort(block.members, {}, [](const BlockMember& m) { return std::tie(m.offset, m.name); });
    found.emplace_back(std::move(block), i);
  }
  std::ranges::sort(found, {}, [](const auto& each) -> const std::string& { return each.first.name; });
  std::vector<Block> blocks;
  for (auto& [block, index] : found) {
    block.binding = static_cast<std::uint32_t>(blocks.size());
    if (storage)
      glShaderStorageBlockBinding(program, index, block.binding);
    else
      glUniformBlockBinding(program, index, block.binding);
    blocks.push_back(std::move(block));
  }
  return blocks;
}

std::vector<Interface> readInterface(GLuint program, GLenum interface) {
  std::vector<Interface> found;
  const GLint count = countOf(program, interface);
  for (GLuint i = 0; i < static_cast<GLuint>(count); ++i) {
    const auto [type, location] = propertiesOf<2>(program, interface, i, {GL_TYPE, GL_LOCATION});
    std::string name = nameOf(program, interface, i);
    if (location < 0 || name.starts_with("gl_")) continue;
    found.push_back({withoutIndex(std::move(name)), static_cast<GLenum>(type), location});
  }
  std::ranges::sort(found, {}, &Interface::location);
  return found;
}

}  // namespace

Reflection reflectProgram(GLuint program, bool compute) {
  Reflection out;
  readUniforms(program, out);
  assignUnits(program, out.samplers);
  assignUnits(program, out.images);
  out.uniformBlocks = readBlocks(program, false);
  out.storageBlocks = readBlocks(program, true);
  if (compute) {
    GLint size[3] = {};
    glGetProgramiv(program, GL_COMPUTE_WORK_GROUP_SIZE, size);
    for (int axis = 0; axis < 3; ++axis) out.workGroup[axis] = toUnsigned(size[axis]);
  } else {
    out.outputs = readInterface(program, GL_PROGRAM_OUTPUT);
    out.attributes = readInterface(program, GL_PROGRAM_INPUT);
  }
  return out;
}

std::optional<Program> Program::compile(std::span<const StageSource> stages,
                                        std::span<const glsl::Define> defines,
                                        std::span<const std::string> outputs, std::string_view label,
                                        Diagnostics& diagnostics) {
  assert(!stages.empty());
  std::vector<Shader> shaders;
  bool compiled = true;
  for (const StageSource& stage : stages) {
    shaders.emplace_back(stage.stage);
    labelObject(GL_SHADER, shaders.back().id(), label);
    compiled &= compileStage(shaders.back(), stage, defines, diagnostics);
  }
  if (!compiled) return std::nullopt;

  Program program(glCreateProgram());
  labelObject(GL_PROGRAM, program.id_, label);
  glProgramParameteri(program.id_, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
  for (const Shader& shader : shaders) glAttachShader(program.id_, shader.id());
  for (std::size_t i = 0; i < outputs.size(); ++i)
    if (!outputs[i].empty()) glBindFragDataLocation(program.id_, static_cast<GLuint>(i), outputs[i].c_str());
  glLinkProgram(program.id_);
  for (const Shader& shader : shaders) glDetachShader(program.id_, shader.id());
  GLint linked = 0;
  glGetProgramiv(program.id_, GL_LINK_STATUS, &linked);
  if (!linked) {
    reportLog(logOf(program.id_, glGetProgramiv, glGetProgramInfoLog), *stages.back().source,
              Code::programDoesNotLink, fmt::format("program '{}' does not link", label), diagnostics);
    return std::nullopt;
  }
  program.reflection_ = reflectProgram(program.id_, stages.front().stage == GL_COMPUTE_SHADER);
  return program;
}

std::optional<Program> Program::load(const ProgramBinary& binary, bool compute, std::string_view label) {
  // An unknown format would be GL_INVALID_ENUM: ask first.
  std::vector<GLint> formats(toUnsigned(integerOf(GL_NUM_PROGRAM_BINARY_FORMATS)));
  if (!formats.empty()) glGetIntegerv(GL_PROGRAM_BINARY_FORMATS, formats.data());
  if (std::ranges::find(formats, static_cast<GLint>(binary.format)) == formats.end()) return std::nullopt;
  Program program(glCreateProgram());
  labelObject(GL_PROGRAM, program.id_, label);
  glProgramBinary(program.id_, binary.format, binary.bytes.data(), static_cast<GLsizei>(binary.bytes.size()));
  GLint linked = 0;
  glGetProgramiv(program.id_, GL_LINK_STATUS, &linked);
  if (!linked) return std::nullopt;
  program.reflection_ = reflectProgram(program.id_, compute);
  return program;
}

std::optional<ProgramBinary> Program::binary() const {
  GLint length = 0;
  glGetProgramiv(id_, GL_PROGRAM_BINARY_LENGTH, &length);
  if (length <= 0) return std::nullopt;
  ProgramBinary binary;
  binary.bytes.resize(static_cast<std::size_t>(length));
  GLsizei written = 0;
  glGetProgramBinary(id_, length, &written, &binary.format, binary.bytes.data());
  if (written <= 0) return std::nullopt;
  binary.bytes.resize(static_cast<std::size_t>(written));
  return binary;
}

}  // namespace weft::gl
