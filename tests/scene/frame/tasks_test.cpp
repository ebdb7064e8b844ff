// Tasks by the tables that they read and write: every order that a run may take gives the same result.
#include "engine/scene/frame/tasks.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <map>
#include <random>
#include <set>

#include "engine/scene/files/scene_file.h"
#include "engine/scene/frame/mesh_frame.h"

using namespace weft;
using namespace weft::scene;

TEST_CASE("a task waits for those that write what it reads, and lets nobody change what it reads") {
  const auto nothing = [] {};
  const FrameTasks tasks({{"a", {}, {"x"}, nothing},
                          {"b", {"x"}, {"y"}, nothing},
                          {"c", {"x"}, {"z"}, nothing},
                          {"d", {}, {"x"}, nothing},
                          {"e", {"x", "y"}, {}, nothing},
                          {"f", {}, {"w"}, nothing}});
  using Edges = std::vector<std::pair<std::size_t, std::size_t>>;
  // d overwrites what b and c read; e reads what d wrote, and b's y, which d waited for.
  CHECK(tasks.edges() == Edges{{0, 1}, {0, 2}, {1, 3}, {2, 3}, {3, 4}});
}

TEST_CASE("random tasks give the same tables on 1, 2 and 4 threads, run after run") {
  std::mt19937 random(5);
  for (int round = 0; round < 30; ++round) {
    const int count = 2 + static_cast<int>(random() % 20), tables = 1 + static_cast<int>(random() % 6);
    std::map<std::string, std::uint64_t> values;
    for (int t = 0; t < tables; ++t) values["t" + std::to_string(t)] = 1;
    const auto before = values;
    std::atomic<int> ran{0};
    std::vector<FrameTask> list;
    for (int i = 0; i < count; ++i) {
      FrameTask task{.name = std::to_string(i)};
      for (int t = 0; t < tables; ++t) {
        const unsigned use = random() % 4;
        if (use == 1) task.reads.push_back("t" + std::to_string(t));
        if (use == 2) task.writes.push_back("t" + std::to_string(t));
      }
      task.run = [&values, &ran, i, reads = task.reads, writes = task.writes] {
        std::uint64_t sum = static_cast<std::uint64_t>(i) + 1;
        for (const std::string& name : reads) sum = sum * 31 + values.find(name)->second;
        for (const std::string& name : writes)
          values.find(name)->second = values.find(name)->second * 7 + sum;
        ++ran;
      };
      list.push_back(task);
    }
    FrameTasks tasks(list);
    tasks.run(1);
    const auto wanted = values;
    for (const int threads : {2, 4, 2}) {
      values = before;
      ran = 0;
      tasks.run(threads);
      CHECK(ran == count);
      CHECK(values == wanted);
    }
  }
}

TEST_CASE("ranges cover everything once, inside a task and outside") {
  std::vector<std::atomic<int>> seen(10000);
  const auto cover = [&] {
    forRanges(seen.size(), 100, [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i) ++seen[i];
    });
  };
  cover();
  FrameTasks tasks({{"a", {}, {"x"}, cover}, {"b", {}, {"y"}, cover}});
  tasks.run(2);
  for (const auto& each : seen) CHECK(each == 3);
  int calls = 0;
  forRanges(0, 1, [&](std::size_t, std::size_t) { ++calls; });
  CHECK(calls == 0);
}

TEST_CASE("a frame is the same, byte for byte, on one thread and on two") {
  base::Diagnostics diagnostics;
  const std::string top = WEFT_SOURCE_DIR "/";
  for (const char* file : {"scenes/crowd.json", "scenes/fox.json"}) {
    const auto scene = loadScene(top + file, diagnostics);
    REQUIRE_MESSAGE(scene, diagnostics.text());
    MeshFrame one, two;
    one.setThreads(1);
    two.setThreads(2);
    for (int i = 0; i < 4; ++i) {
      const double time = 0.1 * i, before = i == 2 ? 7 : 0.1 * (i - 1);
      one.update(*scene, 1, time, before);
      two.update(*scene, 1, time, before);
      const auto same = [](const auto& a, const auto& b) {
        return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
      };
      CHECK(same(one.rows(DrawList::opaque), two.rows(DrawList::opaque)));
      CHECK(same(one.bounds(DrawList::opaque), two.bounds(DrawList::opaque)));
      CHECK(same(one.joints(), two.joints()));
      CHECK(one.sceneBounds() == two.sceneBounds());
      CHECK(one.nodeUpdates() == two.nodeUpdates());
    }
    CHECK(one.isMoving(DrawList::opaque));
    CHECK_FALSE(one.isMoving(DrawList::transparent));
  }
  MeshFrame frame;
  std::set<std::string> names;
  for (const FrameTask& task : frame.tasks().tasks()) names.insert(task.name);
  CHECK(names.contains("transforms"));
  // The moment before does not wait for the present one.
  for (const auto& [earlier, later] : frame.tasks().edges())
    CHECK_FALSE((frame.tasks().tasks()[earlier].name == "transforms" &&
                 frame.tasks().tasks()[later].name == "transforms before"));
  MeshFrame moved = std::move(frame);
  const auto fox = loadScene(top + "scenes/fox.json", diagnostics);
  moved.update(*fox, 1, 1, 0.5);
  CHECK(moved.rows(DrawList::opaque).size() == 1);
}
