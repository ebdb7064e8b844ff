// The CPU's work for a frame as a graph: tasks that say which tables they read and write, and from that, in the order in which
// they are declared, which must wait for which. Run on one thread in that order, or on several by a oneTBB flow graph: what a
// task reads is then written, and nobody writes it meanwhile, so that the bytes are the same. Does not: know what tasks do.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace weft::scene {

struct FrameTask {
  std::string name;
  std::vector<std::string> reads, writes;  // tables, by name
  std::function<void()> run;
};

class FrameTasks {
 public:
  explicit FrameTasks(std::vector<FrameTask> tasks);
  ~FrameTasks();
  FrameTasks(FrameTasks&&) noexcept;
  FrameTasks& operator=(FrameTasks&&) noexcept;

  // `threads` at most, this one among them; 0: as many as the machine has. Returns when all tasks are done.
  void run(int threads);

  const std::vector<FrameTask>& tasks() const { return tasks_; }
  // (earlier, later): the later one reads or writes what the earlier one writes, or writes what it reads. Without those that
  // follow from others.
  const std::vector<std::pair<std::size_t, std::size_t>>& edges() const { return edges_; }
  // How long each task took in the last run.
  std::span<const double> seconds() const { return seconds_; }
  // For Graphviz: tasks, and on each edge the tables that are waited for.
  std::string dot(const std::string& name) const;

 private:
  struct Flow;
  void runTask(std::size_t task);

  std::vector<FrameTask> tasks_;
  std::vector<std::pair<std::size_t, std::size_t>> edges_;
  std::vector<double> seconds_;
  std::unique_ptr<Flow> flow_;  // from the first run on several threads on
};

// Calls `run` for ranges that make up 0 to `count`, on the threads of the run() that the caller is a task of; elsewhere all at
// once. Ranges are of at least `least`, and where they end says nothing of the result if elements do not depend on each other.
void forRanges(std::size_t count, std::size_t least,
               const std::function<void(std::size_t from, std::size_t to)>& run);

}  // namespace weft::scene
