// The process of a trial. Declared in shader_trial.h.
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <fstream>

#include "engine/gl/context/context.h"
#include "engine/gl/programs/shader_trial.h"
#include "engine/gl/programs/shader_trial_text.h"

namespace weft::gl {

namespace {

bool takeNumber(std::string_view& text, std::uint64_t& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end == text.data() + text.size()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()) + 1);  // and the character behind it
  return true;
}

std::string readAll(int from) {
  std::string text;
  char bytes[65536];
  for (;;) {
    const ssize_t got = ::read(from, bytes, sizeof bytes);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return text;
    text.append(bytes, static_cast<std::size_t>(got));
  }
}

[[noreturn]] void leave() {
  ::_exit(0);
}

void say(char step) {
  if (::write(STDOUT_FILENO, &step, 1) != 1) leave();  // nobody listens
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kBoundsMemory = false;  // the sanitizers map more than there is
#else
constexpr bool kBoundsMemory = true;
#endif

// The size of this process's address space.
std::uint64_t mappedBytes() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t pages = 0;
  file >> pages;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void lower(int resource, std::uint64_t soft, std::uint64_t hard) {
  rlimit limit{};
  if (::getrlimit(static_cast<__rlimit_resource_t>(resource), &limit) != 0) return;
  limit.rlim_max = std::min<rlim_t>(limit.rlim_max, hard);
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, soft);
  ::setrlimit(static_cast<__rlimit_resource_t>(resource), &limit);
}

// How this process ends is what it is for: by the signal itself, not by what a sanitizer or an embedder makes
// of it.
void takeSignals() {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) ::signal(signal, SIG_DFL);
}

void takeLimits(std::uint64_t seconds, std::uint64_t bytes) {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  const auto spent = static_cast<std::uint64_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + 1;
  lower(RLIMIT_CPU, spent + seconds, spent + seconds + 1);
  lower(RLIMIT_CORE, 0, 0);
  if (kBoundsMemory) lower(RLIMIT_AS, mappedBytes() + bytes, mappedBytes() + bytes);
}

GLuint compile(const TrialProgram& program) {
  std::vector<GLuint> shaders;
  for (const auto& [stage, text] : program.stages) {
    const GLuint shader = glCreateShader(stage);
    const GLchar* start = text.data();
    const auto length = static_cast<GLint>(text.size());
    glShaderSource(shader, 1, &start, &length);
    glCompileShader(shader);
    GLint compiled = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (!compiled) return 0;
    shaders.push_back(shader);
  }
  say(kTrialCompiled);
  const GLuint linked = glCreateProgram();
  glProgramParameteri(linked, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
  for (const GLuint shader : shaders) glAttachShader(linked, shader);
  for (std::size_t i = 0; i < program.outputs.size(); ++i)
    if (!program.outputs[i].empty())
      glBindFragDataLocation(linked, static_cast<GLuint>(i), program.outputs[i].c_str());
  glLinkProgram(linked);
  GLint good = 0;
  glGetProgramiv(linked, GL_LINK_STATUS, &good);
  return good ? linked : 0;
}

// The machine code is made for a draw or a dispatch, also for one that has nothing to do.
void draw(const TrialProgram& program, GLuint linked) {
  glUseProgram(linked);
  if (program.stages[0].first == GL_COMPUTE_SHADER) {
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

std::string writeTrial(std::span<const StageSource> stages, std::span<const glsl::Define> defines,
                       std::span<const std::string> outputs) {
  std::string text = fmt::format("{} {}\n", stages.size(), outputs.size());
  for (const StageSource& stage : stages) {
    const std::string source = glsl::assembleSource(*stage.source, defines);
    text += fmt::format("{} {}\n{}", stage.stage, source.size(), source);
  }
  for (const std::string& output : outputs) text += fmt::format("{}\n{}", output.size(), output);
  return text;
}

std::optional<TrialProgram> readTrial(std::string_view text) {
  TrialProgram program;
  std::uint64_t stages = 0, outputs = 0, stage = 0, bytes = 0;
  if (!takeNumber(text, stages) || !takeNumber(text, outputs)) return std::nullopt;
  for (; stages > 0; --stages) {
    if (!takeNumber(text, stage) || !takeNumber(text, bytes) || bytes > text.size()) return std::nullopt;
    program.stages.emplace_back(static_cast<GLenum>(stage), text.substr(0, bytes));
    text.remove_prefix(bytes);
  }
  for (; outputs > 0; --outputs) {
    if (!takeNumber(text, bytes) || bytes > text.size()) return std::nullopt;
    program.outputs.emplace_back(text.substr(0, bytes));
    text.remove_prefix(bytes);
  }
  if (program.stages.empty()) return std::nullopt;
  return program;
}

void runTrial(int argc, char** argv) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // not longer than who asked for it
  const auto backend = argc > 3 ? findBackend(argv[1]) : std::nullopt;
  const auto program = backend ? readTrial(readAll(STDIN_FILENO)) : std::nullopt;
  if (!program) leave();
  base::Diagnostics ignored;
  const auto context = createContext({.backend = *backend, .debug = false}, ignored);
  if (!context) leave();
  takeSignals();
  takeLimits(std::strtoull(argv[2], nullptr, 10), std::strtoull(argv[3], nullptr, 10));
  say(kTrialOpened);
  if (const GLuint linked = compile(*program); linked != 0) {
    say(kTrialLinked);
    draw(*program, linked);
  }
  say(kTrialDrawn);
  leave();
}

}  // namespace weft::gl
