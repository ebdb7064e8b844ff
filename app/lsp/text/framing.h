// The frame of the Language Server Protocol 3.17, "Base Protocol": header lines, an empty line, as many bytes of JSON as
// Content-Length says. Whatever comes in, a message or an error comes out, and the next message is found again. Does not:
// parse JSON.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace weft::app::lsp {

struct Incoming {
  enum class State { message, broken, ended };
  State state = State::ended;
  std::string text;  // the JSON; of a broken one what is wrong; of an ended one what was cut off, or nothing
};

class FrameReader {
 public:
  // The bytes of one message at most; more are skipped and reported.
  static constexpr std::size_t kMostBytes = std::size_t{64} << 20;

  explicit FrameReader(int descriptor) : descriptor_(descriptor) {}
  // Waits for the next message.
  Incoming next();
  // Whether bytes are there already: then more has happened, and answers that nobody waits for can wait.
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
