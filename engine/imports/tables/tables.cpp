// The imports that are tables of the scene: spheres and meshes of draw lists, and joints, vertex colors, materials, ground and boxes;
// and the mouse. And those that are no tables, but as small: the maps of materials, the order of spheres, and the event of a jump.
#include <algorithm>
#include <array>
#include <bit>
#include <span>
#include <vector>

#include "engine/imports/builtin.h"
#include "engine/imports/material_textures.h"
#include "engine/imports/scene_tables.h"
#include "engine/scene/sort.h"
#include "engine/text/hash.h"

namespace weft::imports {

namespace {

using graph::ImportFacts;
using graph::ImportKind;
using graph::ImportType;

class SpheresProvider : public RowsProvider<SpheresProvider, scene::Instance> {
 public:
  SpheresProvider() : RowsProvider("spheres", sphereColumns()) {}
  static ImportType reflect() {
    return {.name = "spheres",
            .kind = ImportKind::buffer,
            .doc = "The instances of the draw list `spheres`, in the layout of scene/instances.glsl.",
            .columns = tell(sphereColumns())};
  }
  static ImportFacts facts(const graph::ImportRequest&, const WorldFacts& world, Files&) {
    return {.exists = true, .count = world.spheresOf(scene::DrawList::spheres)};
  }

  static constexpr scene::DrawList kList = scene::DrawList::spheres;
  BufferRef buffer(const Frame& frame, const RowLayout& layout, text::Diagnostics& diagnostics) override {
    return frame.tables.spheres(kList, layout, diagnostics);
  }
  static const std::vector<scene::Instance>& rows(const Frame& frame) { return frame.tables.rows(kList); }
  std::uint64_t generation(const Frame& frame) override { return frame.tables.generation(kList); }
  bool isStill(const World& world) const override { return !scene::isMoving(world.scene(), kList); }
};

class MeshesProvider : public RowsProvider<MeshesProvider, scene::MeshRow> {
 public:
  static ImportType reflect() {
    return {
        .name = "meshes",
        .kind = ImportKind::buffer,
        .doc =
            "The meshes of a draw list, one row each, as a draw of them has in its block `instances`. Not "
            "there when there are none.",
        .arguments = {drawListArgument(scene::DrawList::opaque)},
        .columns = tell(meshColumns())};
  }
  static ImportFacts facts(const graph::ImportRequest& request, const WorldFacts& world, Files&) {
    return factsOfRows(world.meshesOf(drawListOf(request)));
  }

  explicit MeshesProvider(const graph::ImportRequest& request)
      : RowsProvider("meshes", meshColumns()), list_(drawListOf(request)) {}
  BufferRef buffer(const Frame& frame, const RowLayout& layout, text::Diagnostics& diagnostics) override {
    return frame.tables.meshes(frame.tables.listOf(list_), layout, diagnostics);
  }
  std::uint64_t generation(const Frame& frame) override {
    return frame.tables.meshFrame().generation(frame.tables.listOf(list_));
  }
  std::span<const scene::MeshRow> rows(const Frame& frame) const {
    return frame.tables.meshFrame().rows(frame.tables.listOf(list_));
  }
  bool isStill(const World& world) const override { return !scene::isMoving(world.scene()); }

 private:
  scene::Selection list_;
};

// The others. `Table` has functions without an object: reflect() without the columns, columns(), facts(world), rows(frame), and,
// where the table changes with more than the scene, generation(frame) and isStill(world).
template <class Table>
class TableProvider : public RowsProvider<TableProvider<Table>, typename Table::Row> {
 public:
  TableProvider() : TableProvider::RowsProvider(Table::reflect().name, Table::columns()) {}
  static ImportType reflect() {
    ImportType type = Table::reflect();
    type.kind = ImportKind::buffer;
    type.columns = tell(Table::columns());
    return type;
  }
  static ImportFacts facts(const graph::ImportRequest&, const WorldFacts& world, Files&) {
    return Table::facts(world);
  }

  static decltype(auto) rows(const Frame& frame) { return Table::rows(frame); }
  std::uint64_t generation(const Frame& frame) override { return Table::generation(frame); }
  bool isStill(const World& world) const override { return Table::isStill(world); }
  bool followsPointer() const override { return std::is_same_v<typename Table::Row, Pointer>; }
};

template <class Of>
struct SceneTable {
  using Row = Of;
  static std::uint64_t generation(const Frame& frame) { return frame.world.sceneGeneration(); }
  static bool isStill(const World&) { return true; }
};

struct Joints : SceneTable<scene::Joint> {
  static ImportType reflect() {
    return {.name = "joints",
            .doc =
                "Of the joints of skinned meshes: bind pose to world, so that a vertex is the mean of its "
                "joints' matrices, by weight, times its position."};
  }
  static Columns<Row> columns() {
    return {column<Row, &Row::now>("now", "bind pose to world"),
            column<Row, &Row::previous>("previous", "of the frame before")};
  }
  static ImportFacts facts(const WorldFacts& world) { return factsOfRows(world.scene->skins.size()); }
  static std::span<const Row> rows(const Frame& frame) { return frame.tables.meshFrame().joints(); }
  static std::uint64_t generation(const Frame& frame) { return frame.tables.meshFrame().jointsGeneration(); }
  static bool isStill(const World& world) { return world.scene().skins.size() == 0; }
};

struct MorphWeights : SceneTable<glm::vec2> {
  static ImportType reflect() {
    return {.name = "morph_weights", .doc = "Of the targets in `morph_targets`, one row for each of a node."};
  }
  static Columns<Row> columns() {
    return {column<Row, std::identity{}>("weight", "x in this frame, y in the one before")};
  }
  static ImportFacts facts(const WorldFacts& world) { return factsOfRows(world.scene->weights.size()); }
  static std::span<const Row> rows(const Frame& frame) { return frame.tables.meshFrame().weights(); }
  static std::uint64_t generation(const Frame& frame) { return frame.tables.meshFrame().jointsGeneration(); }
  static bool isStill(const World& world) { return world.scene().animations.size() == 0; }
};

// What only some vertices of the scene have.
template <class Of, std::vector<Of> scene::MeshData::*kMember>
struct VertexTable : SceneTable<Of> {
  static ImportFacts facts(const WorldFacts& world) { return factsOfRows(of(*world.scene).size()); }
  static std::span<const Of> of(const scene::Scene& scene) {
    return scene.meshData ? std::span(*scene.meshData.*kMember) : std::span<const Of>();
  }
  static std::span<const Of> rows(const Frame& frame) { return of(frame.world.scene()); }
};

struct VertexColors : VertexTable<glm::vec4, &scene::MeshData::colors> {
  static ImportType reflect() {
    return {.name = "vertex_colors",
            .doc =
                "A row for each vertex of the scene's meshes, which a vertex shader of geometry `mesh` finds "
                "by gl_VertexID. It exists where a mesh has vertex colors; those of the others are white."};
  }
  static Columns<Row> columns() {
    return {column<Row, std::identity{}>("color", "linear; a factor of the material's albedo and alpha")};
  }
};

struct SecondUvs : VertexTable<glm::vec2, &scene::MeshData::secondUvs> {
  static ImportType reflect() {
    return {.name = "second_uvs",
            .doc =
                "As `vertex_colors`: where maps are looked up whose word in `materials` says so. It exists "
                "where a material has maps with two sets of texture coordinates, or transforms of them."};
  }
  static Columns<Row> columns() {
    return {column<Row, std::identity{}>("uv", "0,0 is the top left of the image")};
  }
};

struct MorphTargets : VertexTable<assets::MorphTarget, &scene::MeshData::targets> {
  static ImportType reflect() {
    return {.name = "morph_targets",
            .doc = "What animated morph targets add to vertices; rows of `meshes` say where theirs begin."};
  }
  static Columns<Row> columns() {
    return {column<Row, &Row::position>("position", "times the weight, as all"),
            column<Row, &Row::normal>("normal"), column<Row, &Row::tangent>("tangent")};
  }
};

// A mesh's row says which one it has.
struct Materials : SceneTable<scene::Material> {
  static ImportType reflect() {
    return {.name = "materials",
            .doc = "The scene's materials, one row each; shaders/scene/materials.glsl reads them."};
  }
  static Columns<Row> columns() {
    return {
        column<Row, &Row::albedo>("albedo", "linear; factor of its map; F0 of a metal"),
        column<Row, &Row::metallic>("metallic", "factor of its map"),
        column<Row, &Row::emissive>("emissive", "radiance, scene-referred; factor of its map"),
        column<Row, &Row::roughness>("roughness", "perceptual; factor of its map"),
        column<Row, &Row::specular>("specular", "Blinn–Phong: linear"),
        column<Row, &Row::shininess>("shininess", "Blinn–Phong: exponent"),
        column<Row, &Row::alpha>("alpha", "factor of the map's"),
        column<Row, &Row::alphaCutoff>("alpha_cutoff", "over 0: holes where alpha is below"),
        column<Row, &Row::normalScale>("normal_scale", "of the map's x and y"),
        column<Row, &Row::occlusionStrength>("occlusion_strength", "0 to 1"),
        column<Row, &Row::albedoMap>(
            "albedo_map",
            "layer | array << 16 of @material_maps | wrap of u << 20 | of v << 22 (1: "
            "clamp, 2: mirror) | nearest << 24 | at @second_uvs << 25; 0xffffffff: none"),
        column<Row, &Row::normalMap>("normal_map", "tangent space"),
        column<Row, &Row::metallicRoughnessMap>("metallic_roughness_map", "metallic in b, roughness in g"),
        column<Row, &Row::occlusionMap>("occlusion_map", "in r"),
        column<Row, &Row::emissiveMap>("emissive_map"),
        column<Row, &Row::blinnPhong>("blinn_phong", "1: specular and shininess are what the file has"),
        column<Row, &Row::doubleSided>("double_sided", "0 or 1"),
        column<Row, &Row::unlit>("unlit", "1: it shows emissive alone, times its vertex colors"),
        column<Row, &Row::blend>("blends",
                                 "1: alpha is coverage; else it is only held against alpha_cutoff")};
  }
  static ImportFacts facts(const WorldFacts& world) {
    return {.exists = true, .count = static_cast<double>(world.scene->materials.size())};
  }
  static std::vector<Row> rows(const Frame& frame) {
    const scene::Scene& scene = frame.world.scene();
    const std::vector<std::uint32_t> maps = mapsOf(batchTextures(scene), scene.textures.size());
    std::vector<Row> rows(scene.materials.rows().begin(), scene.materials.rows().end());
    for (Row& row : rows)
      for (std::size_t i = 0; i < row.samplers.size(); ++i)
        if (std::uint32_t& map = *row.maps()[i]; map == assets::kNoRow || maps[map] == kNoMap)
          map = kNoMap;
        else
          map = maps[map] | std::uint32_t{row.samplers[i]} << 20;
    return rows;
  }
};

struct Layers : SceneTable<assets::MaterialLayers> {
  static ImportType reflect() {
    return {
        .name = "material_layers",
        .doc =
            "What glTF's extensions say of the scene's materials, one row each, in the order of "
            "`materials`; shaders/scene/material_layers.glsl reads them. Not there when they say nothing."};
  }
  static Columns<Row> columns() {
    return {column<Row, &Row::specularColor>("specular_color", "linear, at normal incidence"),
            column<Row, &Row::specular>("specular", "of the dielectric, at all angles"),
            column<Row, &Row::sheen>("sheen", "linear"),
            column<Row, &Row::sheenRoughness>("sheen_roughness", "perceptual"),
            column<Row, &Row::ior>("ior", "0: it reflects all"),
            column<Row, &Row::layered>("layered", "1: the others say something"),
            column<Row, &Row::coat>("coat", "clear coat of ior 1.5"),
            column<Row, &Row::coatRoughness>("coat_roughness", "perceptual"),
            column<Row, &Row::coatNormalScale>("coat_normal_scale", "of the map's x and y"),
            column<Row, &Row::anisotropy>("anisotropy", "0 to 1"),
            column<Row, &Row::anisotropyTurn>("anisotropy_turn", "radians from the tangent"),
            column<Row, &Row::film>("film", "iridescence, 0 to 1"),
            column<Row, &Row::filmIor>("film_ior", ""),
            column<Row, &Row::filmMin>("film_min", "nm, where its map is 0"),
            column<Row, &Row::filmMax>("film_max", "nm, where it is 1, and without it"),
            column<Row, &Row::transmission>("transmission", "share of the diffuse light, 0 to 1"),
            column<Row, &Row::absorption>("absorption", "per world unit below the surface"),
            column<Row, &Row::thickness>("thickness", "of what is below it, in the mesh's units; 0: a wall"),
            column<Row, &Row::specularMap>("specular_map", "in a; as in `materials`"),
            column<Row, &Row::specularColorMap>("specular_color_map", ""),
            column<Row, &Row::coatMap>("coat_map", "in r"),
            column<Row, &Row::coatRoughnessMap>("coat_roughness_map", "in g"),
            column<Row, &Row::coatNormalMap>("coat_normal_map", "tangent space"),
            column<Row, &Row::sheenMap>("sheen_map", ""),
            column<Row, &Row::sheenRoughnessMap>("sheen_roughness_map", "in a"),
            column<Row, &Row::anisotropyMap>("anisotropy_map", "direction in r and g, strength in b"),
            column<Row, &Row::filmMap>("film_map", "in r"),
            column<Row, &Row::filmThicknessMap>("film_thickness_map", "in g"),
            column<Row, &Row::transmissionMap>("transmission_map", "in r"),
            column<Row, &Row::thicknessMap>("thickness_map", "in g")};
  }
  static ImportFacts facts(const WorldFacts& world) {
    const auto& materials = world.scene->materials;
    const auto says = [](const scene::Material& each) { return each.layers.layered; };
    return {.exists = std::ranges::any_of(materials.rows(), says),
            .count = static_cast<double>(materials.size())};
  }
  static std::vector<Row> rows(const Frame& frame) {
    std::vector<Row> rows;
    for (const scene::Material& each : Materials::rows(frame)) rows.push_back(each.layers);
    return rows;
  }
};

struct Ground : SceneTable<scene::Ground> {
  static ImportType reflect() {
    return {.name = "ground", .doc = "The plane that the scene stands on: one row."};
  }
  static Columns<Row> columns() {
    return {column<Row, &Row::height>("height", "world Y"),
            column<Row, [](const Row& row) { return row.albedo.value_or(glm::vec3(0)); }>(
                "albedo", "linear, of its surface"),
            column<Row, [](const Row& row) { return row.albedo ? row.radius : 0.0f; }>(
                "radius", "of its surface; 0: it has none and shows the environment")};
  }
  static ImportFacts facts(const WorldFacts& world) { return factsOfRows(world.scene->ground ? 1 : 0); }
  static auto rows(const Frame& frame) { return std::array{frame.world.scene().ground.value_or(Row{})}; }
};

struct Boxes {
  using Row = scene::Box;
  static ImportType reflect() {
    return {
        .name = "boxes",
        .doc = "Around each sphere and each mesh of the scene, one row each, as they stand in the frame."};
  }
  static Columns<Row> columns() {
    return {column<Row, &Row::low>("low", "world; over `high` where a mesh has no vertices"),
            column<Row, &Row::high>("high", "world")};
  }
  static ImportFacts facts(const WorldFacts& world) {
    return {.exists = true, .count = world.spheresOf({}) + world.meshesOf({})};
  }
  static std::vector<Row> rows(const Frame& frame) {
    const scene::DrawList all = frame.tables.listOf({});
    std::vector<Row> rows;
    for (const scene::Instance& each : frame.tables.rows(all))
      rows.push_back({each.center - each.radius, each.center + each.radius});
    const auto meshes = frame.tables.meshFrame().bounds(all);
    rows.insert(rows.end(), meshes.begin(), meshes.end());
    return rows;
  }
  static std::uint64_t generation(const Frame& frame) {
    const scene::DrawList all = frame.tables.listOf({});
    return text::hashCombine(frame.tables.generation(all), frame.tables.meshFrame().generation(all));
  }
  static bool isStill(const World& world) { return !scene::isMoving(world.scene()); }
};

struct Mouse {
  using Row = Pointer;
  static ImportType reflect() {
    return {
        .name = "mouse",
        .doc =
            "Where the mouse points in the presented picture, and its left button: one row. Points are in "
            "pixels from the lower left corner, as gl_FragCoord counts them."};
  }
  static Columns<Row> columns() {
    return {column<Row, &Row::position>("position", "pixels, where it was last over the picture"),
            column<Row, &Row::dragged>("dragged", "pixels, where it was last while the button was held"),
            column<Row, &Row::pressed>("pressed", "pixels, where the button last went down"),
            column<Row, &Row::down>("down", "1 while the button is held, else 0"),
            column<Row, &Row::clicked>("clicked", "1 in the frame in which the button went down, else 0")};
  }
  static ImportFacts facts(const WorldFacts&) { return {.exists = true, .count = 1, .changing = true}; }
  static auto rows(const Frame& frame) { return std::array{frame.input.pointer}; }
  static std::uint64_t generation(const Frame& frame) {
    const Pointer& p = frame.input.pointer;
    std::uint64_t hash = text::kHashSeed + (p.down ? 2 : 0) + (p.clicked ? 1 : 0);
    for (const glm::vec2 at : {p.position, p.dragged, p.pressed})
      for (const float c : {at.x, at.y}) hash = text::hashCombine(hash, std::bit_cast<std::uint32_t>(c));
    return hash;
  }
  static bool isStill(const World&) { return false; }
};

// ---- what is no table ----

class MaterialMapsProvider : public Provider {
 public:
  static graph::ImportType reflect() {
    return {.name = "material_maps",
            .kind = graph::ImportKind::texture,
            .doc =
                "The textures of the scene's materials, all levels, batched by size: an array of 8 "
                "sampler2DArray, which shaders/scene/materials.glsl looks up. Not there when no material "
                "has one.",
            .array = kMaterialArrays};
  }

  static graph::ImportFacts facts(const graph::ImportRequest&, const WorldFacts& world, Files&) {
    const std::vector<MaterialArray> arrays = batchTextures(*world.scene);
    graph::ImportFacts facts{.exists = !arrays.empty(),
                             .format = graph::Format::rgba8,
                             .layered = true,
                             .count = static_cast<double>(arrays.size())};
    for (const MaterialArray& array : arrays) {  // the greatest of each
      facts.width = std::max(facts.width, array.width);
      facts.height = std::max(facts.height, array.height);
      facts.layers = std::max(facts.layers, static_cast<std::uint32_t>(array.textures.size()));
    }
    facts.mips = gl::mipsOf(facts.width, facts.height);
    return facts;
  }

  explicit MaterialMapsProvider(const graph::ImportRequest& request) : element_(graph::elementOf(request)) {}
  gl::TextureRef texture(const Frame& frame, text::Diagnostics& diagnostics) override {
    return frame.tables.textures().array(frame.world.scene(), frame.world.sceneGeneration(), element_,
                                         diagnostics);
  }
  std::uint64_t generation(const Frame& frame) override { return frame.world.sceneGeneration(); }
  bool isStill(const World&) const override { return true; }

 private:
  std::uint32_t element_;
};

class DrawOrderProvider : public Provider {
 public:
  static graph::ImportType reflect() {
    return {
        .name = "draw_order",
        .kind = graph::ImportKind::buffer,
        .doc =
            "uvec2(key, index) per instance of `list`, back to front, sorted on the CPU every frame by the "
            "squared distance from the eye less the squared radius, which is right for all spheres that "
            "do not meet.",
        .arguments = {drawListArgument(), viewArgument()}};
  }

  static graph::ImportFacts facts(const graph::ImportRequest& request, const WorldFacts& world, Files&) {
    const double count = world.spheresOf(drawListOf(request));
    return {.exists = true,
            .bytes = static_cast<std::uint64_t>(std::max(count, 1.0)) * sizeof(scene::SortElement),
            .count = count};
  }

  explicit DrawOrderProvider(const graph::ImportRequest& request)
      : list_(drawListOf(request)), view_(request) {}

  BufferRef buffer(const Frame& frame, const RowLayout&, text::Diagnostics& diagnostics) override {
    if (const std::uint64_t now = generation(frame); sorted_ != now) {
      scene::drawOrder(frame.tables.rows(frame.tables.listOf(list_)), view_.view(frame).eye, elements_,
                       scratch_);
      if (elements_.empty()) elements_.emplace_back();
      if (!sendTo(buffer_, std::as_bytes(std::span(elements_)), "draw order", false, diagnostics)) return {};
      sorted_ = now;
    }
    return {buffer_.id(), buffer_.bytes()};
  }
  std::uint64_t generation(const Frame& frame) override {
    const scene::DrawList list = frame.tables.listOf(list_);
    return text::hashCombine(frame.tables.generation(list), view_.generation(frame));
  }

 private:
  scene::Selection list_;
  NamedView view_;
  gl::Buffer buffer_;
  std::uint64_t sorted_ = 0;  // the generation that the buffer holds
  std::vector<scene::SortElement> elements_, scratch_;
};

class CutProvider : public Provider {
 public:
  static graph::ImportType reflect() {
    return {.name = "cut",
            .kind = graph::ImportKind::event,
            .doc = "Changes when the camera jumps.",
            .arguments = {}};
  }

  std::uint64_t generation(const Frame& frame) override { return frame.input.cutGeneration; }
  bool isStill(const World&) const override { return true; }
};

}  // namespace

void addTables(graph::PlugIns<Import>& imports) {
  const auto add = [&]<class... Made>() { (imports.add(std::make_unique<ImportOf<Made>>()), ...); };
  add.operator()<SpheresProvider, MeshesProvider, TableProvider<Materials>, TableProvider<Layers>,
                 TableProvider<Joints>, TableProvider<MorphWeights>, TableProvider<MorphTargets>,
                 TableProvider<VertexColors>, TableProvider<SecondUvs>, TableProvider<Ground>,
                 TableProvider<Boxes>, TableProvider<Mouse>, MaterialMapsProvider, DrawOrderProvider,
                 CutProvider>();
}

}  // namespace weft::imports
