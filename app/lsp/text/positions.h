// Places of the Language Server Protocol: lines from 0 and UTF-16 code units within them, and file URIs. Diagnostics count lines
// and bytes, both from 1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/diagnostic.h"
#include "engine/base/json/dom.h"

namespace weft::app::lsp {

using Json = nlohmann::ordered_json;

struct Position {
  std::uint32_t line = 0, character = 0;
  friend auto operator<=>(const Position&, const Position&) = default;
};

using Range = base::ByteRange;

// A text with the offsets of its lines, which end with \n, \r\n or \r. An offset or position outside is taken for the nearest
// one inside. The text must outlive it.
class LineMap {
 public:
  explicit LineMap(std::string_view text);
  std::size_t offsetOf(const Position& position) const;
  Position positionOf(std::size_t offset) const;
  std::string_view text() const { return text_; }

 private:
  std::size_t endOfLine(std::size_t line) const;
  struct Mark {
    std::size_t offset = 0;   // where a character begins
    std::uint32_t units = 0;  // from the beginning of its line
  };
  std::string_view text_;
  std::vector<std::size_t> lines_;
  std::vector<Mark> marks_;  // one for each kStride bytes, so that a mark is near in a long line, too
};

Json toJson(const Position& position);
Json toJson(const LineMap& map, const Range& range);

// The path of a file: URI; "" for another URI.
std::string pathOfUri(std::string_view uri);
std::string uriOfPath(std::string_view path);

}  // namespace weft::app::lsp
