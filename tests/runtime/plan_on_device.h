// A plan that is prepared to run, without an Execution around it: for tests of one part of it at a time. The graph may
// import nothing. Does not: run anything, or lay out uniforms.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/runtime/frame/device.h"
#include "engine/runtime/frame/execution.h"

namespace weft::runtime::test {

// The plan of a graph file, relative to the source folder or absolute. Fails the test when anything is reported.
std::shared_ptr<const graph::Plan> compiledPlan(const std::string& graphFile);

struct PlanOnDevice {
  explicit PlanOnDevice(const std::string& graphFile);

  std::size_t step(std::string_view pass) const;
  PreparedPass& operator[](std::string_view pass) { return passes[step(pass)]; }
  // The first channel of the first texel of a resource's newest copy.
  float texel(std::string_view resource);

  Device device;
  PreparedPlan prepared;
  const std::shared_ptr<const graph::Plan>& plan = prepared.plan;
  const std::unique_ptr<ResourcePool>& pool = prepared.pool;
  std::vector<PreparedPass>& passes = prepared.passes;  // per step, under the conditions that time settles on
};

// Every resource was published `seconds` ago.
std::function<double(std::uint32_t)> agedBy(double seconds);

}  // namespace weft::runtime::test
