// Declared in program_cache.h.
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>

#include "engine/gl/programs/program_cache.h"
#include "engine/glsl/interface.h"

extern char** environ;

namespace weft::gl {

namespace {

// A busy machine may take this many times longer by the clock than by the processor.
constexpr std::uint64_t kClockPerProcessor = 6;

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

// The process; -1 when it cannot be started.
pid_t start(std::vector<std::string> command, int input, int output) {
  std::vector<char*> words;
  for (std::string& word : command) words.push_back(word.data());
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t pid = -1;
  const int error = posix_spawn(&pid, words[0], &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error == 0 ? pid : -1;
}

struct TrialResult {
  std::string what;             // "signal 11 (Segmentation fault)"; empty: it survived, or nothing is known
  std::string during;           // "compiling"
  double seconds = 0;           // of processor time
  std::uint64_t mebibytes = 0;  // of memory at most
};

TrialResult tryProgram(std::vector<std::string> command, Backend backend, const std::string& program,
                       std::uint64_t seconds) {
  TrialResult result;
  const int input = ::memfd_create("trial", MFD_CLOEXEC);
  int ends[2] = {-1, -1};
  const bool ready =
      input >= 0 && ::write(input, program.data(), program.size()) == static_cast<ssize_t>(program.size()) &&
      ::lseek(input, 0, SEEK_SET) == 0 && ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0;
  for (const std::string& word : {std::string(kTrialWord), std::string(nameOf(backend)),
                                  std::to_string(seconds), std::to_string(kMaxTrialBytes)})
    command.push_back(word);
  const pid_t pid = ready ? start(std::move(command), input, ends[1]) : -1;
  ::close(input);
  ::close(ends[1]);
  if (pid < 0) {
    ::close(ends[0]);
    return result;
  }
  const timeval patience{.tv_sec = static_cast<time_t>(kClockPerProcessor * seconds), .tv_usec = 0};
  ::setsockopt(ends[0], SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  std::string said;
  char step = 0;
  ssize_t got = 0;
  while ((got = ::recv(ends[0], &step, 1, 0)) > 0 || (got < 0 && errno == EINTR))
    if (got > 0) said += step;
  const bool late = got < 0;
  ::close(ends[0]);
  ::kill(pid, SIGKILL);  // what it tidies up is not waited for
  int status = 0;
  rusage used{};
  while (::wait4(pid, &status, 0, &used) < 0 && errno == EINTR) {
  }
  result.seconds = static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                   1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
  if (said.empty() || said.back() == kTrialDrawn) return result;
  result.during = said.back() == kTrialOpened ? "compiling" : "making the machine code of";
  result.mebibytes = static_cast<std::uint64_t>(used.ru_maxrss) >> 10;
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (late)
    result.what = fmt::format("no end after {} s by the clock", kClockPerProcessor * seconds);
  else if (signal == SIGXCPU || signal == SIGKILL)
    result.what = "no end in that time";
  else if (signal != 0)
    result.what = fmt::format("signal {} ({})", signal, strsignal(signal));
  else
    result.what = fmt::format("exit code {}", WEXITSTATUS(status));
  return result;
}

// ---- the process of a trial ----

void say(char step) {
  if (::write(STDOUT_FILENO, &step, 1) != 1) ::_exit(0);  // nobody listens
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

void takeLimits(std::uint64_t seconds, std::uint64_t bytes) {
  // How this process ends is what it is for: by the signal itself, not by what a sanitizer or an embedder makes of it.
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) std::signal(signal, SIG_DFL);
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  const auto spent = static_cast<std::uint64_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + 1;
  lower(RLIMIT_CPU, spent + seconds, spent + seconds + 1);
  lower(RLIMIT_CORE, 0, 0);
  if (kBoundsMemory) lower(RLIMIT_AS, mappedBytes() + bytes, mappedBytes() + bytes);
}

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
  TrialResult result{.what = "unusual shaders before it took all of it", .during = ""};
  if (const double left = trials.all - trials.spent; left > 0) {
    result = tryProgram(trials.command, backend, writeTrial(stages, defines, outputs),
                        static_cast<std::uint64_t>(std::ceil(left)));
    trials.spent += result.seconds;
    if (result.what.empty()) return true;
  }
  const StageSource& largest = *std::ranges::max_element(stages, {}, [&](const StageSource& stage) {
    return stage.source->interfaceWith(defines).size.inlined;
  });
  const bool tried = !result.during.empty();
  text::Diagnostic& error =
      diagnostics.error(text::Code::driverDied, {largest.source->file, 0, 0},
                        tried ? fmt::format("the driver did not survive {} this shader", result.during)
                              : "there is no time left to try this shader");
  error.expected = fmt::format("at most {} s of processor time for all unusual shaders and {} MiB",
                               trials.all, kMaxTrialBytes >> 20);
  error.found = tried ? fmt::format("{}, after {:.1f} s of processor time and with {} MiB", result.what,
                                    result.seconds, result.mebibytes)
                      : result.what;
  error.hint = "make it smaller, or give it more time with --limit 2 on a slow or busy machine";
  return false;
}

void runTrial(int argc, char** argv) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // not longer than who asked for it
  const auto backend = argc > 3 ? findBackend(argv[1]) : std::nullopt;
  const std::string input = backend ? std::string(std::istreambuf_iterator<char>(std::cin), {}) : "";
  const TrialProgram program = readTrial(input);
  text::Diagnostics ignored;
  const auto context =
      program.stages.empty() ? nullptr : createContext({.backend = *backend, .debug = false}, ignored);
  if (!context) ::_exit(0);
  takeLimits(std::strtoull(argv[2], nullptr, 10), std::strtoull(argv[3], nullptr, 10));
  say(kTrialOpened);
  const auto linked = Program::compile(program.stages, {}, program.outputs, "trial", ignored);
  if (linked) {
    say(kTrialLinked);
    drawNothing(program, linked->id());
  }
  say(kTrialDrawn);
  ::_exit(0);
}

}  // namespace weft::gl
