#include "app/output/standard_streams.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

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

void printError(std::string_view text) {
  put(text, stderr, errorFailure);
}

std::string dumpJson(const nlohmann::ordered_json& json) {
  return text::printableJson(json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

int finishStreams(int exitCode) {
  flushPrinted();
  if (outputFailure == 0 && std::ferror(stdout)) outputFailure = EIO;
  if (outputFailure == EPIPE) return exitCode == 0 ? kReaderLeft : exitCode;
  if (outputFailure != 0) {
    text::Diagnostics diagnostics;
    diagnostics
        .error(text::Code::outputNotWritten, {},
               fmt::format("not everything could be written to standard output: {}",
                           std::strerror(outputFailure)))
        .hint = outputFailure == ENOSPC || outputFailure == EFBIG
                    ? "free some space, or send it somewhere else"
                    : "send it to a file or a pipe that takes it";
    printError(diagnostics.text());
  }
  // Messages that nobody could read are no success; a reader that left wanted no more of them.
  const bool lost =
      (errorFailure != 0 && errorFailure != EPIPE) || (errorFailure == 0 && std::ferror(stderr));
  return exitCode == 0 && (outputFailure != 0 || lost) ? 1 : exitCode;
}

}  // namespace weft::app
