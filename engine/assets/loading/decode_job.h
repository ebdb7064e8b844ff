// Images that wait to be decoded, each on its own, for whoever has threads for that (engine/scene/models/decode_work.h). The
// results are the same in whatever order, and on however many threads. Does not: know what the images are for.
#pragma once

#include <cstddef>
#include <functional>

namespace weft::assets {

class DecodeJob {
 public:
  virtual ~DecodeJob() = default;
  virtual std::size_t count() const = 0;
  // Bytes to texels; then, by which equal images are known, texels to contents. Each once per image, on any thread.
  virtual void decode(std::size_t image) = 0;
  virtual void identify(std::size_t image) = 0;
};

// Does both for all images of the job, and returns when it is done.
using DecodeRunner = std::function<void(DecodeJob& job)>;

// One after another on this thread.
inline void decodeInTurn(DecodeJob& job) {
  for (std::size_t i = 0; i < job.count(); ++i) {
    job.decode(i);
    job.identify(i);
  }
}

}  // namespace weft::assets
