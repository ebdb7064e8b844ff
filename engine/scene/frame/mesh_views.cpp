#include "engine/scene/frame/mesh_views.h"

#include <algorithm>

namespace weft::scene {

namespace {

constexpr std::uint32_t kPart = 2048;          // rows that are culled together
constexpr std::size_t kLeastKeys = 4096;       // that are worth a task
constexpr std::size_t kLittleViewWork = 8192;  // rows of all views: below, threads cost more than they bring

}  // namespace

void MeshView::look(DrawList list, const glm::mat4& view, const glm::mat4& viewProjection, MeshOrder order) {
  wish_ = {list, view, viewProjection, order};
}

MeshViews::MeshViews() : job_(std::make_unique<Job>()), tasks_(makeTasks(job_.get())) {}

void MeshViews::cullPart(const Job& job, Part part) {
  MeshView& view = *job.due[part.view];
  const std::span<const Box> boxes = job.frame->bounds(view.wish_.list);
  const std::size_t from = std::size_t{part.part} * kPart, to = std::min(from + kPart, boxes.size());
  view.partCounts_[part.part] =
      static_cast<std::uint32_t>(cullRows(view.frustum_, boxes, from, to, view.visible_.data() + from));
}

// Moves together what the parts found, each at its own place.
void MeshViews::join(MeshView& view) {
  std::size_t count = 0;
  for (std::size_t part = 0; part < view.partCounts_.size(); ++part) {
    const auto from = view.visible_.begin() + static_cast<std::ptrdiff_t>(part * kPart);
    std::copy(from, from + view.partCounts_[part],
              view.visible_.begin() + static_cast<std::ptrdiff_t>(count));
    count += view.partCounts_[part];
  }
  view.visible_.resize(count);
}

void MeshViews::makeKeys(const Job& job, MeshView& view) {
  const std::span<const Box> boxes = job.frame->bounds(view.wish_.list);
  view.keys_.resize(view.visible_.size());
  forRanges(view.keys_.size(), kLeastKeys, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const std::uint32_t row = view.visible_[i];
      view.keys_[i] = {depthKey(viewDepth(view.wish_.view, boxes[row].center())), row};
    }
  });
}

void MeshViews::sort(MeshView& view) {
  sortElements(view.keys_, SortMethod::cpu_radix, view.scratch_);
  for (std::size_t i = 0; i < view.keys_.size(); ++i) view.visible_[i] = view.keys_[i].index;
}

std::vector<FrameTask> MeshViews::makeTasks(Job* job) {
  // Beside each other: of one view nothing depends on another.
  const auto forViews = [job](const auto& run) {
    forRanges(job->due.size(), 1, [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i) run(*job->due[i]);
    });
  };
  const auto sorted = [](const MeshView& view) { return view.wish_.order == MeshOrder::back_to_front; };
  return {
      {"culling",
       {"views", "boxes"},
       {"visible rows"},
       [job, forViews] {
         forRanges(job->parts.size(), 1, [&](std::size_t from, std::size_t to) {
           for (std::size_t i = from; i < to; ++i) cullPart(*job, job->parts[i]);
         });
         forViews([](MeshView& view) { join(view); });
       }},
      {"sort keys",
       {"views", "boxes", "visible rows"},
       {"keys"},
       [job, sorted] {
         for (MeshView* view : job->due)
           if (sorted(*view)) makeKeys(*job, *view);
       }},
      {"draw order",
       {"views", "keys"},
       {"visible rows"},
       [forViews, sorted] {
         forViews([&](MeshView& view) {
           if (sorted(view)) sort(view);
         });
       }},
      {"commands",
       {"meshes", "rows", "visible rows"},
       {"commands"},
       [job, forViews] {
         forViews([&](MeshView& view) {
           makeCommands(*job->scene, job->frame->rows(view.wish_.list), view.visible_, view.commands_);
         });
       }},
  };
}

void MeshViews::update(const Scene& scene, const MeshFrame& frame, std::span<MeshView* const> views) {
  job_->scene = &scene;
  job_->frame = &frame;
  job_->due.clear();
  job_->parts.clear();
  std::size_t work = 0;
  for (MeshView* view : views) {
    const std::uint64_t rows = frame.generation(view->wish_.list);
    if (view->generation_ != 0 && view->rows_ == rows && view->wish_ == view->made_) continue;
    const std::size_t count = frame.bounds(view->wish_.list).size();
    view->rows_ = rows;
    view->made_ = view->wish_;
    view->frustum_ = frustumOf(view->wish_.viewProjection);
    view->visible_.resize(count);
    view->partCounts_.assign((count + kPart - 1) / kPart, 0);
    view->generation_ = ++count_;
    for (std::uint32_t part = 0; part < view->partCounts_.size(); ++part)
      job_->parts.push_back({static_cast<std::uint32_t>(job_->due.size()), part});
    job_->due.push_back(view);
    work += count;
  }
  if (!job_->due.empty()) tasks_.run(work < kLittleViewWork ? 1 : threads_);
}

}  // namespace weft::scene
