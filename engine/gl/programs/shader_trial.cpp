// Declared in program_cache.h.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "engine/gl/programs/program_cache.h"
#include "engine/glsl/interface.h"
#include "engine/text/apart.h"
#include "gl_sentences.h"

namespace weft::gl {

namespace {

// What the process says of how far it is.
constexpr char kTrialOpened = 'o', kTrialLinked = 'l', kTrialDrawn = 'd';

struct TrialProgram {
  std::vector<StageSource> stages;  // with the defines before their texts
  std::vector<std::string> outputs;
};

// The program as fields that end with a zero byte, which no source has: a letter says what a field is.
std::string writeTrial(std::span<const StageSource> stages, std::span<const glsl::Define> defines,
                       std::span<const std::string> outputs) {
  std::string text, before;
  for (const glsl::Define& define : defines)
    before += fmt::format("#define {} {}\n", define.name, define.value);
  for (const StageSource& stage : stages) {
    text += stage.stage == GL_VERTEX_SHADER ? 'v' : stage.stage == GL_FRAGMENT_SHADER ? 'f' : 'c';
    (text += before).append(stage.source->text) += '\0';
  }
  for (const std::string& output : outputs) (text += 'o').append(output) += '\0';
  return text;
}

TrialProgram readTrial(std::string_view text) {
  TrialProgram program;
  while (!text.empty()) {
    std::string field(text.substr(1, text.find('\0') - 1));
    const char kind = text[0];
    text.remove_prefix(std::min(field.size() + 2, text.size()));
    if (kind == 'o') {
      program.outputs.push_back(std::move(field));
      continue;
    }
    auto source = std::make_shared<glsl::ShaderSource>();
    source->file = "trial";
    source->text = std::move(field);
    program.stages.push_back({static_cast<GLenum>(kind == 'v'   ? GL_VERTEX_SHADER
                                                  : kind == 'f' ? GL_FRAGMENT_SHADER
                                                                : GL_COMPUTE_SHADER),
                              std::move(source)});
  }
  return program;
}

// ---- the process of a trial ----

// The machine code is made for a draw or a dispatch, also for one that has nothing to do. The objects go with the process.
void drawNothing(const TrialProgram& program, GLuint linked) {
  glUseProgram(linked);
  if (program.stages[0].stage == GL_COMPUTE_SHADER) {
    const GLuint none[3] = {0, 0, 0};
    GLuint counts = 0;
    glCreateBuffers(1, &counts);
    glNamedBufferStorage(counts, sizeof none, none, 0);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, counts);
    glDispatchComputeIndirect(0);
    glFinish();
    return;
  }
  GLuint vertices = 0, target = 0;
  glCreateVertexArrays(1, &vertices);
  glBindVertexArray(vertices);
  glCreateFramebuffers(1, &target);
  std::vector<GLenum> buffers;
  const std::size_t outputs = std::clamp<std::size_t>(program.outputs.size(), 1, 8);
  for (std::size_t i = 0; i < outputs; ++i) {
    GLuint texture = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, GL_RGBA16F, 4, 4);
    buffers.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i));
    glNamedFramebufferTexture(target, buffers.back(), texture, 0);
  }
  glNamedFramebufferDrawBuffers(target, static_cast<GLsizei>(outputs), buffers.data());
  glBindFramebuffer(GL_FRAMEBUFFER, target);
  glViewport(0, 0, 4, 4);
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 0, 0, 0);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glFinish();
}

}  // namespace

bool survivesTrial(Trials& trials, const DeviceInfo& device, std::span<const StageSource> stages,
                   std::span<const glsl::Define> defines, std::span<const std::string> outputs,
                   text::Diagnostics& diagnostics) {
  // A window's driver without its window.
  const Backend backend = device.backend != Backend::glfw ? device.backend
                          : device.software               ? Backend::osmesa
                                                          : Backend::egl;
  text::ApartEnd end;
  if (!trials.died) {
    std::vector<std::string> command = trials.command;
    for (const std::string& word : {std::string(kTrialWord), std::string(nameOf(backend)),
                                    std::to_string(trials.seconds), std::to_string(kMaxTrialBytes)})
      command.push_back(word);
    end = text::runApart(std::move(command), writeTrial(stages, defines, outputs), trials.seconds);
    if (end.said.empty() || end.said.back() == kTrialDrawn) return true;  // if empty, nothing is known
  }
  const StageSource& largest = *std::ranges::max_element(stages, {}, [&](const StageSource& stage) {
    const glsl::Interface& interface = stage.source->interfaceWith(defines);
    return std::pair(interface.unsure, interface.size.inlined);
  });
  const bool tried = !std::exchange(trials.died, true);
  diagnostics.error(say::driverDied, {largest.source->file, 0, 0},
                    !tried ? "this shader was not tried"
                    : end.said.back() == kTrialOpened
                        ? "the driver did not survive compiling this shader"
                        : "the driver did not survive making the machine code of this shader",
                    trials.seconds, kMaxTrialBytes >> 20,
                    tried ? fmt::format("{}, after {:.1f} s of processor time and with {} MiB", end.how,
                                        end.seconds, end.mebibytes)
                          : "another one that the driver did not survive",
                    tried ? "make it smaller, or give it more time with --limit 2 on a slow machine"
                          : "mend the other one first");
  return false;
}

void runTrial(int argc, char** argv) {
  const auto backend = argc > 3 ? findBackend(argv[1]) : std::nullopt;
  const std::string input = backend ? text::beginApart() : "";
  const TrialProgram program = readTrial(input);
  text::Diagnostics ignored;
  const auto context =
      program.stages.empty() ? nullptr : createContext({.backend = *backend, .debug = false}, ignored);
  if (!context) text::endApart();
  text::takeLimits(std::strtoull(argv[2], nullptr, 10), std::strtoull(argv[3], nullptr, 10));
  text::sayStep(kTrialOpened);
  const auto linked = Program::compile(program.stages, {}, program.outputs, "trial", ignored);
  if (linked) {
    text::sayStep(kTrialLinked);
    drawNothing(program, linked->id());
  }
  text::endApart({}, kTrialDrawn);
}

}  // namespace weft::gl
