#include "engine/assets/loading/loader.h"

#include <utility>

namespace weft::assets {

void Loader::request(std::string path) {
  cancel();
  const std::lock_guard lock(mutex_);
  wanted_ = std::move(path);
  if (!thread_.joinable()) thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  wake_.notify_one();
}

void Loader::cancel() {
  const std::lock_guard lock(mutex_);
  std::exchange(newest_, {}).request_stop();
  wanted_.reset();
  result_.reset();
}

std::optional<Loader::Result> Loader::poll() {
  const std::lock_guard lock(mutex_);
  return std::exchange(result_, std::nullopt);
}

void Loader::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, stop, [&] { return wanted_.has_value(); }) && !stop.stop_requested()) {
    Result result{.path = *std::exchange(wanted_, std::nullopt), .product = nullptr, .diagnostics = {}};
    const std::stop_token mine = newest_.get_token();
    lock.unlock();
    result.product = job_(result.path, result.diagnostics, mine);
    lock.lock();
    if (!mine.stop_requested()) result_ = std::move(result);
  }
}

}  // namespace weft::assets
