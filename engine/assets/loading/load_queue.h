// A thread that loads: runs requests one after another, off the thread that draws. Requests wait in a bounded queue and finish
// in the order they were made; a request of a channel replaces what that channel asked for before and has not fetched yet, so
// that only the last choice of a person costs anything. What a request makes is the job's business, given to the constructor:
// environments (engine/assets/environments/environment_map.h), scenes with their models (app/live/live_loads.h). Failure is a value: a result
// without a product, with Diagnostics. Progress is read without locks. Destroying the queue stops at the next look of the job
// at its observer.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "engine/assets/loading/load_observer.h"
#include "engine/text/diagnostic.h"

namespace weft::assets {

struct LoadProgress {
  LoadStage stage = LoadStage::idle;
  float done = 0;  // of the whole load, 0 to 1; grows within one request
};

const char* nameOf(LoadStage stage);  // "reading", for a person

// Makes what is asked for by `path`, or null. Asks `observer` often, and gives up when it says so.
using LoadJob = std::function<std::shared_ptr<const void>(
    const std::string& path, text::Diagnostics& diagnostics, const LoadObserver& observer)>;

class LoadQueue {
 public:
  static constexpr std::size_t kMaxRequests = 16;  // waiting, running, or finished and not fetched
  // For tests: called on the loader thread when a stage of a request begins.
  using StageHook = std::function<void(std::uint64_t ticket, LoadStage stage)>;

  struct Result {
    std::uint64_t ticket = 0;
    std::string path;  // as it was asked for
    std::shared_ptr<const void> product;
    template <class T>
    std::shared_ptr<const T> as() const {
      return std::static_pointer_cast<const T>(product);
    }
    text::Diagnostics diagnostics;
  };

  explicit LoadQueue(LoadJob job, StageHook hook = {});
  ~LoadQueue();
  LoadQueue(const LoadQueue&) = delete;
  LoadQueue& operator=(const LoadQueue&) = delete;

  // Returns a ticket above all earlier ones, or 0 when too many requests are under way. Channel 0 replaces
  // nothing.
  std::uint64_t request(std::string path, std::uint32_t channel = 0);
  // A canceled request has no result. An unknown or fetched ticket is ignored.
  void cancel(std::uint64_t ticket);

  // The oldest finished result, if there is one. Never waits for a load.
  std::optional<Result> poll();
  // Waits for one request. Empty when it was fetched, replaced or canceled.
  std::optional<Result> wait(std::uint64_t ticket);

  // How far the request is that runs now; `waiting` when it has not begun, `idle` for every other.
  LoadProgress progress(std::uint64_t ticket) const;

 private:
  struct Request {
    std::uint64_t ticket = 0;
    std::uint32_t channel = 0;
    std::string path;
    std::shared_ptr<std::atomic<bool>> canceled;
    std::optional<Result> result;  // once it is finished
  };
  void run(std::stop_token stop);
  void show(std::uint64_t ticket, LoadStage stage, double done);

  LoadJob job_;
  StageHook hook_;
  mutable std::mutex mutex_;
  std::condition_variable_any wake_, finished_;
  std::deque<Request> requests_;          // under mutex_, by ticket
  std::uint64_t lastTicket_ = 0;          // under mutex_
  std::atomic<std::uint64_t> newest_{0};  // the last ticket given out
  std::atomic<std::uint64_t> shown_{0};   // ticket << 24 | stage << 16 | done in 1 / 65535
  std::atomic<std::uint32_t> ready_{0};   // results not fetched
  std::jthread thread_;                   // from the first request on; joined before the rest goes
};

}  // namespace weft::assets
