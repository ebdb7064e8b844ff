// Holds the recorded calls of a frame against the plan. A frame is one walk over the steps; a headless frame that finishes
// time-sliced work ahead has more. In every walk each barrier of the plan must be issued, with exactly its bits and where it
// stands among the steps that run, and no other; a pass with feedback has one texture barrier, all others none; no
// pass calls glCopyImageSubData, for which the specification names no bit. It does not know the executor.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/graph/plan.h"
#include "tests/runtime/gl_recorder.h"

namespace weft::runtime::test {

// The bits of a barrier of a plan as GL has them, written from the specification (7.12.2) and not from the executor's table.
GLbitfield barrierBitsOf(std::uint16_t bits);

class GlReplay {
 public:
  explicit GlReplay(const graph::Plan& plan);
  // "" when all calls of the frame are as the plan wants them, else the first that is not.
  std::string judge(const std::vector<GlCall>& calls);

  // Of the frame judged last.
  std::size_t walks() const { return walks_; }
  std::size_t barriers() const { return barriers_; }
  std::size_t textureBarriers() const { return textureBarriers_; }
  const std::set<std::string>& ran() const { return ran_; }

 private:
  struct Barrier {
    std::size_t step = 0;
    bool afterClears = false;
    GLbitfield bits = 0;
  };
  void beginWalk();
  std::size_t issuedBefore(std::size_t step) const;  // barriers of a walk before the step begins
  void beginStep(std::size_t step);
  void endStep();
  void issue(GLbitfield bits);
  void fail(std::string what);

  const graph::Plan& plan_;
  std::vector<Barrier> wanted_;               // of one walk, in order
  std::map<std::string, std::size_t> steps_;  // by name
  std::set<std::string> ran_;
  std::string problem_;
  static constexpr std::size_t kNoStep = ~std::size_t{0};
  std::size_t next_ = 0;        // barrier of the walk
  std::size_t last_ = kNoStep;  // step that ran last in the walk
  std::size_t open_ = kNoStep;  // step that runs now
  std::size_t inner_ = 0;       // groups open inside it
  bool feedback_ = false;       // it had its texture barrier
  std::size_t walks_ = 0, barriers_ = 0, textureBarriers_ = 0;
};

}  // namespace weft::runtime::test
