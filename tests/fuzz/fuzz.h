// What the fuzz targets share. Each has a file with fuzz(), the body of LLVMFuzzerTestOneInput (entry.cpp). A target ends the process
// where a promise is broken; crashes, endless work and memory are seen by the sanitizers and the fuzzer.
#pragma once

#include <string>
#include <string_view>

#include "engine/text/diagnostic.h"
#include "engine/text/files/file.h"

namespace weft::fuzz {

// One input: any bytes.
void fuzz(std::string_view input);

// Ends the process unless `holds`.
void expect(bool holds, const char* promise, const text::Diagnostics& said = {});
// Each reader's promise: a result or an error, whose messages can all be printed.
void expectAnswer(bool made, const text::Diagnostics& said);

// A file below tests/ that only memory has, for the time of one input.
class GivenFile {
 public:
  GivenFile(std::string_view name, std::string_view bytes) : path_(pathOf(name)) {
    text::overlayFile(path_, std::string(bytes));
  }
  ~GivenFile() { text::dropOverlay(path_); }
  GivenFile(const GivenFile&) = delete;
  GivenFile& operator=(const GivenFile&) = delete;
  const std::string& path() const { return path_; }
  static std::string pathOf(std::string_view name) { return WEFT_SOURCE_DIR "/tests/" + std::string(name); }

 private:
  const std::string path_;
};

}  // namespace weft::fuzz
