#include "engine/gl/programs/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "engine/gl/context/debug.h"
#include "engine/gl/programs/log.h"

namespace weft::gl {

namespace {

using base::Code;
using base::Diagnostics;

// Deleted when it goes out of scope; a linked program does not need it.
class Shader {
 public:
  explicit Shader(GLenum stage) : id_(glCreateShader(stage)) {}
  Shader(Shader&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  Shader& operator=(Shader&&) = delete;
  ~Shader() { glDeleteShader(id_); }
  GLuint id() const { return id_; }

 private:
  GLuint id_;
};

const char* stageName(GLenum stage) {
  switch (stage) {
    case GL_VERTEX_SHADER:
      return "vertex shader";
    case GL_FRAGMENT_SHADER:
      return "fragment shader";
    case GL_COMPUTE_SHADER:
      return "compute shader";
    default:
      return "shader";
  }
}

std::string textOf(GLint length, GLuint id, void (*read)(GLuint, GLsizei, GLsizei*, GLchar*)) {
  if (length <= 1) return {};
  std::string text(static_cast<std::size_t>(length), '\0');
  GLsizei written = 0;
  read(id, length, &written, text.data());
  text.resize(static_cast<std::size_t>(std::max(0, written)));
  return text;
}

// The log of what failed as diagnostics, at least one error. Of what succeeded a driver says what it likes, and only while its
// caches are cold: that is not passed on.
void reportLog(const std::string& log, const glsl::ShaderSource& source, Code code,
               const std::string& failure, Diagnostics& diagnostics,
               std::span<const glsl::Define> defines = {}) {
  Diagnostics found;
  mapLog(log, source, code, found, defines);
  diagnostics.append(found);
  if (!found.hasErrors()) diagnostics.error(code, {source.file, 0, 0}, failure);
}

bool compileStage(const Shader& shader, const StageSource& stage, std::span<const glsl::Define> defines,
                  Diagnostics& diagnostics) {
  const std::string text = glsl::assembleSource(*stage.source, defines);
  const GLchar* start = text.data();
  const auto length = static_cast<GLint>(text.size());
  glShaderSource(shader.id(), 1, &start, &length);
  glCompileShader(shader.id());
  GLint compiled = 0, logLength = 0;
  glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
  if (compiled) return true;
  glGetShaderiv(shader.id(), GL_INFO_LOG_LENGTH, &logLength);
  const std::string log = textOf(logLength, shader.id(), [](GLuint i, GLsizei n, GLsizei* w, GLchar* t) {
    glGetShaderInfoLog(i, n, w, t);
  });
  reportLog(log, *stage.source, Code::shaderDoesNotCompile,
            fmt::format("the {} does not compile, and the driver does not say why", stageName(stage.stage)),
            diagnostics, defines);
  return false;
}

}  // namespace

std::optional<Program> Program::compile(std::span<const StageSource> stages,
                                        std::span<const glsl::Define> defines,
                                        std::span<const std::string> outputs, std::string_view label,
                                        Diagnostics& diagnostics) {
  assert(!stages.empty());
  std::vector<Shader> shaders;
  bool compiled = true;
  for (const StageSource& stage : stages) {
    shaders.emplace_back(stage.stage);
    labelObject(GL_SHADER, shaders.back().id(), fmt::format("{} {}", label, stageName(stage.stage)));
    compiled &= compileStage(shaders.back(), stage, defines, diagnostics);
  }
  if (!compiled) return std::nullopt;

  Program program(glCreateProgram());
  program.label_ = label;
  labelObject(GL_PROGRAM, program.id_, label);
  glProgramParameteri(program.id_, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
  for (const Shader& shader : shaders) glAttachShader(program.id_, shader.id());
  for (std::size_t i = 0; i < outputs.size(); ++i)
    if (!outputs[i].empty()) glBindFragDataLocation(program.id_, static_cast<GLuint>(i), outputs[i].c_str());
  glLinkProgram(program.id_);
  for (const Shader& shader : shaders) glDetachShader(program.id_, shader.id());
  GLint linked = 0, logLength = 0;
  glGetProgramiv(program.id_, GL_LINK_STATUS, &linked);
  if (!linked) {
    glGetProgramiv(program.id_, GL_INFO_LOG_LENGTH, &logLength);
    const std::string log = textOf(logLength, program.id_, [](GLuint i, GLsizei n, GLsizei* w, GLchar* t) {
      glGetProgramInfoLog(i, n, w, t);
    });
    reportLog(log, *stages.back().source, Code::programDoesNotLink,
              fmt::format("program '{}' does not link, and the driver does not say why", label), diagnostics);
    return std::nullopt;
  }
  program.reflection_ = reflectProgram(program.id_, stages.front().stage == GL_COMPUTE_SHADER);
  return program;
}

std::optional<Program> Program::load(const ProgramBinary& binary, bool compute, std::string_view label) {
  // An unknown format would be GL_INVALID_ENUM: ask first.
  GLint count = 0;
  glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &count);
  std::vector<GLint> formats(static_cast<std::size_t>(std::max(0, count)));
  if (count > 0) glGetIntegerv(GL_PROGRAM_BINARY_FORMATS, formats.data());
  if (std::find(formats.begin(), formats.end(), static_cast<GLint>(binary.format)) == formats.end())
    return std::nullopt;
  Program program(glCreateProgram());
  program.label_ = label;
  labelObject(GL_PROGRAM, program.id_, label);
  glProgramBinary(program.id_, binary.format, binary.bytes.data(), static_cast<GLsizei>(binary.bytes.size()));
  GLint linked = 0;
  glGetProgramiv(program.id_, GL_LINK_STATUS, &linked);
  if (!linked) return std::nullopt;
  program.reflection_ = reflectProgram(program.id_, compute);
  return program;
}

std::optional<ProgramBinary> Program::binary() const {
  GLint count = 0, length = 0;
  glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &count);
  if (count == 0) return std::nullopt;
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
