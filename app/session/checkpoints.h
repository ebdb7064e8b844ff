// Checkpoints: files with all that the following frames depend on, so that a run of a graph that remembers need not begin with frame
// 0. `studio_000050.checkpoint` is what frame 50 begins with. It serves runs of the same files, options, build and driver only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "app/session/session.h"

namespace weft::app {

constexpr std::string_view kCheckpointEnding = ".checkpoint";

struct CheckpointOptions {
  std::uint32_t every = 0;  // frames; 0: none is saved
  std::string where;        // a folder, or the one checkpoint to begin with
  bool chosen = true;       // by the person

  void add(CLI::App& command);
  // With a place of their own where none was named: beside an output.
  CheckpointOptions beside(const std::string& output) const;
};

class Checkpoints {
 public:
  // All must outlive this.
  Checkpoints(const CheckpointOptions& wish, DeviceSession& session, const runtime::World& world,
              const Options& options)
      : wish_(wish), session_(session), world_(world), options_(options) {}

  // Brings the execution, which has run no frame, to the frame to run first, and returns that: `first`, where no frame depends on
  // earlier ones; else that of the nearest checkpoint at or before it, or 0. One that was named and does not fit is an error
  // (W001); others are passed over with one warning for all.
  std::uint32_t begin(std::uint32_t first, text::Diagnostics& diagnostics);
  // To be called after each frame: saves a checkpoint when it is time. False after W180.
  bool save(std::uint32_t frame, text::Diagnostics& diagnostics);

 private:
  // What decides whether a checkpoint fits.
  struct Key {
    std::uint64_t settings = 0, build = 0, driver = 0;
  };
  struct Header;
  std::string problemOf(const std::string& path, std::string& bytes, Header& header) const;

  const CheckpointOptions& wish_;
  DeviceSession& session_;
  const runtime::World& world_;
  const Options& options_;
  const bool named_ = wish_.where.ends_with(kCheckpointEnding);  // `where` is a checkpoint
  const std::string folder_ =
      named_ ? std::filesystem::path(wish_.where).parent_path().string() : wish_.where;
  bool saves_ = false;
  Key key_;
};

}  // namespace weft::app
