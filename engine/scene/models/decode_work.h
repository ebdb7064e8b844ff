// The images of a model, decoded as tasks (engine/scene/frame/tasks.h) while the model is loaded: each image alone, so that
// many threads can work. The same on any number of threads, byte for byte. Does not: read files, or decide when to load.
#pragma once

#include <memory>

#include "engine/assets/loading/decode_job.h"
#include "engine/scene/frame/tasks.h"

namespace weft::scene {

class DecodeWork {
 public:
  DecodeWork();
  // `threads` as FrameTasks::run(). Returns when all images of the job are decoded and identified.
  void run(assets::DecodeJob& job, int threads);
  const FrameTasks& tasks() const { return tasks_; }

 private:
  // What the tasks work on in the present run(). Stands still when a DecodeWork moves.
  struct Now {
    assets::DecodeJob* job = nullptr;
  };
  static std::vector<FrameTask> makeTasks(Now* now);

  std::unique_ptr<Now> now_;
  FrameTasks tasks_;
};

}  // namespace weft::scene
