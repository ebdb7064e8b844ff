#include "app/lsp/text/framing.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <optional>

#include "engine/base/printable.h"

namespace weft::app::lsp {

namespace {

constexpr std::size_t kMostHeader = 4096;  // bytes of one line

// Where Content-Length begins in a line, or npos. What stands before it in the line is the end of a message whose length was
// not known.
std::size_t lengthHeaderIn(std::string_view line) {
  constexpr std::string_view kHeader = "content-length:";
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  const auto found = std::ranges::search(line, kHeader, {}, lower);
  return found.empty() ? std::string_view::npos : static_cast<std::size_t>(found.begin() - line.begin());
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

Incoming cutOff(std::string_view what, const std::string& where) {
  return {Incoming::State::ended, fmt::format("the input ended within {}{}", what, where)};
}

}  // namespace

bool FrameReader::fill() {
  if (at_ > 0) buffer_.erase(0, at_);
  at_ = 0;
  char chunk[65536];
  for (;;) {
    const ssize_t got = ::read(descriptor_, chunk, sizeof chunk);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && errno == EAGAIN) {
      pollfd one{descriptor_, POLLIN, 0};
      ::poll(&one, 1, -1);
      continue;
    }
    if (got <= 0) return false;
    buffer_.append(chunk, static_cast<std::size_t>(got));
    return true;
  }
}

bool FrameReader::hasMore() const {
  if (at_ < buffer_.size()) return true;
  pollfd one{descriptor_, POLLIN, 0};
  return ::poll(&one, 1, 0) > 0 && (one.revents & POLLIN) != 0;
}

// Reads a line without its end; of a line that is too long, the last part. False at the end of the stream.
bool FrameReader::readLine(std::string& line, bool& tooLong) {
  line.clear();
  for (;;) {
    const std::size_t end = buffer_.find('\n', at_);
    const std::size_t stop = std::min(end, buffer_.size());
    tooLong |= line.size() + (stop - at_) > kMostHeader;
    line.append(buffer_, at_, stop - at_);
    if (line.size() > kMostHeader) line.erase(0, line.size() - kMostHeader);
    at_ = stop;
    if (end != std::string::npos) {
      ++at_;
      if (line.ends_with('\r')) line.pop_back();
      return true;
    }
    if (!fill()) return false;
  }
}

bool FrameReader::skip(std::size_t bytes) {
  while (bytes > buffer_.size() - at_) {
    bytes -= buffer_.size() - at_;
    at_ = buffer_.size();
    if (!fill()) return false;
  }
  at_ += bytes;
  return true;
}

Incoming FrameReader::next() {
  std::optional<std::size_t> length;
  std::string line, problem;
  bool any = false;
  for (;;) {
    bool tooLong = false;
    if (!readLine(line, tooLong)) {
      if (line.empty() && !any) return {};
      return cutOff("the header of a message",
                    line.empty() || tooLong
                        ? ""
                        : fmt::format(", which begins '{}'", base::printable(base::shortened(line))));
    }
    if (tooLong && problem.empty()) problem = "a header line is too long";
    if (line.empty() && !any) continue;  // an empty line between messages
    if (line.empty()) break;
    any = true;
    const std::size_t header = lengthHeaderIn(line);
    if (header == std::string::npos) {
      if (problem.empty() && line.find(':') == std::string::npos)
        problem = fmt::format("expected a header such as 'Content-Length: 20', found '{}'",
                              base::printable(base::shortened(line)));
      continue;
    }
    const std::string_view digits = trimmed(std::string_view(line).substr(line.find(':', header) + 1));
    std::size_t bytes = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), bytes);
    if (error == std::errc{} && end == digits.data() + digits.size() && !digits.empty())
      length = bytes;
    else if (problem.empty())
      problem = fmt::format("Content-Length: expected a number of bytes, found '{}'",
                            base::printable(base::shortened(std::string(digits))));
  }
  if (length && *length > kMostBytes) {
    if (!skip(*length)) return cutOff("a message", fmt::format(" of {} bytes", *length));
    return {Incoming::State::broken,
            fmt::format("a message of {} bytes; the most are {}", *length, kMostBytes)};
  }
  if (!length)
    return {Incoming::State::broken, problem.empty() ? "a message without Content-Length" : problem};
  while (buffer_.size() - at_ < *length)
    if (!fill())
      return cutOff("a message", fmt::format(", after {} of {} bytes", buffer_.size() - at_, *length));
  Incoming message{Incoming::State::message, buffer_.substr(at_, *length)};
  at_ += *length;
  return message;
}

std::string framed(std::string_view json) {
  return fmt::format("Content-Length: {}\r\n\r\n{}", json.size(), json);
}

}  // namespace weft::app::lsp
