#include "engine/imports/probes/probe_worker.h"

#include <cassert>
#include <utility>

namespace weft::imports {

ProbeWorker::~ProbeWorker() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  told_.notify_all();
  thread_.join();
}

void ProbeWorker::start(Job& job) {
  assert(!busy_);
  std::swap(job_, job);
  {
    const std::lock_guard lock(mutex_);
    state_ = State::given;
  }
  busy_ = true;
  if (thread_.joinable())
    told_.notify_all();
  else
    thread_ = std::thread([this] { work(); });
}

void ProbeWorker::wait() {
  std::unique_lock lock(mutex_);
  told_.wait(lock, [&] { return state_ != State::given; });
}

bool ProbeWorker::take(Result& result) {
  {
    const std::lock_guard lock(mutex_);
    if (state_ != State::finished) return false;
    state_ = State::idle;
  }
  std::swap(result, result_);
  busy_ = false;
  return true;
}

void ProbeWorker::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    told_.wait(lock, [&] { return state_ == State::given || stop_; });
    if (stop_) return;
    lock.unlock();
    const bool done = work_.run(job_, result_, &stop_);
    lock.lock();
    if (!done) return;
    state_ = State::finished;
    told_.notify_all();
  }
}

}  // namespace weft::imports
