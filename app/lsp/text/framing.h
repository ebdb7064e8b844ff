// Reads and writes the frame of the Language Server Protocol 3.17, "Base Protocol": header lines, an empty line, and as many
// bytes of JSON as Content-Length says. Any input gives a message or an error, and after an error the next message is found.
// Does not: parse JSON.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace weft::app::lsp {

struct Incoming {
  enum class State { message, broken, ended };
  State state = State::ended;
  std::string text;  // message: the JSON; broken: what is wrong; ended: what was cut off, or ""
};

class FrameReader {
 public:
  // A message has at most so many bytes; a larger one is skipped and reported.
  static constexpr std::size_t kMostBytes = std::size_t{64} << 20;

  explicit FrameReader(int descriptor) : descriptor_(descriptor) {}
  // Waits for the next message.
  Incoming next();
  // Whether more bytes have arrived. Then work that nobody waits for can wait.
  bool hasMore() const;

 private:
  bool fill();
  bool readLine(std::string& line, bool& tooLong);
  bool skip(std::size_t bytes);

  int descriptor_;
  std::string buffer_;
  std::size_t at_ = 0;
};

// A message with its header.
std::string framed(std::string_view json);

}  // namespace weft::app::lsp
