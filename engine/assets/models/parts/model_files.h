// What a model reads: its own file and those beside it. One door for glTF, OBJ, FBX and Assimp, so that a model never
// reads anything outside its folder, whatever it names, and never more than kMaxModelBytes in all. The rest of what
// holds for files (pipes, --confine) is engine/text/files/file.h.
#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "engine/text/diagnostic.h"
#include "engine/text/limits.h"

namespace weft::assets {

// Of one model. Bytes: of all its files, and of what is packed in them.
constexpr std::uint64_t kMaxModelBytes = 512ull << 20, kMaxModelTextBytes = 24ull << 20,
                        kMaxVertices = 6ull << 20, kMaxTexels = 64ull << 20, kMaxModelFiles = 4096;

class ModelFiles {
 public:
  // `path` is the model's own file.
  ModelFiles(std::string path, text::Diagnostics& diagnostics, std::stop_token stop)
      : path_(std::move(path)), diagnostics_(diagnostics), stop_(std::move(stop)) {}

  const std::string& path() const { return path_; }
  text::Diagnostics& diagnostics() const { return diagnostics_; }
  // Whoever reads looks at it often, and gives up when it says so. On any thread.
  const std::stop_token& stop() const { return stop_; }
  text::Place place() const { return {path_}; }  // of the model's own file
  // Everything that was read or should have been, each once, the model's own first.
  const std::vector<std::string>& files() const { return files_; }

  // The model's own file; W164, W200 or W201 when it cannot be read.
  std::optional<std::string> readModel();
  // A file beside it. `uri` is relative to the model's folder; percent escapes are resolved first when `escaped`. W166 for
  // one that leads out of the folder, in whatever spelling; `code` for one that cannot be read.
  // `severity` is that of `code`.
  std::optional<std::string> readBeside(const std::string& uri, const text::Place& place, text::Code code,
                                        bool escaped, text::Severity severity = text::Severity::error);
  // The same for what a model can do without: one that cannot be read is a warning.
  std::optional<std::string> readOptional(const std::string& uri, const text::Place& place, text::Code code,
                                          bool escaped) {
    return readBeside(uri, place, code, escaped, text::Severity::warning);
  }
  // Whether there is such a file in the folder; nothing is said.
  bool hasBeside(const std::string& name) const;
  // A path of another machine, as files often keep them, as one in the folder: by its own name if it leads elsewhere.
  std::string namedBeside(std::string path) const;

  // Whether the text of an OBJ or FBX file may be so large; else W201.
  bool isTextInLimit(std::string_view bytes);
  // Counts bytes that are not files of their own against the limit. False after W201.
  bool count(std::uint64_t bytes, const text::Place& place);

 private:
  std::optional<std::string> readCounted(const std::string& path, const text::Place& place, text::Code code,
                                         text::Diagnostics& diagnostics);
  // "" for a way out.
  std::string resolve(const std::string& name) const;

  std::string path_;
  text::Diagnostics& diagnostics_;
  std::stop_token stop_;
  std::vector<std::string> files_{path_};
  std::uint64_t bytes_ = 0;
};

// Bytes of a "data:" URI; empty when they are not in base64, or damaged.
std::optional<std::string> decodeDataUri(std::string_view uri);

}  // namespace weft::assets
