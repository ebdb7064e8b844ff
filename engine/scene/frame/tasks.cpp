#include "engine/scene/frame/tasks.h"

#include <fmt/format.h>
#include <tbb/flow_graph.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>

namespace weft::scene {

namespace {

// Whether forRanges() may split: only inside of a run on several threads.
thread_local bool splits = false;

bool share(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  return std::ranges::any_of(a,
                             [&](const std::string& name) { return std::ranges::find(b, name) != b.end(); });
}

bool mustWait(const FrameTask& later, const FrameTask& earlier) {
  return share(later.reads, earlier.writes) || share(later.writes, earlier.writes) ||
         share(later.writes, earlier.reads);
}

}  // namespace

// Pointers to tasks of a FrameTasks would dangle when it moves: nodes know numbers, and `owner` is set by each run.
struct FrameTasks::Flow {
  int threads = 0;
  FrameTasks* owner = nullptr;
  tbb::task_arena arena;
  tbb::flow::graph graph;
  tbb::flow::broadcast_node<tbb::flow::continue_msg> start{graph};
  std::vector<std::unique_ptr<tbb::flow::continue_node<tbb::flow::continue_msg>>> nodes;

  Flow(int count, const FrameTasks& from)
      : threads(count), arena(count == 0 ? tbb::task_arena::automatic : count) {
    // The graph belongs to the arena that it is made in.
    arena.execute([&] { graph.reset(); });
    std::vector<bool> waits(from.tasks_.size());
    for (std::size_t task = 0; task < from.tasks_.size(); ++task)
      nodes.push_back(std::make_unique<tbb::flow::continue_node<tbb::flow::continue_msg>>(
          graph, [this, task](const tbb::flow::continue_msg& message) {
            const bool before = std::exchange(splits, true);
            owner->runTask(task);
            splits = before;
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

FrameTasks::FrameTasks(std::vector<FrameTask> tasks) : tasks_(std::move(tasks)), seconds_(tasks_.size()) {
  const std::size_t count = tasks_.size();
  // reaches[later][earlier]: by edges, over any number of them.
  std::vector<std::vector<bool>> reaches(count, std::vector<bool>(count));
  for (std::size_t later = 0; later < count; ++later)
    for (std::size_t earlier = later; earlier-- > 0;) {
      if (reaches[later][earlier] || !mustWait(tasks_[later], tasks_[earlier])) continue;
      edges_.emplace_back(earlier, later);
      reaches[later][earlier] = true;
      for (std::size_t before = 0; before < earlier; ++before)
        if (reaches[earlier][before]) reaches[later][before] = true;
    }
  std::ranges::sort(edges_);
}

FrameTasks::~FrameTasks() = default;
FrameTasks::FrameTasks(FrameTasks&&) noexcept = default;
FrameTasks& FrameTasks::operator=(FrameTasks&&) noexcept = default;

void FrameTasks::runTask(std::size_t task) {
  const auto before = std::chrono::steady_clock::now();
  tasks_[task].run();
  seconds_[task] = std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
}

void FrameTasks::run(int threads) {
  if (threads == 1) {
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

std::string FrameTasks::dot(const std::string& name) const {
  std::string out =
      fmt::format("digraph \"{}\" {{\n  rankdir=LR;\n  node [shape=box, fontname=\"sans-serif\"];\n", name);
  for (std::size_t task = 0; task < tasks_.size(); ++task)
    out += fmt::format("  t{} [label=\"{}\"];\n", task, tasks_[task].name);
  for (const auto& [earlier, later] : edges_) {
    std::vector<std::string> tables;
    const FrameTask &a = tasks_[earlier], &b = tasks_[later];
    for (const std::vector<std::string>* list : {&b.reads, &b.writes})
      for (const std::string& table : *list)
        if (std::ranges::find(a.writes, table) != a.writes.end() &&
            std::ranges::find(tables, table) == tables.end())
          tables.push_back(table);
    for (const std::string& table : b.writes)
      if (std::ranges::find(a.reads, table) != a.reads.end() &&
          std::ranges::find(tables, table) == tables.end())
        tables.push_back(table);
    out += fmt::format("  t{} -> t{} [label=\"{}\"];\n", earlier, later, fmt::join(tables, "\\n"));
  }
  return out + "}\n";
}

void forRanges(std::size_t count, std::size_t least,
               const std::function<void(std::size_t from, std::size_t to)>& run) {
  if (!splits || count <= least) {
    if (count > 0) run(0, count);
    return;
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, least),
                    [&](const tbb::blocked_range<std::size_t>& range) { run(range.begin(), range.end()); });
}

}  // namespace weft::scene
