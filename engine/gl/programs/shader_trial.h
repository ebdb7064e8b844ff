// Compiles a program in a process of its own first. A driver that crashes, takes all memory or never ends then harms
// only that process. The process is this executable again, started with kTrialWord, or one that an embedder names. It
// opens a context of the same driver, compiles, links, and makes the driver generate machine code by a draw or a
// dispatch that covers nothing, so that no loop of the shader runs. The caller only learns how the process ended.
// Does not: decide which programs to try (glsl/bounds.h does).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/gl/context/context.h"
#include "engine/gl/programs/program.h"

namespace weft::gl {

// First argument of the process that is started; its main() hands over to runTrial().
constexpr const char* kTrialWord = "try-program";

constexpr std::uint64_t kMostTrialBytes = 768ull << 20;  // that a program may take to compile

struct TrialResult {
  bool survived = true;     // also when no process or context could be had: then nothing is known
  std::string what;         // "signal 11 (Segmentation fault)"
  std::string during;       // "linking"
  double seconds = 0;       // of processor time
  std::uint64_t bytes = 0;  // of memory at most
};

// `command`: the executable and what comes before kTrialWord; empty: nothing is tried. Waits for the process,
// which is gone when this returns: it is ended after `seconds` of processor time, or six times that by the clock.
TrialResult tryProgram(std::span<const std::string> command, Backend backend,
                       std::span<const StageSource> stages, std::span<const glsl::Define> defines,
                       std::span<const std::string> outputs, std::uint64_t seconds);

// The other end: `argv` from kTrialWord on, the program on standard input. Does not return.
[[noreturn]] void runTrial(int argc, char** argv);

}  // namespace weft::gl
