#include "engine/scene/models/decode_work.h"

namespace weft::scene {

DecodeWork::DecodeWork() : now_(std::make_unique<Now>()), tasks_(makeTasks(now_.get())) {}

std::vector<FrameTask> DecodeWork::makeTasks(Now* now) {
  return {
      {"decoding",
       {"image files"},
       {"texels"},
       [now] {
         forRanges(now->job->count(), 1, [now](std::size_t from, std::size_t to) {
           for (std::size_t i = from; i < to; ++i) now->job->decode(i);
         });
       }},
      {"contents",
       {"texels"},
       {"contents"},
       [now] {
         forRanges(now->job->count(), 1, [now](std::size_t from, std::size_t to) {
           for (std::size_t i = from; i < to; ++i) now->job->identify(i);
         });
       }},
  };
}

void DecodeWork::run(assets::DecodeJob& job, int threads) {
  now_->job = &job;
  tasks_.run(job.count() > 1 ? threads : 1);
}

}  // namespace weft::scene
