#include "engine/scene/frame/tasks.h"

#include <tbb/flow_graph.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <map>
#include <mutex>

namespace weft::scene {

namespace {

// The task that this thread is at: null outside of a run, and while other threads do a range of it.
struct Running {
  bool splits = false;  // on several threads
};
thread_local Running* running = nullptr;

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

bool share(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  return std::ranges::any_of(a, [&](const std::string& name) { return contains(b, name); });
}

bool mustWait(const FrameTask& later, const FrameTask& earlier) {
  return share(later.reads, earlier.writes) || share(later.writes, earlier.writes) ||
         share(later.writes, earlier.reads);
}

TaskEdges edgesOf(const std::vector<FrameTask>& tasks) {
  const std::size_t count = tasks.size();
  TaskEdges edges;
  // reaches[later][earlier]: by edges, over any number of them.
  std::vector<std::vector<bool>> reaches(count, std::vector<bool>(count));
  for (std::size_t later = 0; later < count; ++later)
    for (std::size_t earlier = later; earlier-- > 0;) {
      if (reaches[later][earlier] || !mustWait(tasks[later], tasks[earlier])) continue;
      edges.emplace_back(earlier, later);
      reaches[later][earlier] = true;
      for (std::size_t before = 0; before < earlier; ++before)
        if (reaches[earlier][before]) reaches[later][before] = true;
    }
  std::ranges::sort(edges);
  return edges;
}

// One for all graphs of so many threads: a thread that is done with one graph of a frame is awake for the next.
tbb::task_arena& arenaOf(int threads) {
  static std::mutex mutex;
  static std::map<int, std::unique_ptr<tbb::task_arena>> arenas;
  const std::lock_guard lock(mutex);
  std::unique_ptr<tbb::task_arena>& arena = arenas[threads];
  const int most = threads == 0 ? int{tbb::task_arena::automatic} : threads;
  if (!arena) arena = std::make_unique<tbb::task_arena>(most);
  return *arena;
}

}  // namespace

// Pointers to tasks of a FrameTasks would dangle when it moves: nodes know numbers, and `owner` is set by each run.
struct FrameTasks::Flow {
  int threads = 0;
  FrameTasks* owner = nullptr;
  tbb::task_arena& arena;
  tbb::flow::graph graph;
  tbb::flow::broadcast_node<tbb::flow::continue_msg> start{graph};
  std::vector<std::unique_ptr<tbb::flow::continue_node<tbb::flow::continue_msg>>> nodes;

  Flow(int count, const FrameTasks& from) : threads(count), arena(arenaOf(count)) {
    // The graph belongs to the arena that it is made in.
    arena.execute([&] { graph.reset(); });
    std::vector<bool> waits(from.tasks_.size());
    for (std::size_t task = 0; task < from.tasks_.size(); ++task)
      nodes.push_back(std::make_unique<tbb::flow::continue_node<tbb::flow::continue_msg>>(
          graph, [this, task](const tbb::flow::continue_msg& message) {
            owner->runTask(task);
            return message;
          }));
    for (const auto& [earlier, later] : from.edges_) {
      tbb::flow::make_edge(*nodes[earlier], *nodes[later]);
      waits[later] = true;
    }
    for (std::size_t task = 0; task < nodes.size(); ++task)
      if (!waits[task]) tbb::flow::make_edge(start, *nodes[task]);
  }
};

FrameTasks::FrameTasks(std::vector<FrameTask> tasks) : tasks_(std::move(tasks)), edges_(edgesOf(tasks_)) {}

FrameTasks::~FrameTasks() = default;
FrameTasks::FrameTasks(FrameTasks&&) noexcept = default;
FrameTasks& FrameTasks::operator=(FrameTasks&&) noexcept = default;

void FrameTasks::runTask(std::size_t task) {
  Running mine{.splits = flow_ && flow_->owner == this};
  Running* const before = std::exchange(running, &mine);
  tasks_[task].run();
  running = before;
}

void FrameTasks::run(int threads) {
  if (threads == 1) {
    if (flow_) flow_->owner = nullptr;
    for (std::size_t task = 0; task < tasks_.size(); ++task) runTask(task);
    return;
  }
  if (!flow_ || flow_->threads != threads) flow_ = std::make_unique<Flow>(threads, *this);
  flow_->owner = this;
  flow_->arena.execute([this] {
    flow_->start.try_put({});
    flow_->graph.wait_for_all();
  });
}

void splitRanges(std::size_t count, std::size_t least, const RangeFunction& run) {
  if (count == 0) return;
  Running* const mine = running;
  if (!mine || !mine->splits || count <= least) return run(0, count);
  const auto part = [&](const tbb::blocked_range<std::size_t>& range) {
    Running* const before = std::exchange(running, nullptr);
    run(range.begin(), range.end());
    running = before;
  };
  // Without the isolation this thread might take up another task while it waits for the last range.
  tbb::this_task_arena::isolate(
      [&] { tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, least), part); });
}

}  // namespace weft::scene
