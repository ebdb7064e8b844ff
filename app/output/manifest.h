// The manifest of a sequence: a line of JSON for each frame whose files are written, by which a later run knows what is done.
// Processes may share it.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>

#include "engine/text/diagnostic.h"

namespace weft::app {

// "f_.frames.jsonl" of "f_%04d.png".
std::string manifestNameOf(const std::string& pattern);

class Manifest {
 public:
  // `settings`: a hash of all that decides pixels. `about`: what each line says besides (host, command, versions).
  Manifest(std::string path, std::string settings, nlohmann::ordered_json about)
      : path_(std::move(path)), settings_(std::move(settings)), about_(std::move(about)) {}

  // Reads what is there, if anything. False after W180, when it is no manifest.
  bool read(text::Diagnostics& diagnostics);
  // Whether the files are there, with the bytes that were written under these settings.
  bool isDone(std::uint32_t frame, std::span<const std::string> files) const;
  // Frames that were written under other settings alone.
  bool hasOther(std::uint32_t frame) const { return !done_.contains(frame) && others_.contains(frame); }
  // Adds a line for files that were just written. False after W180.
  bool add(std::uint32_t frame, std::span<const std::string> files, double seconds,
           text::Diagnostics& diagnostics);

 private:
  std::string nameOf(const std::string& file) const;  // as seen from its folder

  std::string path_, settings_;
  nlohmann::ordered_json about_;
  std::map<std::uint32_t, nlohmann::ordered_json> done_;  // files of frames with these settings; hashes
  std::set<std::uint32_t> others_;
};

}  // namespace weft::app
