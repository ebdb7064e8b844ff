// A thread that computes probes beside the frames, one job at a time. Starts with the first job and ends with its owner,
// which leaves a job under way unfinished. Does not: touch GL, or decide what is computed and when.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "engine/scene/probes/probe_work.h"

namespace weft::imports {

class ProbeWorker {
 public:
  using Job = scene::ProbeWork::Job;
  using Result = scene::ProbeWork::Result;
  ProbeWorker() = default;
  ProbeWorker(const ProbeWorker&) = delete;
  ProbeWorker& operator=(const ProbeWorker&) = delete;
  ~ProbeWorker();

  // From start() until take() says true.
  bool isBusy() const { return busy_; }
  // When it is not busy. `job` is swapped with that of the last time, for its memory.
  void start(Job& job);
  // Until the job is finished.
  void wait();
  // True once per job, when it is finished: then `result` is swapped with what it gave.
  bool take(Result& result);

 private:
  void work();

  std::thread thread_;
  std::mutex mutex_;
  std::condition_variable told_;
  std::atomic<bool> stop_ = false;
  enum class State { idle, given, finished } state_ = State::idle;  // with the mutex
  scene::ProbeWork work_;                                           // the worker's
  Job job_;                                                         // the worker's while given
  Result result_;                                                   // as job_
  bool busy_ = false;                                               // of the thread that owns
};

}  // namespace weft::imports
