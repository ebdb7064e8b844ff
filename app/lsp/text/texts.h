// The texts that the server works on: those that the editor has open, as the editor has them, and files on disk. Open texts are
// overlays (engine/base/files/file_overlay.h), so that all of Weft reads them. Outlines are made when they are first asked for.
// Paths are absolute.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "app/lsp/text/glsl_outline.h"
#include "app/lsp/text/json_spot.h"
#include "app/lsp/text/positions.h"

namespace weft::app::lsp {

class Text {
 public:
  Text(std::string path, std::string bytes)
      : path_(std::move(path)), bytes_(std::move(bytes)), map_(bytes_) {}
  Text(const Text&) = delete;
  Text& operator=(const Text&) = delete;
  const std::string& path() const { return path_; }
  const std::string& bytes() const { return bytes_; }
  const LineMap& map() const { return map_; }
  const base::JsonTree& json() const;
  const GlslOutline& glsl() const;
  // A string as it is written, without its quotes.
  std::string_view written(const JsonValue& string) const;
  bool isJson() const { return path_.ends_with(".json"); }

 private:
  const std::string path_, bytes_;
  const LineMap map_;
  mutable std::optional<base::JsonTree> json_;
  mutable std::optional<GlslOutline> glsl_;
};

class Texts {
 public:
  ~Texts();
  void open(const std::string& path, std::string text, std::int64_t version);
  // Replaces the whole text, or a range of it. Nothing happens when it is not open, or the range ends before it begins.
  void replace(const std::string& path, std::string text);
  void change(const std::string& path, const Position& start, const Position& end, const std::string& text);
  void setVersion(const std::string& path, std::int64_t version);
  void close(const std::string& path);

  // Versions by path.
  const std::map<std::string, std::int64_t>& opened() const { return opened_; }
  bool isOpen(const std::string& path) const { return opened_.contains(path); }

  // Null when there is no such file. A text that was returned does not change when the file does.
  std::shared_ptr<const Text> of(const std::string& path) const;

 private:
  struct Known {
    std::shared_ptr<const Text> text;
    std::int64_t time = 0;
    std::uint64_t bytes = 0;
  };
  std::map<std::string, std::int64_t> opened_;
  std::map<std::string, std::shared_ptr<const Text>> texts_;  // of opened_
  mutable std::map<std::string, Known> onDisk_;
};

}  // namespace weft::app::lsp
