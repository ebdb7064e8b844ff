// Times compile() on layered FlatGraphs: `weft_compile_bench 1000 10000 100000` prints a line a number of passes. Fails when
// textures take more than their lower bound; times are not judged.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <random>
#include <vector>

#include "tests/graph/compile/flat_builder.h"

using namespace weft::graph;

namespace {

// Each pass reads the oldest texture that nobody has read and two of those that the last 32 passes wrote, and writes one
// or two. The last has the only side effect. `compute`: every second pass works by image.
FlatBuilder layeredGraph(std::uint32_t passes, bool compute) {
  constexpr Format kFormats[] = {Format::rgba8, Format::rgba16f, Format::rg16f, Format::r32f};
  constexpr std::uint32_t kSizes[] = {1024, 512, 256, 64};
  std::mt19937 random(1);
  FlatBuilder b = emptyGraph();
  std::vector<std::uint32_t> firstOf;  // per pass: its first texture
  std::vector<bool> isRead;            // per texture
  std::uint32_t oldest = 0;
  for (std::uint32_t p = 0; p < passes; ++p) {
    b.pass(fmt::format("p{}", p));
    const bool images = compute && p % 2 == 1;
    const auto count = static_cast<std::uint32_t>(isRead.size());
    std::vector<std::uint32_t> reads;
    const auto take = [&](std::uint32_t texture) {
      if (std::ranges::find(reads, texture) != reads.end()) return;
      reads.push_back(texture);
      isRead[texture] = true;
      b.read(texture, images ? Kind::image : Kind::sampled);
    };
    while (oldest < count && isRead[oldest]) ++oldest;
    if (oldest < count) take(oldest);
    const std::uint32_t recent = p > 32 ? firstOf[p - 32] : 0;
    for (int tries = 0; tries < 8 && reads.size() < 3 && recent < count; ++tries)
      take(recent + static_cast<std::uint32_t>(random() % (count - recent)));
    firstOf.push_back(count);
    for (std::uint32_t i = p + 1 < passes ? 1 + random() % 2 : 1; i > 0; --i) {
      const std::uint32_t texture =
          b.texture(fmt::format("t{}", isRead.size()), kFormats[random() % 4], kSizes[random() % 4]);
      isRead.push_back(false);
      b.write(texture, images ? Kind::image : Kind::color).keep();
    }
  }
  b.sideEffect();
  return b;
}

double threadTime() {  // ns
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e9 + static_cast<double>(now.tv_nsec);
}

// The median of 15 runs of compile(), in nanoseconds per declared pass.
double timeOf(const std::shared_ptr<const FlatGraph>& graph, Plan& plan) {
  const auto passes = static_cast<double>(graph->passes.size());
  const int inner = std::max(1, static_cast<int>(20000 / passes));
  std::vector<double> times;
  for (int i = 0; i < 15; ++i) {
    const double start = threadTime();
    for (int k = 0; k < inner; ++k) plan = compile(graph);
    times.push_back((threadTime() - start) / inner / passes);
  }
  std::ranges::nth_element(times, times.begin() + 7);
  return times[7];
}

}  // namespace

int main(int argc, char** argv) {
  bool good = argc > 1;
  for (int i = 1; i < argc; ++i)
    for (const bool compute : {false, true}) {
      const auto graph = layeredGraph(static_cast<std::uint32_t>(std::atoi(argv[i])), compute).linked();
      Plan plan;
      const double time = timeOf(graph, plan);
      fmt::print("{} passes{}: {:.0f} ns a pass, {} kept, {} bytes of at least {}\n", graph->passes.size(),
                 compute ? ", every second compute" : "", time, plan.steps.size(), plan.bytesAllocated,
                 plan.bytesLowerBound);
      good = good && plan.bytesAllocated == plan.bytesLowerBound;
    }
  return good ? 0 : 1;
}
