#include "engine/text/apart.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

extern char** environ;

namespace weft::text {

namespace {

// A busy machine may take this many times longer by the clock than by the processor.
constexpr std::uint64_t kClockPerProcessor = 6;

std::string pathOf(int file) {
  return fmt::format("/proc/self/fd/{}", file);
}

// In place of what is in the file.
bool writeAll(int file, std::string_view bytes) {
  std::ofstream out(pathOf(file), std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return static_cast<bool>(out.flush());
}

std::string readAll(int file) {
  std::ostringstream bytes;
  bytes << std::ifstream(pathOf(file), std::ios::binary).rdbuf();
  return std::move(bytes).str();
}

// Until the process closes its end. False when it was silent for too long, or stopped.
bool listen(int end, std::uint64_t seconds, const std::stop_token& stop, std::string& said) {
  using Clock = std::chrono::steady_clock;
  const auto patience = std::chrono::seconds(kClockPerProcessor * seconds);
  for (auto last = Clock::now(); Clock::now() - last < patience;) {
    pollfd one{end, POLLIN, 0};
    char steps[4096];
    if (::poll(&one, 1, 50) > 0) {
      const ssize_t got = ::recv(end, steps, sizeof steps, 0);
      if (got == 0 || (got < 0 && errno != EINTR)) return true;
      if (got > 0) {
        said.append(steps, static_cast<std::size_t>(got));
        last = Clock::now();
      }
    }
    if (stop.stop_requested()) return false;
  }
  return false;
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

// The soft limit alone; what is asked of the whole process group stays.
void setLimit(__rlimit_resource_t resource, std::uint64_t most) {
  rlimit limit{};
  if (::getrlimit(resource, &limit) != 0) return;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, most);
  ::setrlimit(resource, &limit);
}

}  // namespace

pid_t startProcess(std::vector<std::string> command, int input, int output, int errors) {
  std::vector<char*> words;
  for (std::string& word : command) words.push_back(word.data());
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const auto& [own, given] :
       {std::pair{STDIN_FILENO, input}, {STDOUT_FILENO, output}, {STDERR_FILENO, errors}})
    if (given >= 0)
      posix_spawn_file_actions_adddup2(&actions, given, own);
    else
      posix_spawn_file_actions_addopen(&actions, own, "/dev/null", O_RDWR, 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t pid = -1;
  const int error = posix_spawnp(&pid, words[0], &actions, &attributes, words.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  errno = error;
  return error == 0 ? pid : -1;
}

ApartEnd runApart(std::vector<std::string> command, std::string_view input, std::uint64_t seconds,
                  const std::stop_token& stop) {
  ApartEnd result;
  const int file = ::memfd_create("apart", MFD_CLOEXEC);
  int ends[2] = {-1, -1};
  const bool ready =
      file >= 0 && writeAll(file, input) && ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0;
  const pid_t pid = ready ? startProcess(std::move(command), file, ends[1], -1) : -1;
  ::close(ends[1]);
  if (pid >= 0) {
    const bool ended = listen(ends[0], seconds, stop, result.said);
    ::kill(pid, SIGKILL);  // what it tidies up is not waited for
    int status = 0;
    rusage used{};
    while (::wait4(pid, &status, 0, &used) < 0 && errno == EINTR) {
    }
    result.seconds = static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                     1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
    result.mebibytes = static_cast<std::uint64_t>(used.ru_maxrss) >> 10;
    result.made = readAll(file);
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (!ended)
      result.how = fmt::format("no end after {} s by the clock", kClockPerProcessor * seconds);
    else if (signal == SIGXCPU || signal == SIGKILL)
      result.how = "no end in that time";
    else if (signal != 0)
      result.how = fmt::format("signal {} ({})", signal, strsignal(signal));
    else
      result.how = fmt::format("exit code {}", WEXITSTATUS(status));
  }
  ::close(ends[0]);
  ::close(file);
  return result;
}

std::string beginApart() {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  // How this process ends is what it is for: by the signal itself, not by what a sanitizer or an embedder makes of it.
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) std::signal(signal, SIG_DFL);
  return readAll(STDIN_FILENO);
}

void takeLimits(std::uint64_t seconds, std::uint64_t bytes) {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  setLimit(RLIMIT_CPU, static_cast<std::uint64_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + 1 + seconds);
  setLimit(RLIMIT_CORE, 0);
  if (kBoundsMemory) setLimit(RLIMIT_AS, mappedBytes() + bytes);
}

void sayStep(char step) {
  if (::write(STDOUT_FILENO, &step, 1) != 1) ::_exit(0);  // nobody listens
}

void endApart(std::string_view made, char last) {
  const bool good = writeAll(STDIN_FILENO, made);
  if (good && last != 0) sayStep(last);
  ::_exit(good ? 0 : 1);
}

}  // namespace weft::text
