#include "engine/gl/programs/shader_trial.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>

#include "engine/gl/programs/shader_trial_text.h"

extern char** environ;

namespace weft::gl {

namespace {

// A busy machine may take this many times longer by the clock than by the processor.
constexpr std::uint64_t kClockPerProcessor = 6;

using Clock = std::chrono::steady_clock;

// A descriptor that is closed when it goes out of scope.
class Descriptor {
 public:
  explicit Descriptor(int id) : id_(id) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }
  void close() {
    if (id_ >= 0) ::close(id_);
    id_ = -1;
  }
  int id() const { return id_; }

 private:
  int id_;
};

// The process, with the other end of `pair` as its standard input and output; -1 when it cannot be started.
pid_t start(std::span<const std::string> command, const std::vector<std::string>& arguments, int end) {
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, end, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, end, STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t pid = -1;
  const int error = posix_spawn(&pid, words[0], &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error == 0 ? pid : -1;
}

bool sendAll(int to, std::string_view text) {
  while (!text.empty()) {
    const ssize_t sent = ::send(to, text.data(), text.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(sent));
  }
  return ::shutdown(to, SHUT_WR) == 0;
}

// What the process says of how far it is, until it ends or time is up.
std::string listen(int from, Clock::time_point until, bool& late) {
  std::string said;
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
    late = left <= 0;
    if (late) return said;
    pollfd ready{.fd = from, .events = POLLIN, .revents = 0};
    const int count = ::poll(&ready, 1, static_cast<int>(std::min<long>(left, 1000)));
    if (count <= 0) continue;
    char bytes[16];
    const ssize_t got = ::recv(from, bytes, sizeof bytes, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return said;
    said.append(bytes, static_cast<std::size_t>(got));
  }
}

const char* stepOf(char last) {
  switch (last) {
    case kTrialOpened:
      return "compiling";
    case kTrialCompiled:
      return "linking";
    default:
      return "making the machine code of";
  }
}

}  // namespace

TrialResult tryProgram(std::span<const std::string> command, Backend backend,
                       std::span<const StageSource> stages, std::span<const glsl::Define> defines,
                       std::span<const std::string> outputs, std::uint64_t seconds) {
  TrialResult result;
  int ends[2];
  if (command.empty() || ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return result;
  Descriptor mine(ends[0]), its(ends[1]);
  const std::vector<std::string> arguments{kTrialWord, nameOf(backend), std::to_string(seconds),
                                           std::to_string(kMostTrialBytes)};
  const pid_t pid = start(command, arguments, its.id());
  its.close();
  if (pid < 0) return result;
  // A process that does not read is not waited for.
  const timeval patience{.tv_sec = static_cast<time_t>(seconds), .tv_usec = 0};
  ::setsockopt(mine.id(), SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  bool late = false;
  std::string said;
  if (sendAll(mine.id(), writeTrial(stages, defines, outputs)))
    said = listen(mine.id(), Clock::now() + std::chrono::seconds(kClockPerProcessor * seconds), late);
  const bool done = said.ends_with(kTrialDrawn);
  // It has nothing more to say: what it tidies up is not waited for.
  ::kill(pid, SIGKILL);
  int status = 0;
  rusage used{};
  while (::wait4(pid, &status, 0, &used) < 0 && errno == EINTR) {
  }
  result.seconds = static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                   1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
  if (done || said.empty()) return result;
  result.survived = false;
  result.during = stepOf(said.back());
  result.bytes = static_cast<std::uint64_t>(used.ru_maxrss) << 10;
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

}  // namespace weft::gl
