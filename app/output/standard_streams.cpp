#include "app/output/standard_streams.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "app_sentences.h"
#include "engine/text/diagnostic.h"
#include "engine/text/printable.h"

namespace weft::app {

namespace {

constexpr int kReaderLeft = 128 + SIGPIPE;  // what a shell says of a program that writes to nobody

// The reason of the first failure of each; 0: all is well.
int outputFailure = 0, errorFailure = 0;

void put(std::string_view text, std::FILE* stream, int& failure) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stream) != text.size() && failure == 0)
    failure = errno != 0 ? errno : EIO;
}

}  // namespace

void prepareStreams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF)
      // The lowest free number is this one. To be read only: a write to it still fails.
      if (const int opened = ::open("/dev/null", O_RDONLY); opened > stream) ::close(opened);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void print(std::string_view text) {
  put(text, stdout, outputFailure);
}

void printTable(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i + 1 < row.size(); ++i)
      widths[i] = std::max(widths[i], text::printable(row[i]).size());
  }
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i)
      line += fmt::format("{:<{}}  ", text::printable(row[i]), widths[i]);
    line.erase(line.find_last_not_of(' ') + 1);
    print(line + "\n");
  }
}

void flushPrinted() {
  errno = 0;
  if (std::fflush(stdout) != 0 && outputFailure == 0) outputFailure = errno != 0 ? errno : EIO;
}

void printNow(std::string_view text) {
  print(text);
  flushPrinted();
}

void printError(std::string_view text) {
  put(text, stderr, errorFailure);
}

int finishStreams(int exitCode) {
  flushPrinted();
  if (outputFailure == 0 && std::ferror(stdout)) outputFailure = EIO;
  if (outputFailure == EPIPE) return exitCode == 0 ? kReaderLeft : exitCode;
  if (outputFailure != 0) {
    text::Diagnostics diagnostics;
    const bool full = outputFailure == ENOSPC || outputFailure == EFBIG;
    diagnostics.error(
        say::outputLost, {}, std::strerror(outputFailure),
        full ? "free some space, or send it somewhere else" : "send it to a file or a pipe that takes it");
    printError(diagnostics.text());
  }
  // Messages that nobody could read are no success; a reader that left wanted no more of them.
  const bool lost =
      (errorFailure != 0 && errorFailure != EPIPE) || (errorFailure == 0 && std::ferror(stderr));
  return exitCode == 0 && (outputFailure != 0 || lost) ? 1 : exitCode;
}

std::string durationText(double seconds) {
  if (seconds < 10) return fmt::format("{:.1f} s", std::max(0.0, seconds));
  if (seconds < 90) return fmt::format("{:.0f} s", seconds);
  return seconds < 5400 ? fmt::format("{:.0f} min", seconds / 60) : fmt::format("{:.1f} h", seconds / 3600);
}

std::string progressText(const Progress& p) {
  std::string text = fmt::format("{}/{} {}", p.done, p.total, p.unit);
  if (p.done >= p.total) return text + " in " + durationText(p.seconds);
  if (p.lead > 0) text += fmt::format(", {} of them lead up to the first picture", p.lead);
  const bool apart = p.done > 1;  // the first says little of the rest
  const double each = (p.seconds - (apart ? p.first : 0)) /
                      static_cast<double>(std::max<std::uint64_t>(1, p.done - (apart ? 1 : 0)));
  return text + fmt::format(", {} left", durationText(each * static_cast<double>(p.total - p.done)));
}

void ProgressLines::countOne() {
  ++progress_.done;
  progress_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (progress_.done == 1) progress_.first = progress_.seconds;
  const double pause = std::clamp(progress_.seconds / 10, 10.0, 300.0);
  const bool last = progress_.done == progress_.total, terminal = ::isatty(STDERR_FILENO) == 1;
  if (terminal) printError("\r" + progressText(progress_) + "\033[K" + (last ? "\n" : ""));
  if (terminal || (progress_.seconds - printed_ < pause && !(last && printed_ > 0))) return;
  printError(progressText(progress_) + "\n");
  printed_ = progress_.seconds;
}

}  // namespace weft::app
