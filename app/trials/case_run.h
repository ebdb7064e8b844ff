// Runs one case of `weft test`: renders, compares with the golden or writes it, and finds the first pass that differs.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/trials/case_file.h"
#include "app/trials/divergence.h"
#include "engine/assets/images/flip.h"

namespace weft::app {

struct CaseResult {
  // written: accepted. broken: it could not be rendered, or its golden not be read.
  enum class State { same, different, written, broken };
  // A frame and its golden.
  struct Pair {
    std::uint32_t frame = 0;
    std::string golden;  // file
    assets::Image8 picture, expected;
    assets::FlipMap map;
    bool failed = false;
  };
  State state = State::same;
  std::vector<std::string> lines;  // what was found, a sentence each
  std::vector<Pair> pairs;         // those that differ
  std::optional<Divergence> first;
};

class CaseRunner {
 public:
  explicit CaseRunner(const Options& options) : options_(options) {}

  // `accept`: writes the goldens instead of judging.
  CaseResult run(const TestCase& test, bool accept, text::Diagnostics& diagnostics);
  // Whether there is an OpenGL context, once a case has asked for one.
  bool lacksContext() const { return lacksContext_; }

 private:
  CaseResult runPictures(const TestCase& test, bool accept, text::Diagnostics& diagnostics);
  std::optional<Shot> shoot(const TestCase& test, text::Diagnostics& diagnostics);

  const Options& options_;
  std::unique_ptr<gl::Context> context_;
  bool lacksContext_ = false;
};

}  // namespace weft::app
