#include "engine/scene/probes/probe_work.h"

namespace weft::scene {

ProbeWork::ProbeWork() : now_(std::make_unique<Now>()), tasks_(makeTasks(now_.get())) {}

std::vector<FrameTask> ProbeWork::makeTasks(Now* now) {
  return {
      {"probe grid",
       {"sphere rows"},
       {"probe grid"},
       [now] { now->result->grid = placeProbes(now->job->spheres, now->job->count); }},
      {"probes",
       {"sphere rows", "probe grid"},
       {"probes"},
       [now] {
         now->result->probes.resize(now->result->grid.size());
         now->done = computeProbes(now->result->grid, now->job->rules, now->job->spheres, now->result->probes,
                                   now->cancelled);
       }},
  };
}

bool ProbeWork::run(const Job& job, Result& result, const std::atomic<bool>* cancelled) {
  *now_ = {&job, &result, cancelled, false};
  tasks_.run(job.threads);
  return now_->done;
}

}  // namespace weft::scene
