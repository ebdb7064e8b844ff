// Times the graph core on neutral workloads (engine/graph/workload/neutral.h): read, validate and compile apart, and
// nlohmann's parse of the same bytes for scale. Everything runs on the calling thread; times are CPU time of
// that thread (equal to wall time on an idle machine, and comparable on a busy one), the median of
// repetitions. compile() keeps its CompileScratch between them, as a recompile does. Does not: touch GL, or
// judge the numbers.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/diagnostic.h"

namespace weft::app {

struct WorkloadBenchOptions {
  std::vector<std::string> files;
  // Layered workloads of these many passes, made on the spot and measured like files.
  std::vector<std::size_t> generated{1000, 10000, 100000};
  int repetitions = 15;
};

// JSON: {"workloads": [{name, passes, passes_kept, read_ns_per_pass, validate_ns_per_pass,
// compile_ns_per_pass, barriers, barrier_bits, bytes_declared, bytes_allocated, bytes_lower_bound,
// nlohmann_parse_ns_per_pass, compute: {the same of the graph with every second pass as compute}}], "growth":
// exponent of compile time from the smallest to the largest generated workload}. With exactly one file and
// nothing generated, the one object itself. All times per declared pass. Empty after errors, which are in
// `diagnostics`.
std::optional<std::string> benchWorkloads(const WorkloadBenchOptions& options,
                                          base::Diagnostics& diagnostics);

// `bench --workload FILE`: that one object.
std::optional<std::string> benchWorkload(const std::string& path, base::Diagnostics& diagnostics);

}  // namespace weft::app
