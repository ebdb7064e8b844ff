// The imports `sun` and `lamps`: the scene's sun as one row and a view that its shadow is drawn from, and its point and spot lights as
// a table, with six views of each.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/imports/builtin.h"
#include "engine/imports/scene_tables.h"
#include "engine/scene/light_views.h"

namespace weft::imports {

namespace {

constexpr double kMaxTexels = 16384;

// Where a graph's own sun stands; empty: where the scene's does.
std::optional<glm::vec3> directionOf(const graph::ImportRequest& request) {
  const graph::Value& value = request.at("direction");
  const glm::dvec3 towards(value.v[0], value.v[1], value.v[2]);
  const double length = glm::length(towards);
  if (!(length > 0 && std::isfinite(length))) return {};
  return glm::vec3(towards / length);
}

struct SunRow : scene::Sun {
  float cosAngle = 1, texel = 0;
  glm::mat4 shadowMatrix{1};
};

Columns<SunRow> sunColumns() {
  using Row = SunRow;
  return {column<Row, &Row::direction>("direction", "unit, towards it, world"),
          column<Row, &Row::cosAngle>("cos_angle", "of half its diameter in the sky"),
          column<Row, &Row::irradiance>("irradiance", "linear RGB on what faces it, scene-referred"),
          column<Row, &Row::texel>("texel", "world units across a texel of its map"),
          column<Row, &Row::shadowMatrix>("shadow_matrix",
                                          "world to u, v and reversed-Z depth of its map, 0 to 1")};
}

class SunProvider : public RowsProvider<SunProvider, SunRow> {
 public:
  static graph::ImportType reflect() {
    return {
        .name = "sun",
        .kind = graph::ImportKind::buffer,
        .doc = "The scene's sun: one row, and an orthographic view of everything from it.",
        .arguments =
            {argument("texels", graph::Value::number(2048),
                      "a side of the map that its shadow is drawn into; 0: none, and the row does not "
                      "follow what casts it"),
             argument("direction", graph::Value{graph::Value::Type::list, 3, {}, {}},
                      "towards it, in place of the scene's; then it is there without a sun, too, and gives "
                      "no light then. [0, 0, 0]: the scene's"),
             argument("casting", graph::Value::boolean(false),
                      "true: there only if the scene's sun casts shadows")},
        .columns = tell(sunColumns()),
        .views = true};
  }

  static graph::ImportFacts facts(const graph::ImportRequest& request, const WorldFacts& world, Files&) {
    const bool casting = request.at("casting").truth();
    const std::optional<scene::Sun>& sun = world.scene->sun;
    return factsOfRows(directionOf(request) || (sun && (sun->shadow || !casting)) ? 1 : 0);
  }

  explicit SunProvider(const graph::ImportRequest& request)
      : RowsProvider("sun", sunColumns()),
        texels_(
            static_cast<std::uint32_t>(std::clamp(std::floor(request.at("texels").v[0]), 0.0, kMaxTexels))),
        direction_(directionOf(request)) {}

  std::array<SunRow, 1> rows(const Frame&) const {
    const auto cosAngle = static_cast<float>(std::cos(sun_.angle / 2 * std::numbers::pi / 180));
    return {SunRow{sun_, cosAngle, fitted_.texel, fitted_.shadowMatrix}};
  }
  const scene::ViewData& view(const Frame& frame, const ViewPart&) override {
    generation(frame);
    return fitted_.view;
  }
  // Brings the row and the view up to date.
  std::uint64_t generation(const Frame& frame) override {
    const std::uint64_t changed = frame.world.sceneGeneration();
    const scene::Box bounds = texels_ > 0 ? frame.tables.meshFrame().sceneBounds() : scene::Box();
    scene::Sun sun = frame.tables.meshFrame().sun().value_or(scene::Sun{.irradiance = glm::vec3(0)});
    sun.direction = direction_.value_or(sun.direction);
    if (scene_ == changed && sun.direction == sun_.direction && bounds == bounds_) return generation_;
    const bool another = std::exchange(scene_, changed) != changed;
    bounds_ = bounds;
    sun_ = sun;
    const scene::SunView fitted = scene::sunView(sun_, bounds, std::max(texels_, 1U));
    // The generation rises only when a value has changed: the fit follows the bounds in steps.
    if (!another && fitted.shadowMatrix == fitted_.shadowMatrix) return generation_;
    fitted_ = fitted;
    return generation_ = frame.newGeneration();
  }
  bool isStill(const World& world) const override { return !scene::isMoving(world.scene()); }

 private:
  std::uint32_t texels_;
  std::optional<glm::vec3> direction_;
  scene::Sun sun_;
  scene::SunView fitted_;
  scene::Box bounds_;
  std::uint64_t scene_ = 0, generation_ = 0;
};

struct LampRow : scene::Lamp {
  std::int32_t caster = -1;
};

Columns<LampRow> lampColumns() {
  using Row = LampRow;
  return {column<Row, &Row::position>("position", "world"),
          column<Row, &Row::range>("range", "world units; nothing beyond is lit"),
          column<Row, &Row::intensity>("intensity",
                                       "linear RGB; irradiance times squared distance, scene-referred"),
          column<Row, &Row::cosInner>("cos_inner", "of a spot: cosine within which it is full; -1 all round"),
          column<Row, &Row::direction>("direction", "unit, away from it, of a spot"),
          column<Row, &Row::cosOuter>("cos_outer", "cosine beyond which nothing is lit"),
          column<Row, &scene::nearPlaneOf>("near_plane", "of its views"),
          column<Row, &Row::radius>("radius", "world units: its own, for soft shadows"),
          column<Row, &Row::across>("across", "of a rectangle: from its middle to a side; 0: it is none"),
          column<Row, &Row::up>("up", "to the next side"),
          column<Row, &Row::caster>("shadow", "index among those that cast shadows, or -1")};
}

class LampsProvider : public RowsProvider<LampsProvider, LampRow> {
 public:
  static graph::ImportType reflect() {
    return {.name = "lamps",
            .kind = graph::ImportKind::buffer,
            .doc =
                "The scene's point and spot lights, one row each, and views of 90 degrees from them: "
                "@lamps[l].face[f], faces as of a cube map.",
            .arguments = {argument("casting", graph::Value::boolean(false), "only those that cast shadows"),
                          argument("sized", graph::Value::boolean(false), "only those with a size")},
            .columns = tell(lampColumns()),
            .views = true};
  }

  static graph::ImportFacts facts(const graph::ImportRequest& request, const WorldFacts& world, Files&) {
    return factsOfRows(
        static_cast<std::size_t>(std::ranges::count_if(world.scene->lamps.rows(), choice(request))));
  }

  explicit LampsProvider(const graph::ImportRequest& request)
      : RowsProvider("lamps", lampColumns()), chosen_(choice(request)) {}

  std::vector<LampRow> rows(const Frame&) const {
    std::vector<LampRow> rows;
    std::int32_t casters = 0;
    for (const scene::Lamp& lamp : lamps_) rows.push_back({lamp, lamp.shadow ? casters++ : -1});
    return rows;
  }
  const scene::ViewData& view(const Frame& frame, const ViewPart& part) override {
    generation(frame);
    if (part.element < lamps_.size()) {
      const scene::Lamp& lamp = lamps_[part.element];
      view_ = scene::cubeView(lamp.position, scene::nearPlaneOf(lamp), part.face, part.width);
    }
    return view_;
  }
  // Brings the rows up to date.
  std::uint64_t generation(const Frame& frame) override {
    const scene::MeshFrame& placed = frame.tables.meshFrame();
    const std::uint64_t now = placed.lightsGeneration();
    if (std::exchange(placed_, now) == now) return now;
    lamps_.clear();
    std::ranges::copy_if(placed.lamps(), std::back_inserter(lamps_), chosen_);
    return now;
  }
  bool isStill(const World& world) const override {
    return !scene::isMoving(world.scene()) ||
           std::ranges::none_of(world.scene().lamps.rows(),
                                [](const scene::Lamp& lamp) { return lamp.node.valid(); });
  }

 private:
  static std::function<bool(const scene::Lamp&)> choice(const graph::ImportRequest& request) {
    return [casting = request.at("casting").truth(),
            sized = request.at("sized").truth()](const scene::Lamp& lamp) {
      return (lamp.shadow || !casting) && (lamp.across != glm::vec3(0) || !sized);
    };
  }
  std::function<bool(const scene::Lamp&)> chosen_;
  std::uint64_t placed_ = 0;        // generation of the lamps that were seen last
  std::vector<scene::Lamp> lamps_;  // those that the import has
  scene::ViewData view_;
};

}  // namespace

std::unique_ptr<Import> makeSun() {
  return std::make_unique<ImportOf<SunProvider>>();
}

std::unique_ptr<Import> makeLamps() {
  return std::make_unique<ImportOf<LampsProvider>>();
}

}  // namespace weft::imports
