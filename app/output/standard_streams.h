// Writes to standard output and standard error, which may be full or closed, or whose reader may have gone (`| head`).
// Nothing here throws: finishStreams() reports at the end what could not be written, and gives the exit code.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace weft::app {

// To be called first. A reader that goes away, or a file that grows beyond its limit, then makes a write fail instead of
// ending the program; and the number of a closed stream is not given to the next file that opens.
void prepareStreams();

void print(std::string_view text);  // on standard output
// Columns as wide as their widest cell, the last as it is.
void printTable(const std::vector<std::vector<std::string>>& rows);
void flushPrinted();                     // writes what print() has kept back so far
void printError(std::string_view text);  // on standard error

// Indented text. Bytes that are no UTF-8 are replaced.
std::string dumpJson(const nlohmann::ordered_json& json);

// To be called at the end, with the exit code so far: writes what is left. After a failed write it reports W180 and
// returns at least 1. When the reader of standard output has gone, that is no error: it returns 141 instead of 0, as a
// shell would.
int finishStreams(int exitCode);

}  // namespace weft::app
