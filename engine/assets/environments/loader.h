// The loader of environments (.hdr, .exr): reads, decodes and converts them on a thread of its own, in the order and with the
// rules of a LoadQueue (engine/assets/loading/load_queue.h). Does not: know GL, watch files, or cache what it loaded.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "engine/assets/environments/environment_map.h"
#include "engine/assets/loading/load_queue.h"
#include "engine/base/diagnostic.h"

namespace weft::assets {

struct LoadResult {
  std::uint64_t ticket = 0;
  std::string path;                           // as it was asked for
  std::shared_ptr<const EnvironmentMap> map;  // null after errors
  base::Diagnostics diagnostics;
};

// Each function as of LoadQueue.
class Loader {
 public:
  static constexpr std::size_t kMostRequests = LoadQueue::kMostRequests;
  using StageHook = LoadQueue::StageHook;

  explicit Loader(StageHook hook = {});

  std::uint64_t request(std::string path, std::uint32_t channel = 0) {
    return queue_.request(std::move(path), channel);
  }
  void cancel(std::uint64_t ticket) { queue_.cancel(ticket); }
  std::optional<LoadResult> poll();
  std::optional<LoadResult> wait(std::uint64_t ticket);
  LoadProgress progress(std::uint64_t ticket) const { return queue_.progress(ticket); }

 private:
  LoadQueue queue_;
};

}  // namespace weft::assets
