#include "app/lsp/lsp.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <optional>

#include "app/lsp/server.h"
#include "app/output/standard_streams.h"
#include "engine/text/chars.h"
#include "engine/text/printable.h"

namespace weft::app {

namespace {

constexpr std::size_t kMaxHeader = 65536, kMaxMessage = std::size_t{64} << 20;  // bytes

// Reads messages of the Language Server Protocol 3.17, "Base Protocol": header lines, an empty line, and as many bytes of JSON as
// Content-Length says. Any input gives a message or an error, and after an error the next message is found.
class MessageReader {
 public:
  // A message, or a problem. Nothing at the end of the input; then problem() says what was cut off, or "".
  std::optional<std::string> next() {
    problem_.clear();
    std::size_t end = 0;
    while ((end = buffer_.find("\r\n\r\n")) == std::string::npos) {
      // Of what is no header the end may be one.
      const bool tooLong = buffer_.size() > kMaxHeader;
      if (tooLong) buffer_.erase(0, buffer_.size() - 4096);
      if (fill()) continue;
      if (!buffer_.empty())
        problem_ = tooLong ? "the input ended within the header of a message"
                           : fmt::format("the input ended within the header of a message, which begins '{}'",
                                         text::printable(text::shortened(buffer_)));
      return std::nullopt;
    }
    const std::string header = text::lowered(std::string_view(buffer_).substr(0, end));
    buffer_.erase(0, end + 4);
    // What stands before it is the end of a message whose length was not known.
    constexpr std::string_view kLength = "content-length:";
    const std::size_t at = header.rfind(kLength);
    if (at == std::string::npos)
      return problem("expected a header such as 'Content-Length: 20', found '{}'", header);
    std::size_t from = at + kLength.size(), bytes = 0;
    while (from < header.size() && header[from] == ' ') ++from;
    const auto [behind, error] = std::from_chars(header.data() + from, header.data() + header.size(), bytes);
    const bool whole = behind == header.data() + header.size() || *behind == '\r' || *behind == '\n';
    if (error != std::errc{} || !whole)
      return problem("Content-Length: expected a number of bytes, found '{}'", header.substr(from));
    const std::size_t wanted = bytes;
    const bool tooLarge = wanted > kMaxMessage;
    while (buffer_.size() < bytes) {
      if (tooLarge) bytes -= std::exchange(buffer_, {}).size();
      if (fill()) continue;
      problem_ = tooLarge ? fmt::format("the input ended within a message of {} bytes", wanted)
                          : fmt::format("the input ended within a message, after {} of {} bytes",
                                        buffer_.size(), wanted);
      return std::nullopt;
    }
    std::string message = buffer_.substr(0, bytes);
    buffer_.erase(0, bytes);
    if (tooLarge) problem_ = fmt::format("a message of {} bytes; the most are {}", wanted, kMaxMessage);
    return message;
  }

  const std::string& problem() const { return problem_; }

  // Whether more bytes have arrived. Then work that nobody waits for can wait.
  bool hasMore() const {
    pollfd one{STDIN_FILENO, POLLIN, 0};
    return !buffer_.empty() || (::poll(&one, 1, 0) > 0 && (one.revents & POLLIN) != 0);
  }

 private:
  std::string problem(const char* format, const std::string& found) {
    problem_ = fmt::format(fmt::runtime(format), text::printable(text::shortened(found)));
    return {};
  }

  bool fill() {
    char chunk[65536];
    for (;;) {
      const ssize_t got = ::read(STDIN_FILENO, chunk, sizeof chunk);
      if (got > 0) buffer_.append(chunk, static_cast<std::size_t>(got));
      if (got >= 0 || (errno != EINTR && errno != EAGAIN)) return got > 0;
      pollfd one{STDIN_FILENO, POLLIN, 0};
      ::poll(&one, 1, -1);
    }
  }

  std::string buffer_, problem_;
};

}  // namespace

int runLsp(const Options& options) {
  MessageReader reader;
  lsp::Server server(options, [](const lsp::Json& message) {
    const std::string text = message.dump(-1, ' ', false, lsp::Json::error_handler_t::replace);
    print(fmt::format("Content-Length: {}\r\n\r\n{}", text.size(), text));
    flushPrinted();
  });
  while (!server.ended()) {
    if (!reader.hasMore()) server.settle();
    const std::optional<std::string> message = reader.next();
    if (!message) {
      printError(fmt::format("weft lsp: {}; editors end the server by 'shutdown' and 'exit'\n",
                             reader.problem().empty() ? "the input ended without 'exit'" : reader.problem()));
      return 1;
    }
    if (reader.problem().empty())
      server.take(*message);
    else
      server.refuse(reader.problem());
  }
  return *server.ended();
}

}  // namespace weft::app
