// Where the bytes of a file stand until they are whole and it is renamed. Does not: make, write or rename anything.
#pragma once

#include <string>

namespace weft::base {

// Beside `path`, also where its name is as long as a name may be.
std::string temporaryBeside(const std::string& path);

}  // namespace weft::base
