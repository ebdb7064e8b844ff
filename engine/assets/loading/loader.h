// A thread that loads one thing at a time, off the thread that draws. A request replaces the one before, so that only the last choice
// of a person costs anything. What is made is the job's business, given to the constructor: environments, scenes with their models.
// Failure is a value: a result without a product, with Diagnostics. Destroying the loader stops at the next look of the job at its
// token.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "engine/text/diagnostic.h"

namespace weft::assets {

// Makes what is asked for by `path`, or null. Looks at `stop` often, and gives up when it says so.
using LoadJob = std::function<std::shared_ptr<const void>(
    const std::string& path, text::Diagnostics& diagnostics, const std::stop_token& stop)>;

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
  ~Loader() { cancel(); }
  Loader(const Loader&) = delete;
  Loader& operator=(const Loader&) = delete;

  void request(std::string path);
  // What was asked for has no result.
  void cancel();
  // The result of the last request, once. Never waits for a load.
  std::optional<Result> poll();

 private:
  void run(const std::stop_token& stop);

  LoadJob job_;
  std::mutex mutex_;  // over all that follows
  std::condition_variable_any wake_;
  std::optional<std::string> wanted_;  // that is not begun
  std::stop_source newest_;            // of the last request
  std::optional<Result> result_;
  std::jthread thread_;  // from the first request on; joined before the rest goes
};

}  // namespace weft::assets
