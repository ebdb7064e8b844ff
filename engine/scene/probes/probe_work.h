// The light probes of spheres as tasks (engine/scene/frame/tasks.h): where they stand, then what each gets. The same on any
// number of threads, byte for byte. Does not: decide when, or which thread waits for it.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "engine/scene/frame/tasks.h"
#include "engine/scene/probes/probes.h"

namespace weft::scene {

class ProbeWork {
 public:
  struct Job {
    ProbeRules rules;
    glm::uvec3 count{1};
    std::vector<Instance> spheres;
    int threads = 1;  // as FrameTasks::run()
  };
  struct Result {
    ProbeGrid grid;
    std::vector<Probe> probes;
  };
  ProbeWork();
  // False, with anything in `result`, once `cancelled` is set.
  bool run(const Job& job, Result& result, const std::atomic<bool>* cancelled = nullptr);
  const FrameTasks& tasks() const { return tasks_; }

 private:
  // What the tasks work on in the present run(). Stands still when a ProbeWork moves.
  struct Now {
    const Job* job = nullptr;
    Result* result = nullptr;
    const std::atomic<bool>* cancelled = nullptr;
    bool done = false;
  };
  static std::vector<FrameTask> makeTasks(Now* now);

  std::unique_ptr<Now> now_;
  FrameTasks tasks_;
};

}  // namespace weft::scene
