// How a test says aloud that it cannot run here. `./test` repeats the reasons in its last line. A case that
// may skip stands in a doctest suite of its own, which weft_test(… APART suite) makes a ctest of its own: in
// an executable in which something ran, a skipped case is a failure, because ctest would call it passed. Does
// not: decide what is worth skipping.
#pragma once

#include <string>

namespace weft::test {

// The running case cannot run here: `if (!there) return skipCase("no references: …")`. Put it before the
// first check.
void skipCase(const std::string& why);

// Nothing in this executable can run here. Ends the process.
[[noreturn]] void skipAll(const std::string& why);

}  // namespace weft::test
