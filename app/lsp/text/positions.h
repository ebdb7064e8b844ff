// Places of the Language Server Protocol: lines from 0 and UTF-16 code units within them, and file URIs. Diagnostics count lines
// and bytes, both from 1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "engine/text/json/dom.h"

namespace weft::app::lsp {

using Json = nlohmann::ordered_json;

struct Position {
  std::uint32_t line = 0, character = 0;
};

using Range = text::ByteRange;

// A text with the offsets of its lines, which end with \n, \r\n or \r. An offset or position outside is taken for the nearest
// one inside. The text must outlive it.
class LineMap {
 public:
  explicit LineMap(std::string_view text);
  std::size_t offsetOf(const Position& position) const;
  Position positionOf(std::size_t offset) const;

 private:
  struct Mark {
    std::size_t offset = 0;
    std::uint32_t units = 0;  // from the beginning of its line
  };
  std::string_view text_;
  std::vector<std::size_t> lines_;
  std::vector<Mark> marks_;  // one for each kStride bytes, so that a mark is near in a long line, too
};

Json toJson(const LineMap& map, const Range& range);

// The path of a file: URI; "" for another URI.
std::string pathOfUri(std::string_view uri);
std::string uriOfPath(std::string_view path);

// An absolute path without "." and "..".
std::string pathKey(const std::string& path);

}  // namespace weft::app::lsp
