#include "engine/assets/environments/loader.h"

#include <utility>

namespace weft::assets {

namespace {

std::optional<LoadResult> toResult(std::optional<LoadQueue::Result> from) {
  if (!from) return {};
  return LoadResult{from->ticket, std::move(from->path),
                    std::static_pointer_cast<const EnvironmentMap>(std::move(from->product)),
                    std::move(from->diagnostics)};
}

}  // namespace

Loader::Loader(StageHook hook)
    : queue_(
          [](const std::string& path, base::Diagnostics& diagnostics,
             const LoadObserver& observer) -> std::shared_ptr<const void> {
            auto map = loadEnvironmentMap(path, diagnostics, observer);
            return map ? std::make_shared<const EnvironmentMap>(std::move(*map)) : nullptr;
          },
          std::move(hook)) {}

std::optional<LoadResult> Loader::poll() {
  return toResult(queue_.poll());
}

std::optional<LoadResult> Loader::wait(std::uint64_t ticket) {
  return toResult(queue_.wait(ticket));
}

}  // namespace weft::assets
