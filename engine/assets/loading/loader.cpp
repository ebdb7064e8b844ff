#include "engine/assets/loading/loader.h"

#include <algorithm>
#include <utility>

namespace weft::assets {

namespace {

// By LoadStage. Where a stage begins and ends in the whole was measured on a 1k .hdr: a rough guide, and monotone.
constexpr struct {
  const char* name;
  double from, to;
} kStages[] = {{"waiting", 0, 0},
               {"waiting", 0, 0},
               {"reading", 0, 0.3},
               {"decoding", 0.3, 0.9},
               {"converting", 0.9, 1}};

}  // namespace

const char* nameOf(LoadStage stage) {
  return kStages[static_cast<std::size_t>(stage)].name;
}

void Loader::request(std::string path) {
  cancel();
  const std::lock_guard lock(mutex_);
  wanted_ = std::move(path);
  progress_ = {LoadStage::waiting, 0};
  if (!thread_.joinable()) thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  wake_.notify_one();
}

void Loader::cancel() {
  const std::lock_guard lock(mutex_);
  ++newest_;
  wanted_.reset();
  result_.reset();
  progress_ = {};
}

std::optional<Loader::Result> Loader::poll() {
  const std::lock_guard lock(mutex_);
  return std::exchange(result_, std::nullopt);
}

LoadProgress Loader::progress() const {
  const std::lock_guard lock(mutex_);
  return progress_;
}

bool Loader::show(std::uint64_t request, LoadStage stage, double done) {
  const std::lock_guard lock(mutex_);
  if (newest_ != request) return false;
  const auto& [name, from, to] = kStages[static_cast<std::size_t>(stage)];
  // A scene of several models reads again after it decoded.
  progress_ = {stage, std::max(progress_.done, static_cast<float>(from + (to - from) * done))};
  return true;
}

void Loader::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, stop, [&] { return wanted_.has_value(); }) && !stop.stop_requested()) {
    Result result{.path = *std::exchange(wanted_, std::nullopt), .product = nullptr, .diagnostics = {}};
    const std::uint64_t mine = newest_;
    lock.unlock();
    result.product = job_(result.path, result.diagnostics, [&](LoadStage stage, double done) {
      return show(mine, stage, done) && !stop.stop_requested();
    });
    lock.lock();
    if (newest_ != mine) continue;
    result_ = std::move(result);
    progress_ = {};
  }
}

}  // namespace weft::assets
