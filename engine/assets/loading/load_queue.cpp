#include "engine/assets/loading/load_queue.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace weft::assets {

namespace {

// Where a stage begins and ends in the whole, measured on a 1k .hdr: a rough guide, and monotone.
std::pair<double, double> spanOf(LoadStage stage) {
  switch (stage) {
    case LoadStage::reading:
      return {0.0, 0.3};
    case LoadStage::decoding:
      return {0.3, 0.9};
    case LoadStage::converting:
      return {0.9, 1.0};
    default:
      return {0.0, 0.0};
  }
}

}  // namespace

const char* nameOf(LoadStage stage) {
  switch (stage) {
    case LoadStage::reading:
      return "reading";
    case LoadStage::decoding:
      return "decoding";
    case LoadStage::converting:
      return "converting";
    default:
      return "waiting";
  }
}

LoadQueue::LoadQueue(LoadJob job, StageHook hook) : job_(std::move(job)), hook_(std::move(hook)) {}

LoadQueue::~LoadQueue() {
  thread_.request_stop();
}

std::uint64_t LoadQueue::request(std::string path, std::uint32_t channel) {
  const std::lock_guard lock(mutex_);
  if (channel != 0)
    std::erase_if(requests_, [&](const Request& each) {
      if (each.channel != channel) return false;
      if (each.result) --ready_;
      *each.canceled = true;
      return true;
    });
  if (requests_.size() >= kMaxRequests) return 0;
  const std::uint64_t ticket = ++lastTicket_;
  requests_.push_back(
      {ticket, channel, std::move(path), std::make_shared<std::atomic<bool>>(false), std::nullopt});
  newest_ = ticket;
  if (!thread_.joinable()) thread_ = std::jthread([this](std::stop_token stop) { run(std::move(stop)); });
  wake_.notify_one();
  finished_.notify_all();  // whoever waits for a request that was replaced
  return ticket;
}

void LoadQueue::cancel(std::uint64_t ticket) {
  const std::lock_guard lock(mutex_);
  std::erase_if(requests_, [&](const Request& each) {
    if (each.ticket != ticket) return false;
    if (each.result) --ready_;
    *each.canceled = true;
    return true;
  });
  finished_.notify_all();
}

std::optional<LoadQueue::Result> LoadQueue::poll() {
  if (ready_ == 0) return {};
  const std::lock_guard lock(mutex_);
  const auto found =
      std::ranges::find_if(requests_, [](const Request& each) { return each.result.has_value(); });
  if (found == requests_.end()) return {};
  std::optional<Result> result = std::move(found->result);
  requests_.erase(found);
  --ready_;
  return result;
}

std::optional<LoadQueue::Result> LoadQueue::wait(std::uint64_t ticket) {
  std::unique_lock lock(mutex_);
  for (;;) {
    const auto found = std::ranges::find(requests_, ticket, &Request::ticket);
    if (found == requests_.end()) return {};
    if (found->result) {
      std::optional<Result> result = std::move(found->result);
      requests_.erase(found);
      --ready_;
      return result;
    }
    finished_.wait(lock);
  }
}

LoadProgress LoadQueue::progress(std::uint64_t ticket) const {
  const std::uint64_t shown = shown_;
  if (shown >> 24 == ticket)
    return {static_cast<LoadStage>(shown >> 16 & 0xff), static_cast<float>(shown & 0xffff) / 65535.0f};
  return {shown >> 24 < ticket && ticket <= newest_ ? LoadStage::waiting : LoadStage::idle, 0};
}

void LoadQueue::show(std::uint64_t ticket, LoadStage stage, double done) {
  const auto [from, to] = spanOf(stage);
  auto steps = static_cast<std::uint64_t>(std::lround((from + (to - from) * done) * 65535));
  // A scene of several models reads again after it decoded.
  if (stage != LoadStage::idle && shown_ >> 24 == ticket) steps = std::max(steps, shown_ & 0xffff);
  shown_ = ticket << 24 | static_cast<std::uint64_t>(stage) << 16 | steps;
}

void LoadQueue::run(std::stop_token stop) {
  std::unique_lock lock(mutex_);
  for (;;) {
    auto next = requests_.end();
    const bool more = wake_.wait(lock, stop, [&] {
      next = std::ranges::find_if(requests_, [](const Request& each) { return !each.result; });
      return next != requests_.end();
    });
    if (!more || stop.stop_requested()) return;
    Result result{next->ticket, next->path, nullptr, {}};
    const std::shared_ptr<std::atomic<bool>> canceled = next->canceled;
    lock.unlock();

    LoadStage last = LoadStage::idle;
    result.product = job_(result.path, result.diagnostics, [&](LoadStage stage, double done) {
      show(result.ticket, stage, done);
      if (std::exchange(last, stage) != stage && hook_) hook_(result.ticket, stage);
      return !*canceled && !stop.stop_requested();
    });
    show(result.ticket, LoadStage::idle, 0);

    lock.lock();
    const auto mine = std::ranges::find(requests_, result.ticket, &Request::ticket);
    if (stop.stop_requested() || mine == requests_.end()) continue;
    mine->result = std::move(result);
    ++ready_;
    finished_.notify_all();
  }
}

}  // namespace weft::assets
