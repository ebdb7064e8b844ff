// An independent judge of a plan's barriers. It replays frames access by access on physical memory and
// applies the ordering rules of the OpenGL 4.5 core specification, section 7.12.2; its table is written from
// that text and shares nothing with the compiler but the plan's data. Textures are judged per copy and
// sub-resource, buffers per 256 bytes. Does not: judge contents (replay.h) or storage (plan_checks.h).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/graph/plan.h"

namespace weft::graph::oracle {

// One flag per frame and pass: does it run? Indexed [frame][pass]; behind the passes one flag per group: what
// it wrote over the frames before is published at the start of this one.
using Schedule = std::vector<std::vector<bool>>;

// The first hazard of the replay in words, or "".
std::string findHazard(const Plan& plan, const Schedule& schedule);

// Every pass in every frame; enough frames for each copy of each history to come round twice.
Schedule everythingRuns(const Plan& plan);

// Three frames in which the passes that are not `always` run in every possible pattern, when there are few of
// them; else `samples` random patterns.
std::vector<Schedule> cadenceSchedules(const Plan& plan, std::uint64_t seed, std::size_t samples);

struct Verdict {
  std::string problem;   // "" when there is no hazard under any schedule and no bit is redundant
  std::size_t bits = 0;  // of the plan
  // Bits that can be dropped while everything runs and publishes, but not under some cadence.
  std::size_t byCadenceOnly = 0;
};

// A bit is redundant when dropping it leaves no hazard under any of the schedules, nor under many more of
// them.
Verdict judgeBarriers(const Plan& plan, std::uint64_t seed, std::size_t samples = 64);

// All single bits of the plan: each entry is the plan with one of them dropped.
std::vector<Plan> withoutOneBit(const Plan& plan);

}  // namespace weft::graph::oracle
