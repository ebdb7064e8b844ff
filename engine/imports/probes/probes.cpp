#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

#include "engine/graph/language/value.h"
#include "engine/imports/builtin.h"
#include "engine/imports/probes/probe_worker.h"
#include "engine/imports/scene_tables.h"

namespace weft::imports {

namespace {

using graph::Value;

constexpr double kMostAlong = 256, kMostProbes = 1 << 18;

// What the block `probes` of shaders/gi/probes.glsl begins with; nine vec4 a probe follow.
struct Header {
  glm::vec4 low, high;
  glm::uvec4 count;
};

// In the order of reflect().
const std::string& litList(const graph::ImportRequest& request) {
  return request.arguments[0].second.symbol;
}
const Value& gridOf(const graph::ImportRequest& request) {
  return request.arguments[1].second;
}
double nearOf(const graph::ImportRequest& request) {
  return request.arguments[2].second.v[0];
}
double farOf(const graph::ImportRequest& request) {
  return request.arguments[3].second.v[0];
}

glm::uvec3 countOf(const Value& grid) {
  glm::uvec3 count;
  for (int axis = 0; axis < 3; ++axis)
    count[axis] =
        static_cast<std::uint32_t>(std::clamp(grid.v[static_cast<std::size_t>(axis)], 1.0, kMostAlong));
  return count;
}

scene::ProbeRules rulesOf(const graph::ImportRequest& request) {
  return {.near = static_cast<float>(nearOf(request)),
          .far = static_cast<float>(farOf(request)),
          .shape = request.arguments[4].second.symbol == "point" ? scene::ProbeShape::point
                                                                 : scene::ProbeShape::cap,
          .window = request.arguments[5].second.symbol == "hard" ? scene::ProbeWindow::hard
                                                                 : scene::ProbeWindow::smooth};
}

std::uint64_t bytesOf(glm::uvec3 count) {
  return sizeof(Header) + std::uint64_t{count.x} * count.y * count.z * sizeof(scene::Probe);
}

bool lightAlike(const scene::Instance& a, const scene::Instance& b) {
  return a.center == b.center && a.radius == b.radius && a.albedo == b.albedo && a.metallic == b.metallic;
}

class ProbesProvider : public Provider {
 public:
  explicit ProbesProvider(const graph::ImportRequest& request)
      : list_(scene::findDrawList(litList(request))),
        rules_(rulesOf(request)),
        count_(countOf(gridOf(request))) {}

  BufferRef buffer(const Frame& frame, const RowLayout&, base::Diagnostics& diagnostics) override {
    refresh(frame);
    if (!buffer_) {
      auto made = gl::Buffer::create(bytesOf(count_), GL_DYNAMIC_STORAGE_BIT, "probes", diagnostics);
      if (!made) return {};
      buffer_ = std::move(*made);
    }
    if (stale_) upload();
    return {buffer_.id(), buffer_.bytes()};
  }
  std::uint64_t generation(const Frame& frame) override {
    refresh(frame);
    return generation_;
  }
  bool isStill(const World& world) const override {
    return !list_ || !scene::isMoving(world.scene(), *list_);
  }

 private:
  // Once a frame: takes what is ready, and gives the worker what changed. A headless frame waits until it has both.
  void refresh(const Frame& frame) {
    if (frame_ == frame.number || !list_) return;
    frame_ = frame.number;
    const bool waits = frame.input.headless;
    takeResult(frame, waits);
    const std::uint64_t rows = frame.tables.generation(*list_);
    if (worker_.isBusy() || rows == rows_) return;
    rows_ = rows;
    if (generation_ != 0 && std::ranges::equal(frame.tables.rows(*list_), given_, lightAlike)) return;
    given_ = frame.tables.rows(*list_);
    job_.rules = rules_;
    job_.count = count_;
    job_.spheres = given_;
    job_.threads = waits ? 0 : 1;  // beside frames, one is enough
    worker_.start(job_);
    if (waits) takeResult(frame, true);
  }

  void takeResult(const Frame& frame, bool waits) {
    if (!worker_.isBusy()) return;
    if (waits) worker_.wait();
    if (!worker_.take(result_)) return;
    generation_ = frame.newGeneration();
    stale_ = true;
  }

  // Zeros before the first result: no bounce yet.
  void upload() {
    const Header header{.low = glm::vec4(result_.grid.low, 0),
                        .high = glm::vec4(result_.grid.high, 0),
                        .count = glm::uvec4(count_, 0)};
    gl::uploadBuffer(buffer_.id(), 0, std::as_bytes(std::span(&header, 1)));
    result_.probes.resize(std::size_t{count_.x} * count_.y * count_.z);
    gl::uploadBuffer(buffer_.id(), sizeof header, std::as_bytes(std::span(result_.probes)));
    stale_ = false;
  }

  std::optional<scene::DrawList> list_;
  scene::ProbeRules rules_;
  glm::uvec3 count_;
  ProbeWorker worker_;
  ProbeWorker::Job job_;  // memory for the next
  ProbeWorker::Result result_;
  std::vector<scene::Instance> given_;  // what the newest job is made of
  std::uint64_t frame_ = 0, rows_ = 0, generation_ = 0;
  gl::Buffer buffer_;
  bool stale_ = true;
};

class Probes : public Import {
 public:
  graph::ImportType reflect() const override {
    return {
        .name = "probes",
        .kind = graph::ImportKind::buffer,
        .doc =
            "A grid of light probes over the box of `list`: what its spheres throw back of the "
            "environment, computed "
            "on the CPU beside the frames, in the layout of gi/probes.glsl.",
        .arguments = {
            {.name = "list",
             .initial = Value::text(scene::drawListNames().front()),
             .choices = {},
             .doc = "a draw list",
             .drawList = true},
            {.name = "grid",
             .initial = {Value::Type::list, 3, {21, 21, 3, 0}, {}},
             .choices = {},
             .doc = "probes along x, y and z: 1 to 256, together at most 262144"},
            {.name = "near",
             .initial = Value::number(1.05),
             .choices = {},
             .doc = "a sphere lights no probe nearer than that to its centre, in radii; 1 at least"},
            {.name = "far",
             .initial = Value::number(10),
             .choices = {},
             .doc = "nor one that is as far as that, in radii; more than `near`"},
            {.name = "shape",
             .initial = Value::text("cap"),
             .choices = {"cap", "point"},
             .doc = "how a sphere is seen: as the cap of the sky that it covers, or as a point as strong"},
            {.name = "window",
             .initial = Value::text("smooth"),
             .choices = {"smooth", "hard"},
             .doc = "how its light ends at `far`"}}};
  }

  graph::ImportFacts facts(const graph::ImportRequest& request, const WorldFacts&, Files&) const override {
    graph::ImportFacts facts{.exists = true};
    const auto refuse = [&](const char* argument, const char* expected, std::string found) {
      base::Diagnostic problem;
      problem.code = base::Code::badImportArgument;
      problem.message = fmt::format("import 'probes': argument '{}' does not fit", argument);
      problem.expected = expected;
      problem.found = std::move(found);
      problem.hint = fmt::format("give \"{}\" such a value, or leave it out", argument);
      facts.problems.push_back(std::move(problem));
    };
    const Value& grid = gridOf(request);
    const bool whole = std::ranges::all_of(std::span(grid.v).first(3), [](double along) {
      return along >= 1 && along <= kMostAlong && along == std::floor(along);
    });
    if (!whole || grid.v[0] * grid.v[1] * grid.v[2] > kMostProbes)
      refuse("grid", "three whole numbers from 1 to 256 whose product is at most 262144",
             graph::toText(grid));
    if (!(nearOf(request) >= 1)) refuse("near", "1 or more", fmt::format("{}", nearOf(request)));
    if (!(farOf(request) > nearOf(request)) || !(farOf(request) <= 1e6))
      refuse("far", "more than `near`, at most 1000000", fmt::format("{}", farOf(request)));
    const glm::uvec3 count = countOf(grid);
    facts.count = static_cast<double>(std::size_t{count.x} * count.y * count.z);
    facts.bytes = bytesOf(count);
    return facts;
  }

  std::unique_ptr<Provider> provide(const graph::ImportRequest& request) const override {
    return std::make_unique<ProbesProvider>(request);
  }
};

}  // namespace

std::unique_ptr<Import> makeProbes() {
  return std::make_unique<Probes>();
}

}  // namespace weft::imports
