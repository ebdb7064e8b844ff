#include "engine/text/files/file_overlay.h"

#include <atomic>
#include <filesystem>
#include <map>
#include <mutex>

namespace weft::text {

namespace {

struct Overlays {
  std::mutex mutex;
  std::map<std::string, Overlay> byPath;
  std::uint64_t generation = 0;
  std::atomic<std::size_t> count = 0;
};

Overlays& overlays() {
  static Overlays all;
  return all;
}

std::string keyOf(const std::string& path) {
  std::error_code ec;
  const std::filesystem::path absolute = std::filesystem::absolute(path, ec);
  return (ec ? std::filesystem::path(path) : absolute).lexically_normal().string();
}

}  // namespace

void overlayFile(const std::string& path, std::string text) {
  Overlays& all = overlays();
  const std::lock_guard lock(all.mutex);
  all.byPath[keyOf(path)] = {std::make_shared<const std::string>(std::move(text)), ++all.generation};
  all.count = all.byPath.size();
}

void dropOverlay(const std::string& path) {
  Overlays& all = overlays();
  const std::lock_guard lock(all.mutex);
  all.byPath.erase(keyOf(path));
  all.count = all.byPath.size();
}

std::optional<Overlay> overlayOf(const std::string& path) {
  Overlays& all = overlays();
  if (all.count == 0) return std::nullopt;
  const std::lock_guard lock(all.mutex);
  const auto found = all.byPath.find(keyOf(path));
  return found == all.byPath.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace weft::text
