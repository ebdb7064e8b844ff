// Places of the Language Server Protocol: lines from 0 and UTF-16 code units in them, file URIs. Those of diagnostics are
// lines from 1 and bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/diagnostic.h"

namespace weft::app::lsp {

using Json = nlohmann::ordered_json;

struct Position {
  std::uint32_t line = 0, character = 0;
  friend auto operator<=>(const Position&, const Position&) = default;
};

// Bytes [begin, end) of a text.
struct Range {
  std::size_t begin = 0, end = 0;
  bool holds(std::size_t at) const { return begin <= at && at <= end; }
};

// A text with the beginnings of its lines. Ends of lines are \n, \r\n and \r. Offsets and positions outside of it are
// taken for the nearest inside.
class LineMap {
 public:
  explicit LineMap(std::string_view text);
  std::size_t offsetOf(const Position& position) const;
  Position positionOf(std::size_t offset) const;
  // The offset of a diagnostic's place: lines end with \n there, a column counts bytes.
  std::size_t offsetOf(const base::Place& place) const;
  std::string_view text() const { return text_; }

 private:
  std::size_t endOfLine(std::size_t line) const;
  struct Mark {
    std::size_t offset = 0;   // where a character begins
    std::uint32_t units = 0;  // from the beginning of its line
  };
  std::string_view text_;
  std::vector<std::size_t> lines_;
  std::vector<Mark> marks_;  // of each kStride bytes, so that positions in a long line are near to one
};

Json toJson(const Position& position);
Json toJson(const LineMap& map, const Range& range);

// "" when it is no file: URI.
std::string pathOfUri(std::string_view uri);
std::string uriOfPath(std::string_view path);

}  // namespace weft::app::lsp
