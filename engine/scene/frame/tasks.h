// The CPU's work for a frame as a graph: tasks that say which tables they read and write, and from that, in the order in which
// they are declared, which must wait for which. Run on one thread in that order, or on several by a oneTBB flow graph: what a
// task reads is then written, and nobody writes it meanwhile, so that the bytes are the same. Does not: know what tasks do.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace weft::scene {

struct FrameTask {
  std::string name;
  std::vector<std::string> reads, writes;  // tables, by name
  std::function<void()> run;
};

// (earlier, later): the later one reads or writes what the earlier one writes, or writes what it reads. Without those that
// follow from others; ascending.
using TaskEdges = std::vector<std::pair<std::size_t, std::size_t>>;

class FrameTasks {
 public:
  explicit FrameTasks(std::vector<FrameTask> tasks);
  ~FrameTasks();
  FrameTasks(FrameTasks&&) noexcept;
  FrameTasks& operator=(FrameTasks&&) noexcept;

  // `threads` at most, this one among them; 0: as many as the machine has. Returns when all tasks are done.
  void run(int threads);

  const std::vector<FrameTask>& tasks() const { return tasks_; }
  const TaskEdges& edges() const { return edges_; }

 private:
  struct Flow;
  void runTask(std::size_t task);

  std::vector<FrameTask> tasks_;
  TaskEdges edges_;
  std::unique_ptr<Flow> flow_;  // from the first run on several threads on
};

// What forRanges() calls for each range: a function by reference.
class RangeFunction {
 public:
  virtual void operator()(std::size_t from, std::size_t to) const = 0;

 protected:
  ~RangeFunction() = default;
};

template <class Run>
class RangeFunctionOf final : public RangeFunction {
 public:
  explicit RangeFunctionOf(const Run& run) : run_(run) {}  // `run` must outlive this
  void operator()(std::size_t from, std::size_t to) const override { run_(from, to); }

 private:
  const Run& run_;
};

void splitRanges(std::size_t count, std::size_t least, const RangeFunction& run);

// Calls `run(from, to)` for ranges that make up 0 to `count`, on the threads of the run() that the caller is a task of;
// elsewhere, and inside of another call, all at once. Ranges are of at least `least`, and where they end says nothing of the
// result if elements do not depend on each other.
template <class Run>
void forRanges(std::size_t count, std::size_t least, const Run& run) {
  splitRanges(count, least, RangeFunctionOf<Run>(run));
}

}  // namespace weft::scene
