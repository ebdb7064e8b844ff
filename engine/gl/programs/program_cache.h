// Variants by (source text, defines, outputs, stages, driver, backend). Memory has those that somebody holds, and some that
// nobody does; the disk has all of them, as program binaries. A broken, foreign or rejected binary is a miss and is
// written anew. A variant that does not compile gives its diagnostics and null, and the caller keeps the program it
// has; the failure is remembered until the sources change, so that asking again compiles nothing. A shader that is
// too large for the driver is refused; an unusual one is first tried in a process of its own (glsl::isUnusual(),
// shader_trial.h).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "engine/gl/context/context.h"
#include "engine/gl/programs/program.h"
#include "engine/gl/programs/shader_trial.h"
#include "engine/glsl/source.h"
#include "engine/text/diagnostic.h"
#include "engine/text/limits.h"

namespace weft::gl {

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
  std::uint64_t refusals =
      0;  // not compiled: too large (W203), or the driver did not survive the trial (W204)
  std::uint64_t trials = 0;
  std::uint64_t binaryLoads = 0, binaryRejects = 0, binaryWrites = 0;
};

class ProgramCache {
 public:
  struct Options {
    std::size_t capacity = 128;        // above it, variants that nobody holds are forgotten
    std::string folder;                // of binaries, made when absent; "": no disk cache
    std::vector<std::string> trial{};  // as Trials::command
    double trialSeconds = static_cast<double>(text::raised(5));  // for all trials of a graph
    std::uint64_t folderBytes =
        256ull << 20;  // see pruneBinaries(); looked at with the first binary that is written
  };
  // `device` and `loader` must outlive the cache.
  ProgramCache(const DeviceInfo& device, glsl::SourceLoader& loader, Options options);

  // The variant, or null after errors. It stays valid when evicted or when its sources change.
  std::shared_ptr<const Variant> get(const ProgramRequest& request, text::Diagnostics& diagnostics);

  // A graph begins to load: trials have all of their time again.
  void startTrials() { trials_.spent = 0; }

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
