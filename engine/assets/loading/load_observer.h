// Progress, cancellation and threads of a load.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace weft::assets {

enum class LoadStage : std::uint8_t { idle, waiting, reading, decoding, converting };

// Told how far a load is: the stage, and how much of it is done (0 to 1; a stage that cannot tell says 0 and
// then the next stage begins). False gives up. Called on the thread that loads, often.
using LoadObserver = std::function<bool(LoadStage stage, double done)>;

// Calls `decode` with 0 to count - 1, each once, on any threads and in any order, and returns when all are done. The images of
// a model are decoded by it; empty: one after another on the thread that loads.
using DecodeRunner =
    std::function<void(std::size_t count, const std::function<void(std::size_t image)>& decode)>;

}  // namespace weft::assets
