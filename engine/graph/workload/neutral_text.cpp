// The workloads of the bench as text.
#include <vector>

#include "engine/base/hash.h"
#include "engine/graph/workload/neutral.h"

namespace weft::graph {

namespace {

class NeutralWriter {
 public:
  NeutralWriter(std::size_t passes, std::uint64_t seed) : passes_(passes), seed_(seed) {}

  std::string make(NeutralShape shape) {
    for (std::size_t p = 0; p < passes_; ++p) {
      std::vector<std::size_t> reads = shape == NeutralShape::layered ? layered(p)
                                       : shape == NeutralShape::fanin ? fanin(p)
                                                                      : chain(p);
      addPass(p, reads, shape == NeutralShape::layered && p + 1 < passes_ ? 1 + draw(2) : 1);
    }
    std::string text = "{\"textures\":[";
    for (std::size_t t = 0; t < isRead_.size(); ++t) text += (t > 0 ? "," : "") + texture(t);
    return text + "],\"passes\":[" + body_ + "]}\n";
  }

 private:
  std::size_t draw(std::size_t n) { return base::hashCombine(seed_, ++drawn_) % n; }

  std::string texture(std::size_t t) {
    constexpr const char* sizes[] = {"\"width\":1920,\"height\":1080", "\"width\":960,\"height\":540",
                                     "\"width\":480,\"height\":270", "\"width\":64,\"height\":64"};
    constexpr const char* formats[] = {"RGBA8", "RGBA16F", "RG16F", "R32F"};
    return "{\"name\":\"T" + std::to_string(t) + "\"," + sizes[draw(4)] + ",\"format\":\"" +
           formats[draw(4)] + "\"}";
  }

  std::vector<std::size_t> chain(std::size_t p) {
    if (p == 0) return {};
    return {firstOf_[p - 1]};
  }

  std::vector<std::size_t> layered(std::size_t p) {
    std::vector<std::size_t> reads;
    const auto take = [&](std::size_t t) {
      for (const std::size_t r : reads)
        if (r == t) return;
      reads.push_back(t);
      isRead_[t] = true;
    };
    while (oldestUnread_ < isRead_.size() && isRead_[oldestUnread_]) ++oldestUnread_;
    if (oldestUnread_ < isRead_.size()) take(oldestUnread_);
    const std::size_t oldest = p > 32 ? firstOf_[p - 32] : 0;
    for (int tries = 0; tries < 8 && reads.size() < 3 && oldest < isRead_.size(); ++tries)
      take(oldest + draw(isRead_.size() - oldest));
    return reads;
  }

  std::vector<std::size_t> fanin(std::size_t p) {
    constexpr std::size_t kGroup = 25;
    const std::size_t k = p % kGroup;
    std::vector<std::size_t> reads;
    if (k != 0 && (k == kGroup - 1 || p + 1 == passes_)) {
      for (std::size_t i = p - k; i < p; ++i)
        if (i % kGroup % 3 == 2 || i + 1 == p) reads.push_back(firstOf_[i]);
    } else if (k % 3 != 0) {
      reads.push_back(firstOf_[p - 1]);
    } else if (p >= kGroup) {
      reads.push_back(firstOf_[p - k - 1]);
    }
    return reads;
  }

  void addPass(std::size_t p, const std::vector<std::size_t>& reads, std::size_t writes) {
    body_ += (p > 0 ? ",{\"name\":\"P" : "{\"name\":\"P") + std::to_string(p) + "\",\"reads\":[";
    for (std::size_t i = 0; i < reads.size(); ++i)
      body_ += (i > 0 ? ",\"T" : "\"T") + std::to_string(reads[i]) + "\"";
    body_ += "],\"writes\":[";
    firstOf_.push_back(isRead_.size());
    for (std::size_t i = 0; i < writes; ++i) {
      body_ += (i > 0 ? ",\"T" : "\"T") + std::to_string(isRead_.size()) + "\"";
      isRead_.push_back(false);
    }
    body_ += p + 1 == passes_ ? "],\"side_effect\":true}" : "],\"side_effect\":false}";
  }

  const std::size_t passes_;
  const std::uint64_t seed_;
  std::uint64_t drawn_ = 0;
  std::vector<std::size_t> firstOf_;  // per pass: its first texture
  std::vector<bool> isRead_;          // per texture
  std::size_t oldestUnread_ = 0;
  std::string body_;
};

}  // namespace

std::string neutralText(NeutralShape shape, std::size_t passes, std::uint64_t seed) {
  return NeutralWriter(passes, seed).make(shape);
}

}  // namespace weft::graph
