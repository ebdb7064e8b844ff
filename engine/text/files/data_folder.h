// The folder that holds graphs/, shaders/, scenes/, materials/ and words/.
#pragma once

#include <string>

namespace weft::text {

// $WEFT_DATA, else where Weft was built, else where it was installed. It need not be there.
std::string dataFolder();

}  // namespace weft::text
