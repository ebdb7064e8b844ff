// Variants by (source text, defines, outputs, stages, driver, backend). Memory has those that somebody holds, and some that
// nobody does; the disk has all of them, as program binaries. A broken, foreign or rejected binary is a miss and is
// written anew. A variant that does not compile gives its diagnostics and null, and the caller keeps the program it
// has; the failure is remembered until the sources change, so that asking again compiles nothing. A shader that is
// too large for the driver is refused; an unusual one is first tried in a process of its own.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "engine/gl/context/context.h"
#include "engine/gl/programs/program.h"
#include "engine/glsl/source.h"
#include "engine/text/diagnostic.h"
#include "engine/text/limits.h"

namespace weft::gl {

// ---- trials: shader_trial.cpp ----
// Compiles a program in a process of its own first (engine/text/apart.h). A driver that crashes, takes all memory or never ends then harms
// only that process. The process is this executable again, started with kTrialWord, or one that an embedder names. It
// opens a context of the same driver, compiles, links, and makes the driver generate machine code by a draw or a
// dispatch that covers nothing, so that no loop of the shader runs. Which programs are tried: glsl::isUnusual().

// First argument of the process that is started; its main() hands over to runTrial().
constexpr const char* kTrialWord = "try-program";

constexpr std::uint64_t kMaxTrialBytes = 768ull << 20;  // that a program may take to compile

struct Trials {
  std::vector<std::string> command;  // the executable and what comes before kTrialWord; empty: no trials
  std::uint64_t seconds = 0;         // of processor time for each, whatever was tried before
  bool died = false;  // from then on nothing is tried: a graph of such shaders is not waited for
};

// False after an error (W204): the driver did not survive the program, or another one before. True also when no process or context
// could be had: then nothing is known.
bool survivesTrial(Trials& trials, const DeviceInfo& device, std::span<const StageSource> stages,
                   std::span<const glsl::Define> defines, std::span<const std::string> outputs,
                   text::Diagnostics& diagnostics);

// The other end: `argv` from kTrialWord on, the program on standard input. Does not return.
[[noreturn]] void runTrial(int argc, char** argv);

struct ProgramRequest {
  struct Stage {
    GLenum stage = GL_FRAGMENT_SHADER;
    std::string file;  // found by SourceLoader; a name for messages when `text` is given
    std::string text;  // not empty: GLSL that the engine itself supplies
  };
  std::vector<Stage> stages;
  std::vector<glsl::Define> defines;
  std::vector<std::string> outputs;  // see Program::compile
  std::string label;                 // debug label; not part of the key
  text::Place place;                 // of the graph's "shader" value
  std::string pass;                  // written into diagnostics
};

// A program and the sources it was made from, for checking names against them.
struct Variant {
  Program program;
  std::vector<StageSource> stages;
  std::string key{};                    // of the cache
  std::vector<glsl::Define> defines{};  // of the request
};

// hits + misses: calls whose sources could be read. A remembered failure is a hit. A binary that is absent is
// neither load nor reject; a rejected one is compiled and written anew.
struct ProgramCacheStats {
  std::uint64_t hits = 0, misses = 0;
  std::uint64_t compilations = 0, failures = 0;  // from source; of those
  std::uint64_t refusals = 0;  // too large (W203), or the driver did not survive the trial (W204)
  std::uint64_t trials = 0;
  std::uint64_t binaryLoads = 0, binaryRejects = 0, binaryWrites = 0;
};

class ProgramCache {
 public:
  struct Options {
    std::size_t capacity = 128;                    // above it, variants that nobody holds are forgotten
    std::string folder;                            // of binaries, made when absent; "": no disk cache
    std::vector<std::string> trial{};              // as Trials::command
    std::uint64_t trialSeconds = text::raised(5);  // of processor time, for one shader
    std::uint64_t folderBytes =
        256ull << 20;  // see pruneBinaries(); looked at with the first binary that is written
  };
  // `device` and `loader` must outlive the cache.
  ProgramCache(const DeviceInfo& device, glsl::SourceLoader& loader, Options options);

  // The variant, or null after errors. It stays valid when evicted or when its sources change.
  std::shared_ptr<const Variant> get(const ProgramRequest& request, text::Diagnostics& diagnostics);

  // A graph begins to load: its unusual shaders are tried.
  void startTrials() { trials_.died = false; }

  const ProgramCacheStats& stats() const { return stats_; }

 private:
  struct Entry {
    std::shared_ptr<const Variant> variant;  // null: it was refused, or did not compile
    text::Diagnostics said{};
  };
  Entry make(std::vector<StageSource> stages, const std::string& key, const ProgramRequest& request);
  std::optional<Program> loadBinary(const std::string& key, bool compute, std::string_view label);
  void storeBinary(const std::string& key, const Program& program);
  std::string pathOf(const std::string& key) const { return options_.folder + "/" + key + ".bin"; }

  const DeviceInfo& device_;
  glsl::SourceLoader& loader_;
  Options options_;
  ProgramCacheStats stats_;
  Trials trials_;
  std::unordered_map<std::string, Entry> known_;
};

// Above `most` bytes of program binaries in a folder, removes those that were not used for longest until an eighth of that is
// free. Several processes may write, use and remove at once. Only files with a name of 32 hex digits and ".bin" are ever
// removed. How many were.
std::size_t pruneBinaries(const std::string& folder, std::uint64_t most);

}  // namespace weft::gl
