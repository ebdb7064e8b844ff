// A draw list of a graph's own: things of the scene, chosen by what the scene file says of them.
#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "engine/imports/builtin.h"
#include "engine/imports/scene_tables.h"
#include "engine/text/hash.h"
#include "engine/text/nearest.h"

namespace weft::imports {

namespace {

using graph::Value;

const std::vector<std::string> kOrders = {"auto", "none", "by_material", "front_to_back", "back_to_front"};

// Which word of the list nothing in the scene has, and the nearest that something has.
text::Diagnostic saysNothing(const scene::Selection& list, const scene::Scene& scene) {
  std::vector<std::string> names, tags, materials;
  for (const scene::Label& label : scene.labels.rows()) {
    names.insert(names.end(), label.names.begin(), label.names.end());
    tags.insert(tags.end(), label.tags.begin(), label.tags.end());
  }
  for (const scene::Material& material : scene.materials.rows()) materials.push_back(material.name);
  std::string all = "all of this", hint = "leave out one of the arguments";
  const std::tuple<const char*, std::string, const std::vector<std::string>&> words[] = {
      {"name", list.name, names}, {"tag", list.tag, tags}, {"material_name", list.material, materials}};
  for (const auto& [what, word, known] : words) {
    const auto fits = [&](const std::string& text) { return scene::matches(word, text); };
    if (word.empty() || std::ranges::any_of(known, fits)) continue;
    all = fmt::format("the {} '{}'", what, word);
    hint = text::nearestHint(word, known);
    if (hint.empty()) hint = fmt::format("give things this {} in the scene file", what);
  }
  text::Diagnostic said =
      badArgument(fmt::format("nothing in the scene '{}' has {}", scene.name, all), "", "", std::move(hint));
  said.code = text::Code::emptyImport;
  said.severity = text::Severity::warning;
  return said;
}

std::vector<std::string> listWords() {
  std::vector<std::string> words = scene::drawListNames();
  words.insert(words.begin(), "all");
  return words;
}

class DrawListProvider : public Provider {
 public:
  static graph::ImportType reflect() {
    return {.name = "draw_list",
            .kind = graph::ImportKind::list,
            .doc =
                "A draw list of the graph's own, for `list`, count() and has(): the things of a list of the "
                "scene that have a name, a tag and a material. `*` at the ends of names stands for any text.",
            .arguments = {
                argument("of", Value::text("all"), "the list of the scene that they are in", listWords()),
                argument("name", Value::text(""), "of a thing, or of the model or node that it is part of"),
                argument("tag", Value::text(""), "that the scene file gives it"),
                argument("material_name", Value::text(""), "of its material"),
                {.name = "order",
                 .initial = Value::text(kOrders[0]),
                 .choices = kOrders,
                 .doc = "in which its meshes are drawn; `auto`: back to front where a slot blends `alpha` or "
                        "`premultiplied`, else `none`",
                 .ofMeshes = true}}};
  }

  static graph::ImportFacts facts(const graph::ImportRequest& request, const WorldFacts& world, Files&) {
    const scene::Selection list = selectionOf(request);
    const double count = world.spheresOf(list) + world.meshesOf(list);
    graph::ImportFacts facts{.exists = count > 0, .count = count};
    if (count == 0 && world.known) facts.problems.push_back(saysNothing(list, *world.scene));
    return facts;
  }

  explicit DrawListProvider(const graph::ImportRequest& request) : list_(selectionOf(request)) {}
  std::uint64_t generation(const Frame& frame) override {
    const scene::DrawList list = frame.tables.listOf(list_);
    return text::hashCombine(frame.tables.generation(list), frame.tables.meshFrame().generation(list));
  }
  bool isStill(const World& world) const override { return !scene::isMoving(world.scene()); }

 private:
  scene::Selection list_;
};

}  // namespace

scene::Selection selectionOf(const graph::ImportRequest& list) {
  scene::Selection selection;
  if (const auto of = scene::findDrawList(list.at("of").symbol)) selection = *of;
  selection.name = list.at("name").symbol;
  selection.tag = list.at("tag").symbol;
  selection.material = list.at("material_name").symbol;
  constexpr scene::MeshOrder kMeshOrders[] = {scene::MeshOrder::by_mesh, scene::MeshOrder::by_material,
                                              scene::MeshOrder::front_to_back,
                                              scene::MeshOrder::back_to_front};
  const auto order = std::ranges::find(kOrders, list.at("order").symbol) - kOrders.begin();
  if (order > 0) selection.order = kMeshOrders[order - 1];
  return selection;
}

scene::Selection drawListOf(const graph::ImportRequest& request) {
  if (const graph::ImportRequest* own = request.named("list")) return selectionOf(*own);
  return scene::findDrawList(request.at("list").symbol).value_or(scene::DrawList::spheres);
}

std::unique_ptr<Import> makeDrawList() {
  return std::make_unique<ImportOf<DrawListProvider>>();
}

}  // namespace weft::imports
