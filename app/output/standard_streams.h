// Writes to standard output and standard error, which may be full or closed, or whose reader may have gone (`| head`).
// Nothing here throws: finishStreams() reports at the end what could not be written, and gives the exit code.
#pragma once

#include <chrono>
#include <cstdint>
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
void printNow(std::string_view text);    // both
void printError(std::string_view text);  // on standard error

// To be called at the end: writes what is left. After a failed write it reports W180 and returns at least 1; 141 when the reader of
// standard output has gone, as a shell would.
int finishStreams(int exitCode);

// "4.2 s", "52 s", "12 min", "2.2 h": as exact as an estimate is worth.
std::string durationText(double seconds);

// Of `total`, `lead` frames run only because a later frame looks back at them, and `done` are finished after `seconds`. The first
// took `first`: it compiles and loads.
struct Progress {
  std::uint64_t done = 0, total = 1, lead = 0;
  double seconds = 0, first = 0;
  const char* unit = "frames";  // what is counted
};

// "12/501 frames, 500 of them lead up to the first picture, 2.2 h left".
std::string progressText(const Progress& progress);

// How far a long run is, on standard error: one line on a terminal, elsewhere a line every ten seconds, later every few minutes.
class ProgressLines {
 public:
  explicit ProgressLines(Progress progress) : progress_(progress) {}
  // To be called when one more is done.
  void countOne();

 private:
  Progress progress_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double printed_ = 0;  // seconds
};

}  // namespace weft::app
