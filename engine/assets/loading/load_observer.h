// Progress and cancellation of a load.
#pragma once

#include <cstdint>
#include <functional>

namespace weft::assets {

enum class LoadStage : std::uint8_t { idle, waiting, reading, decoding, converting };

// Told how far a load is: the stage, and how much of it is done (0 to 1; a stage that cannot tell says 0 and
// then the next stage begins). False gives up. Called on the thread that loads, often.
using LoadObserver = std::function<bool(LoadStage stage, double done)>;

}  // namespace weft::assets
