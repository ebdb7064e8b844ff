// What the program says on standard output and standard error, which may be full, closed, or gone (`| head`).
// Nothing here throws: what could not be written is reported at the end, by finishStreams(), and makes the exit
// code. Does not: format, or know diagnostics that commands collect.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace weft::app {

// First of all: a reader that goes away and a file that grows beyond its limit are errors of a write and no
// end of the program, and a stream that is closed is not given to the next file that opens.
void prepareStreams();

void print(std::string_view text);       // on standard output
void flushPrinted();                     // what a session prints shows at once
void printError(std::string_view text);  // on standard error

// As text with indentation; bytes that are no UTF-8 are replaced.
std::string dumpJson(const nlohmann::ordered_json& json);

// At the end, with the exit code so far: writes what is left. After a failed write it says so (W180) and
// returns 1 at least; a reader of standard output that went away is not an error, and gives 141 in place of
// 0, as a shell counts it.
int finishStreams(int exitCode);

}  // namespace weft::app
