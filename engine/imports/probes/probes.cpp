#include "engine/scene/probes/probes.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <future>
#include <span>
#include <vector>

#include "engine/graph/language/value.h"
#include "engine/imports/builtin.h"
#include "engine/imports/scene_tables.h"

namespace weft::imports {

namespace {

using graph::Value;

constexpr double kMaxAlong = 256, kMaxProbes = 1 << 18;

// What the block `probes` of shaders/gi/probes.glsl begins with; nine vec4 a probe follow.
struct Header {
  glm::vec4 low, high;
  glm::uvec4 count;
};

glm::uvec3 countOf(const graph::ImportRequest& request) {
  const Value& grid = request.at("grid");
  glm::uvec3 count;
  for (int axis = 0; axis < 3; ++axis)
    count[axis] =
        static_cast<std::uint32_t>(std::clamp(grid.v[static_cast<std::size_t>(axis)], 1.0, kMaxAlong));
  return count;
}

scene::ProbeRules rulesOf(const graph::ImportRequest& request) {
  return {.near = static_cast<float>(request.at("near").v[0]),
          .far = static_cast<float>(request.at("far").v[0]),
          .shape = request.at("shape").symbol == "point" ? scene::ProbeShape::point : scene::ProbeShape::cap,
          .window =
              request.at("window").symbol == "hard" ? scene::ProbeWindow::hard : scene::ProbeWindow::smooth};
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
      : list_(drawListOf(request)), rules_(rulesOf(request)), count_(countOf(request)) {}
  ~ProbesProvider() override { stop_ = true; }

  BufferRef buffer(const Frame& frame, const RowLayout&, text::Diagnostics& diagnostics) override {
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
  bool isStill(const World& world) const override { return !scene::isMoving(world.scene(), list_); }

 private:
  struct Computed {
    scene::ProbeGrid grid;
    std::vector<scene::Probe> probes;
  };

  // Once a frame: takes what is ready, and has computed what changed, on a thread beside the frames. A headless frame waits for
  // both.
  void refresh(const Frame& frame) {
    if (frame_ == frame.number) return;
    frame_ = frame.number;
    const bool waits = frame.input.headless;
    take(frame, waits);
    const std::uint64_t rows = frame.tables.generation(list_);
    if (pending_.valid() || rows == rows_) return;
    rows_ = rows;
    if (generation_ != 0 && std::ranges::equal(frame.tables.rows(list_), given_, lightAlike)) return;
    given_ = frame.tables.rows(list_);
    pending_ = std::async(std::launch::async, [this, threads = waits ? 0 : 1] {
      Computed made{.grid = scene::placeProbes(given_, count_), .probes = {}};
      made.probes.resize(made.grid.size());
      scene::computeProbes(made.grid, rules_, given_, made.probes, &stop_, threads);
      return made;
    });
    if (waits) take(frame, true);
  }

  void take(const Frame& frame, bool waits) {
    if (!pending_.valid()) return;
    if (!waits && pending_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    computed_ = pending_.get();
    generation_ = frame.newGeneration();
    stale_ = true;
  }

  // Zeros before the first result: no bounce yet.
  void upload() {
    const Header header{.low = glm::vec4(computed_.grid.low, 0),
                        .high = glm::vec4(computed_.grid.high, 0),
                        .count = glm::uvec4(count_, 0)};
    gl::uploadBuffer(buffer_.id(), 0, std::as_bytes(std::span(&header, 1)));
    computed_.probes.resize(std::size_t{count_.x} * count_.y * count_.z);
    gl::uploadBuffer(buffer_.id(), sizeof header, std::as_bytes(std::span(computed_.probes)));
    stale_ = false;
  }

  scene::DrawList list_;
  scene::ProbeRules rules_;
  glm::uvec3 count_;
  Computed computed_;
  std::vector<scene::Instance> given_;  // of what the newest are computed
  std::uint64_t frame_ = 0, rows_ = 0, generation_ = 0;
  gl::Buffer buffer_;
  bool stale_ = true;
  std::atomic<bool> stop_ = false;
  std::future<Computed> pending_;  // goes first, and waits for its thread
};

class Probes : public ImportOf<ProbesProvider> {
 public:
  graph::ImportType reflect() const override {
    return {
        .name = "probes",
        .kind = graph::ImportKind::buffer,
        .doc =
            "A grid of light probes over the box of `list`: what its spheres throw back of the "
            "environment, computed on the CPU beside the frames, in the layout of gi/probes.glsl.",
        .arguments = {
            drawListArgument(),
            argument("grid", {Value::Type::list, 3, {21, 21, 3, 0}, {}},
                     "probes along x, y and z: 1 to 256, together at most 262144"),
            argument("near", Value::number(1.05),
                     "a sphere lights no probe nearer than that to its center, in radii; 1 at least"),
            argument("far", Value::number(10), "nor one that is as far as that, in radii; more than `near`"),
            argument("shape", Value::text("cap"),
                     "how a sphere is seen: as the cap of the sky that it covers, or as a point as strong",
                     {"cap", "point"}),
            argument("window", Value::text("smooth"), "how its light ends at `far`", {"smooth", "hard"})}};
  }

  graph::ImportFacts facts(const graph::ImportRequest& request, const WorldFacts&, Files&) const override {
    graph::ImportFacts facts{.exists = true};
    const auto refuse = [&](const char* argument, const char* expected, std::string found) {
      facts.problems.push_back(
          {.code = text::Code::badImportArgument,
           .message = fmt::format("import 'probes': argument '{}' does not fit", argument),
           .expected = expected,
           .found = std::move(found),
           .hint = fmt::format("give \"{}\" such a value, or leave it out", argument)});
    };
    const Value& grid = request.at("grid");
    const double near = request.at("near").v[0], far = request.at("far").v[0];
    const bool whole = std::ranges::all_of(std::span(grid.v).first(3), [](double along) {
      return along >= 1 && along <= kMaxAlong && along == std::floor(along);
    });
    if (!whole || grid.v[0] * grid.v[1] * grid.v[2] > kMaxProbes)
      refuse("grid", "three whole numbers from 1 to 256 whose product is at most 262144",
             graph::toText(grid));
    if (!(near >= 1)) refuse("near", "1 or more", fmt::format("{}", near));
    if (!(far > near) || !(far <= 1e6))
      refuse("far", "more than `near`, at most 1000000", fmt::format("{}", far));
    const glm::uvec3 count = countOf(request);
    facts.count = static_cast<double>(std::size_t{count.x} * count.y * count.z);
    facts.bytes = bytesOf(count);
    return facts;
  }
};

}  // namespace

std::unique_ptr<Import> makeProbes() {
  return std::make_unique<Probes>();
}

}  // namespace weft::imports
