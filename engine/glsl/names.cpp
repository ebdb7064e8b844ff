#include "engine/glsl/names.h"

#include <algorithm>
#include <filesystem>

#include "engine/base/files/file_access.h"
#include "engine/base/nearest.h"

namespace weft::glsl {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostKept = 200'000, kMostOfFolder = 10'000;

}  // namespace

std::vector<std::string> ShaderNames::list(const std::string& folder) {
  std::vector<std::string> names;
  if (!base::mayRead(folder)) return names;
  std::error_code ec;
  for (fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied, ec), end;
       !ec && it != end && names.size() < kMostOfFolder && seen_ < mostSeen_; it.increment(ec)) {
    ++seen_;
    if (it->path().extension() == ".glsl")
      names.push_back(it->path().lexically_relative(folder).generic_string());
  }
  return names;
}

const std::vector<std::string>& ShaderNames::below(std::span<const std::string> folders) {
  static const std::vector<std::string> kNone;
  const std::vector<std::string> key(folders.begin(), folders.end());
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  if (seen_ >= mostSeen_ || kept_ >= kMostKept) return kNone;
  std::vector<std::string> names;
  for (const std::string& folder : folders) {
    std::vector<std::string> more = list(folder);
    names.insert(names.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  kept_ += names.size();
  return known_[key] = std::move(names);
}

void ShaderNames::forget() {
  known_.clear();
  seen_ = kept_ = 0;
}

std::string hintForInclude(const std::string& name, const std::vector<std::string>& names) {
  const auto same =
      std::ranges::find_if(names, [&](const std::string& each) { return each.ends_with("/" + name); });
  return same == names.end() ? base::nearestHint(name, names) : "did you mean '" + *same + "'?";
}

}  // namespace weft::glsl
