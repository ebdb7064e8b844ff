// What the things of an ISF file are called in the graph and in the translated shader. Names that Weft or GLSL 4.5
// keep for themselves get a '_' behind them.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

#include "engine/convert/isf/header.h"

namespace weft::convert {

class IsfNames {
 public:
  explicit IsfNames(const IsfHeader& header);
  // The name that it has in the graph and in the shader.
  const std::string& of(std::string_view name) const { return names_.find(name)->second; }
  const std::map<std::string, std::string, std::less<>>& all() const { return names_; }
  // A name for something of the graph alone, that nothing else has.
  std::string fresh(std::string_view wanted);

 private:
  std::map<std::string, std::string, std::less<>> names_;
  std::set<std::string, std::less<>> used_;
};

}  // namespace weft::convert
