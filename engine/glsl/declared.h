// What the text of a shader says that introspection does not: which blocks have an instance name, and with which format
// images are declared. From a scan of tokens that knows neither macros nor which branch of an #if is taken: a name may
// have several formats, and one that a macro makes is not here.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace weft::glsl {

struct DeclaredParts {
  std::map<std::string, std::string, std::less<>>
      instanceOf;  // by block: "Parameters" has the instance "params"
  std::map<std::string, std::string, std::less<>> blockOf;  // by member, of blocks with an instance name
  std::map<std::string, std::vector<std::string>, std::less<>> imageFormats;  // by image: "rgba8"
};

}  // namespace weft::glsl
