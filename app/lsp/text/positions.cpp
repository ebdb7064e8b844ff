#include "app/lsp/text/positions.h"

#include <algorithm>
#include <filesystem>

#include "engine/text/files/file.h"
#include "engine/text/json/report.h"

namespace weft::app::lsp {

namespace {

// UTF-16 code units of a byte of UTF-8: those of its character at the first byte, 0 at the others.
std::uint32_t unitsOf(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (byte & 0xC0) == 0x80 ? 0 : byte >= 0xF0 ? 2 : 1;
}

constexpr std::size_t kStride = 4096;  // bytes from one mark to the next

}  // namespace

LineMap::LineMap(std::string_view text) : text_(text) {
  lines_.push_back(0);
  std::uint32_t units = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (i % kStride == 0) marks_.push_back({i, units});
    units += unitsOf(text[i]);
    if (text[i] == '\n' || (text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n'))) {
      lines_.push_back(i + 1);
      units = 0;
    }
  }
}

std::size_t LineMap::offsetOf(const Position& position) const {
  if (position.line >= lines_.size()) return text_.size();
  const bool last = position.line + 1 == lines_.size();
  std::size_t end = last ? text_.size() : lines_[position.line + 1];
  std::size_t at = lines_[position.line];
  while (end > at && (text_[end - 1] == '\n' || text_[end - 1] == '\r')) --end;
  // A position in the middle of a surrogate pair is before it.
  for (std::uint32_t units = 0; at < end && units + unitsOf(text_[at]) <= position.character; ++at)
    units += unitsOf(text_[at]);
  return at;
}

Position LineMap::positionOf(std::size_t offset) const {
  offset = std::min(offset, text_.size());
  const auto line = static_cast<std::size_t>(std::ranges::upper_bound(lines_, offset) - lines_.begin()) - 1;
  Mark from{lines_[line], 0};
  if (const std::size_t mark = offset / kStride; mark < marks_.size() && marks_[mark].offset > from.offset)
    from = marks_[mark];
  for (; from.offset < offset; ++from.offset) from.units += unitsOf(text_[from.offset]);
  return {static_cast<std::uint32_t>(line), from.units};
}

Json toJson(const LineMap& map, const Range& range) {
  const auto json = [&](std::size_t offset) {
    const Position position = map.positionOf(offset);
    return Json{{"line", position.line}, {"character", position.character}};
  };
  return {{"start", json(range.begin)}, {"end", json(range.end)}};
}

std::string pathKey(const std::string& path) {
  return text::absolutePath(path);
}

std::string pathOfUri(std::string_view uri) {
  if (!uri.starts_with("file://")) return "";
  uri.remove_prefix(7);
  const std::size_t slash = uri.find('/');  // the path begins behind the host, which is taken for this one
  if (slash == std::string_view::npos) return "";
  uri.remove_prefix(slash);
  const std::string path = text::unescapeUri(uri);
  if (path.find('\0') != std::string::npos) return "";
  return std::filesystem::path(path).lexically_normal().string();
}

std::string uriOfPath(std::string_view path) {
  return text::uriOf(pathKey(std::string(path)));
}

}  // namespace weft::app::lsp
