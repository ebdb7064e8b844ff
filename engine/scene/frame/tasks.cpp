#include "engine/scene/frame/tasks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/flow_graph.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <ctime>
#include <map>
#include <mutex>

namespace weft::scene {

namespace {

double processorTime() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

// The task that this thread is at: null outside of a run, and while other threads do a range of it.
struct Running {
  bool splits = false;               // on several threads
  bool measures = false;             // time of processors
  std::atomic<double> elsewhere{0};  // seconds that other threads worked for it
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

TaskEdges edgesOf(std::span<const FrameTask* const> tasks) {
  const std::size_t count = tasks.size();
  TaskEdges edges;
  // reaches[later][earlier]: by edges, over any number of them.
  std::vector<std::vector<bool>> reaches(count, std::vector<bool>(count));
  for (std::size_t later = 0; later < count; ++later)
    for (std::size_t earlier = later; earlier-- > 0;) {
      if (reaches[later][earlier] || !mustWait(*tasks[later], *tasks[earlier])) continue;
      edges.emplace_back(earlier, later);
      reaches[later][earlier] = true;
      for (std::size_t before = 0; before < earlier; ++before)
        if (reaches[earlier][before]) reaches[later][before] = true;
    }
  std::ranges::sort(edges);
  return edges;
}

// What `later` waits for.
std::vector<std::string> tablesBetween(const FrameTask& earlier, const FrameTask& later) {
  std::vector<std::string> tables;
  const auto add = [&](const std::string& table) {
    if (!contains(tables, table)) tables.push_back(table);
  };
  for (const std::vector<std::string>* list : {&later.reads, &later.writes})
    for (const std::string& table : *list)
      if (contains(earlier.writes, table)) add(table);
  for (const std::string& table : later.writes)
    if (contains(earlier.reads, table)) add(table);
  return tables;
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

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out;
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

FrameTasks::FrameTasks(std::vector<FrameTask> tasks)
    : tasks_(std::move(tasks)), seconds_(tasks_.size()), processorSeconds_(tasks_.size()) {
  std::vector<const FrameTask*> all;
  for (const FrameTask& task : tasks_) all.push_back(&task);
  edges_ = edgesOf(all);
}

FrameTasks::~FrameTasks() = default;
FrameTasks::FrameTasks(FrameTasks&&) noexcept = default;
FrameTasks& FrameTasks::operator=(FrameTasks&&) noexcept = default;

void FrameTasks::runTask(std::size_t task) {
  Running mine{.splits = flow_ && flow_->owner == this, .measures = measures_};
  Running* const before = std::exchange(running, &mine);
  const double worked = measures_ ? processorTime() : 0;
  const auto began = std::chrono::steady_clock::now();
  tasks_[task].run();
  seconds_[task] = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  processorSeconds_[task] = measures_ ? processorTime() - worked + mine.elsewhere : 0;
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

std::string taskDot(const std::string& title, std::span<const std::string> lines,
                    std::span<const TaskGroup> groups) {
  std::string label = escaped(title);
  for (const std::string& line : lines) label += "\\n" + escaped(line);
  std::string out = fmt::format(
      "digraph \"{}\" {{\n  rankdir=LR;\n  label=\"{}\";\n  labelloc=t;\n  fontname=\"sans-serif\";\n"
      "  node [shape=box, fontname=\"sans-serif\"];\n  edge [fontname=\"sans-serif\", fontsize=10];\n",
      escaped(title), label);
  std::vector<const FrameTask*> all;
  for (std::size_t group = 0; group < groups.size(); ++group) {
    out += fmt::format("  subgraph cluster_{} {{\n    label=\"{}\";\n", group, escaped(groups[group].name));
    for (const FrameTask& task : groups[group].tasks) {
      out += fmt::format("    t{} [label=\"{}\\nreads {}\\nwrites {}\"];\n", all.size(), task.name,
                         fmt::join(task.reads, ", "), fmt::join(task.writes, ", "));
      all.push_back(&task);
    }
    out += "  }\n";
  }
  for (const auto& [earlier, later] : edgesOf(all))
    out += fmt::format("  t{} -> t{} [label=\"{}\"];\n", earlier, later,
                       fmt::join(tablesBetween(*all[earlier], *all[later]), "\\n"));
  return out + "}\n";
}

void splitRanges(std::size_t count, std::size_t least, const RangeFunction& run) {
  if (count == 0) return;
  Running* const mine = running;
  if (!mine || !mine->splits || count <= least) return run(0, count);
  const auto part = [&](const tbb::blocked_range<std::size_t>& range) {
    Running* const before = std::exchange(running, nullptr);
    const bool measures = mine->measures && before != mine;
    const double worked = measures ? processorTime() : 0;
    run(range.begin(), range.end());
    if (measures) mine->elsewhere += processorTime() - worked;
    running = before;
  };
  // Without the isolation this thread might take up another task while it waits for the last range, and that one's time
  // would count as this one's.
  tbb::this_task_arena::isolate(
      [&] { tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, least), part); });
}

}  // namespace weft::scene
