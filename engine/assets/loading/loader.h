// A thread that loads one thing at a time, off the thread that draws. A request replaces the one before, so that only the last choice
// of a person costs anything. What is made is the job's business, given to the constructor: environments, scenes with their models.
// Failure is a value: a result without a product, with Diagnostics. Destroying the loader stops at the next look of the job at its
// observer.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "engine/assets/images/image.h"
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

class Loader {
 public:
  struct Result {
    std::string path;  // as it was asked for
    std::shared_ptr<const void> product;
    template <class T>
    std::shared_ptr<const T> as() const {
      return std::static_pointer_cast<const T>(product);
    }
    text::Diagnostics diagnostics;
  };

  explicit Loader(LoadJob job) : job_(std::move(job)) {}
  ~Loader() { thread_.request_stop(); }
  Loader(const Loader&) = delete;
  Loader& operator=(const Loader&) = delete;

  void request(std::string path);
  // What was asked for has no result.
  void cancel();
  // The result of the last request, once. Never waits for a load.
  std::optional<Result> poll();
  // Of the last request; `waiting` when it has not begun, `idle` when it is finished.
  LoadProgress progress() const;

 private:
  void run(const std::stop_token& stop);
  bool show(std::uint64_t request, LoadStage stage, double done);

  LoadJob job_;
  mutable std::mutex mutex_;  // over all that follows
  std::condition_variable_any wake_;
  std::optional<std::string> wanted_;  // that is not begun
  std::uint64_t newest_ = 0;           // number of the last request; a job whose number is another gives up
  std::optional<Result> result_;
  LoadProgress progress_;
  std::jthread thread_;  // from the first request on; joined before the rest goes
};

}  // namespace weft::assets
