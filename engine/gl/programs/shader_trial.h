// Compiles a program in a process of its own first. A driver that crashes, takes all memory or never ends then harms
// only that process. The process is this executable again, started with kTrialWord, or one that an embedder names. It
// opens a context of the same driver, compiles, links, and makes the driver generate machine code by a draw or a
// dispatch that covers nothing, so that no loop of the shader runs. Which programs are tried: glsl::isUnusual().
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/gl/context/context.h"
#include "engine/gl/programs/program.h"

namespace weft::gl {

// First argument of the process that is started; its main() hands over to runTrial().
constexpr const char* kTrialWord = "try-program";

constexpr std::uint64_t kMaxTrialBytes = 768ull << 20;  // that a program may take to compile

// What trials may cost together, in seconds of processor time.
struct Trials {
  std::vector<std::string>
      command;  // the executable and what comes before kTrialWord; empty: nothing is tried
  double all = 0, spent = 0;
};

// False after an error (W204): the driver did not survive the program, or no time is left to try it. True also when no
// process or context could be had: then nothing is known. The process is gone when this returns: it is ended when the time
// is spent, or when it has said nothing for six times that by the clock.
bool survivesTrial(Trials& trials, const DeviceInfo& device, std::span<const StageSource> stages,
                   std::span<const glsl::Define> defines, std::span<const std::string> outputs,
                   text::Diagnostics& diagnostics);

// The other end: `argv` from kTrialWord on, the program on standard input. Does not return.
[[noreturn]] void runTrial(int argc, char** argv);

}  // namespace weft::gl
