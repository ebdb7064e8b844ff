// The GLSL files below folders, to find the nearest to a misspelt path in. A folder is listed once, however
// many files are missing, and no more than a number of entries is looked at in all: a hint may do without the
// rest. Does not: read files.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

namespace weft::glsl {

class ShaderNames {
 public:
  // `mostSeen`: how many files and folders are looked at in all.
  explicit ShaderNames(std::size_t mostSeen = 100'000) : mostSeen_(mostSeen) {}

  // Paths relative to their folder, sorted, each once. Folders that may not be read are left out.
  const std::vector<std::string>& below(std::span<const std::string> folders);
  // Files may have come and gone: list anew.
  void forget();

 private:
  std::vector<std::string> list(const std::string& folder);

  std::map<std::vector<std::string>, std::vector<std::string>> known_;
  std::size_t mostSeen_;
  std::size_t seen_ = 0, kept_ = 0;  // entries looked at, names in known_
};

// For an included file that is not there: one of the same name in another folder, else the nearest of `names`.
std::string hintForInclude(const std::string& name, const std::vector<std::string>& names);

}  // namespace weft::glsl
