// A process of its own for work that may crash, take all memory or never end: the compiler of a driver (engine/gl/programs), readers
// of models whose makers do not fuzz them (engine/assets/models/fbx). It is this executable again, started with a first word that its
// main() knows, or another program (weft-fbx). What it is to do is on its standard input, a file in memory, in which it leaves what it
// made; how far it is, it says on its standard output, a byte a step.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace weft::text {

struct ApartEnd {
  std::string said;             // the steps
  std::string made;             // what is in the file now
  std::string how;              // "signal 11 (Segmentation fault)", "no end in that time", "exit code 1"
  double seconds = 0;           // of processor time
  std::uint64_t mebibytes = 0;  // of memory at most
};

// The process is gone when this returns: it is ended when it closes its standard output, when it has said nothing for six times
// `seconds` by the clock, or when `stop` says so, which is looked at with each step, and twenty times a second.
ApartEnd runApart(std::vector<std::string> command, std::string_view input, std::uint64_t seconds,
                  const std::stop_token& stop = {});

// Starts a program, which is looked for in the PATH when its name has no slash, with these as its standard streams (-1: /dev/null), and
// returns at once. Ctrl-C does not reach it. -1, and errno says why, when it cannot be started.
pid_t startProcess(std::vector<std::string> command, int input, int output, int errors);

// ---- in that process ----

// All of standard input. The process ends with the one that started it.
std::string beginApart();
// From now on at most so many seconds of processor time and bytes of memory more.
void takeLimits(std::uint64_t seconds, std::uint64_t bytes);
void sayStep(char step);
// Replaces what is in the file, says a last step unless it is 0, and ends.
[[noreturn]] void endApart(std::string_view made = {}, char last = 0);

}  // namespace weft::text
