#include "app/lsp/text/positions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <iterator>

namespace weft::app::lsp {

namespace {

// How many bytes the UTF-8 character at `at` has; 1 where there is none.
std::size_t bytesAt(std::string_view text, std::size_t at) {
  const auto byte = static_cast<unsigned char>(text[at]);
  const std::size_t wanted = byte < 0x80                   ? 1
                             : byte >= 0xF0 && byte < 0xF8 ? 4
                             : byte >= 0xE0                ? 3
                             : byte >= 0xC2                ? 2
                                                           : 1;
  if (at + wanted > text.size()) return 1;
  for (std::size_t i = 1; i < wanted; ++i)
    if ((static_cast<unsigned char>(text[at + i]) & 0xC0) != 0x80) return 1;
  return wanted;
}

// UTF-16 code units of a character of so many bytes of UTF-8.
std::uint32_t unitsOf(std::size_t bytes) {
  return bytes == 4 ? 2 : 1;
}

constexpr std::size_t kStride = 4096;  // bytes from one mark to the next

}  // namespace

LineMap::LineMap(std::string_view text) : text_(text) {
  lines_.push_back(0);
  std::uint32_t units = 0;
  for (std::size_t i = 0; i < text.size();) {
    if (i >= marks_.size() * kStride) marks_.push_back({i, units});
    const std::size_t bytes = bytesAt(text, i);
    if (text[i] == '\n' || (text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n'))) {
      lines_.push_back(i + 1);
      units = 0;
    } else {
      units += unitsOf(bytes);
    }
    i += bytes;
  }
}

std::size_t LineMap::endOfLine(std::size_t line) const {
  if (line + 1 == lines_.size()) return text_.size();
  std::size_t end = lines_[line + 1] - 1;
  if (end > lines_[line] && text_[end] == '\n' && text_[end - 1] == '\r') --end;
  return end;
}

std::size_t LineMap::offsetOf(const Position& position) const {
  if (position.line >= lines_.size()) return text_.size();
  const std::size_t end = endOfLine(position.line);
  std::size_t at = lines_[position.line];
  for (std::uint32_t units = 0; at < end && units < position.character;) {
    const std::size_t bytes = bytesAt(text_, at);
    units += unitsOf(bytes);
    if (units > position.character) break;  // the position is in the middle of a surrogate pair
    at += bytes;
  }
  return std::min(at, end);
}

Position LineMap::positionOf(std::size_t offset) const {
  offset = std::min(offset, text_.size());
  const auto after = std::upper_bound(lines_.begin(), lines_.end(), offset);
  const auto line = static_cast<std::size_t>(after - lines_.begin()) - 1;
  Mark from{lines_[line], 0};
  const auto next = std::ranges::upper_bound(marks_, offset, {}, &Mark::offset);
  if (next != marks_.begin() && std::prev(next)->offset > from.offset) from = *std::prev(next);
  while (from.offset < offset) {
    const std::size_t bytes = bytesAt(text_, from.offset);
    from.units += unitsOf(bytes);
    from.offset += bytes;
  }
  return {static_cast<std::uint32_t>(line), from.units};
}

Json toJson(const Position& position) {
  return {{"line", position.line}, {"character", position.character}};
}

Json toJson(const LineMap& map, const Range& range) {
  return {{"start", toJson(map.positionOf(range.begin))}, {"end", toJson(map.positionOf(range.end))}};
}

std::string pathOfUri(std::string_view uri) {
  if (!uri.starts_with("file://")) return "";
  uri.remove_prefix(7);
  const std::size_t slash = uri.find('/');  // the path begins behind the host, which is taken for this one
  if (slash == std::string_view::npos) return "";
  uri.remove_prefix(slash);
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned value = 0;
    if (uri[i] == '%' && i + 2 < uri.size()) {
      const auto [end, error] = std::from_chars(uri.data() + i + 1, uri.data() + i + 3, value, 16);
      if (error == std::errc{} && end == uri.data() + i + 3) {
        path += static_cast<char>(value);
        i += 2;
        continue;
      }
    }
    path += uri[i];
  }
  if (path.find('\0') != std::string::npos) return "";
  return std::filesystem::path(path).lexically_normal().string();
}

std::string uriOfPath(std::string_view path) {
  std::error_code ec;
  const std::filesystem::path absolute = std::filesystem::absolute(path, ec);
  const std::string text = (ec ? std::filesystem::path(path) : absolute).lexically_normal().string();
  std::string uri = "file://";
  for (const char c : text) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) ||
                       std::string_view("/._-~").find(c) != std::string_view::npos;
    uri += plain ? std::string(1, c)
                 : fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
  }
  return uri;
}

}  // namespace weft::app::lsp
