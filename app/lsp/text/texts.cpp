#include "app/lsp/text/texts.h"

#include <filesystem>

#include "engine/base/files/file_overlay.h"
#include "engine/base/files/text_file.h"

namespace weft::app::lsp {

const base::JsonTree& Text::json() const {
  if (!json_) json_ = base::parseJsonTree(bytes_);
  return *json_;
}

const GlslOutline& Text::glsl() const {
  if (!glsl_) glsl_.emplace(bytes_);
  return *glsl_;
}

std::string_view Text::written(const JsonValue& string) const {
  const Range range = inside(string);
  return std::string_view(bytes_).substr(range.begin, range.end - range.begin);
}

Texts::~Texts() {
  for (const auto& [path, version] : opened_) base::dropOverlay(path);
}

void Texts::open(const std::string& path, std::string text, std::int64_t version) {
  opened_[path] = version;
  replace(path, std::move(text));
}

void Texts::replace(const std::string& path, std::string text) {
  if (!isOpen(path)) return;
  base::overlayFile(path, text);
  texts_[path] = std::make_shared<const Text>(path, std::move(text));
}

void Texts::change(const std::string& path, const Position& start, const Position& end,
                   const std::string& text) {
  const auto found = texts_.find(path);
  if (found == texts_.end()) return;
  const LineMap& map = found->second->map();
  const std::size_t from = map.offsetOf(start), to = map.offsetOf(end);
  if (to < from) return;
  std::string bytes = found->second->bytes();
  replace(path, std::move(bytes.replace(from, to - from, text)));
}

void Texts::setVersion(const std::string& path, std::int64_t version) {
  if (const auto found = opened_.find(path); found != opened_.end()) found->second = version;
}

void Texts::close(const std::string& path) {
  base::dropOverlay(path);
  opened_.erase(path);
  texts_.erase(path);
}

std::shared_ptr<const Text> Texts::of(const std::string& path) const {
  if (const auto found = texts_.find(path); found != texts_.end()) return found->second;
  std::error_code ec;
  const auto time = std::filesystem::last_write_time(path, ec);
  const auto bytes = ec ? 0 : std::filesystem::file_size(path, ec);
  if (ec) return nullptr;
  Known& known = onDisk_[path];
  const auto stamp = static_cast<std::int64_t>(time.time_since_epoch().count());
  if (known.text && known.time == stamp && known.bytes == bytes) return known.text;
  base::Diagnostics ignored;
  auto text = base::readTextFile(path, ignored);
  if (!text) return nullptr;
  known = {std::make_shared<const Text>(path, *std::move(text)), stamp, bytes};
  return known.text;
}

}  // namespace weft::app::lsp
