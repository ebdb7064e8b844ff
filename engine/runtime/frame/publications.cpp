#include "engine/runtime/frame/publications.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <unordered_map>
#include <utility>

#include "engine/graph/pick/pick.h"
#include "engine/text/hash.h"

namespace weft::runtime {

using graph::Cadence;
using graph::kNone;
using graph::ResourceKind;

namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

// Where the author wrote the name of `file`, or of the sequence that has it: the value of a parameter that is an argument of the
// import, such as that of --set; else the import itself.
text::Where placeOfFile(const graph::FlatGraph& graph, const graph::ImportSpec& import,
                        const std::string& file) {
  text::Where place = import.place;
  for (const auto& [name, value] : import.request.arguments)
    for (const graph::ParameterSpec& parameter : graph.parameters) {
      if (value.symbol.empty() || parameter.value != value || !text::isKnown(parameter.valuePlace)) continue;
      if (value.symbol == file) return parameter.valuePlace;
      if (parameter.desc.type == graph::ParameterDesc::Type::file) place = parameter.valuePlace;
    }
  return place;
}

}  // namespace

Publications::Publications(const graph::Plan& plan, ResourcePool& pool, Imports& imports,
                           FrameCadence& cadence, const std::vector<PreparedPass>& passes,
                           const Publications* before)
    : plan_(plan),
      pool_(pool),
      imports_(imports),
      cadence_(cadence),
      passes_(passes),
      ages_([this](std::uint32_t resource) { return ageOf(resource); }) {
  const std::size_t resources = plan.graph->resources.size();
  generations_.resize(resources);
  generationsBefore_.resize(resources);
  publishing_.assign(resources, 0);
  turned_.assign(resources, 0);
  for (std::size_t r = 0; r < resources; ++r) made_.push_back(plan.graph->resources[r].import != kNone);
  for (const PreparedPass& pass : passes)
    for (const std::uint32_t r : pass.written) made_[r] = 1;
  resetState_.assign(plan.graph->histories.size(), 0);
  for (std::uint64_t& generation : generations_) generation = nextGeneration_++;
  findPublishers();
  if (!before) return;
  framesRun_ = before->framesRun_;
  continueGenerations(*before);
  continueGroups();
  continueHistories(*before);
  continueImports(*before);
}

// An import that an `on_change` pass of a group reads is shown with what the group makes of it; a time-sliced
// group goes before others.
void Publications::findPublishers() {
  for (std::size_t step = 0; step < plan_.steps.size(); ++step) {
    const std::uint32_t group = plan_.groups.groupOf(plan_.steps[step].pass);
    if (group == kNone || plan_.passOf(step).cadence != Cadence::on_change) continue;
    for (const graph::FlatUse& use : plan_.usesOf(step)) {
      GpuResource& resource = pool_[use.resource];
      const bool import = plan_.graph->resources[use.resource].kind == ResourceKind::imported_texture;
      if (!import || use.history > 0) continue;
      if (resource.publisher == kNone ||
          (plan_.groups.sliced[group] && !plan_.groups.sliced[resource.publisher]))
        resource.publisher = group;
    }
  }
}

void Publications::beginFrame(const FrameInput& input) {
  input_ = input;
  std::fill(publishing_.begin(), publishing_.end(), std::uint8_t{0});
}

void Publications::publishFinished() {
  for (std::uint32_t group = 0; group < plan_.groups.sliced.size(); ++group) {
    if (!cadence_.isFinished(group)) continue;
    for (std::uint32_t r = 0; r < generations_.size(); ++r)
      if (pool_[r].group == group) publish(r);
    publishImports(group);
    cadence_.markPublished(group);
  }
}

void Publications::publish(std::uint32_t r) {
  GpuResource& resource = pool_[r];
  if (resource.copies > 1) resource.current = (resource.current + 1) % resource.copies;
  ++resource.publications;
  resource.publishedAt = firstHeadlessFrame() ? -kForever : input_.time;
  generations_[r] = nextGeneration_++;
}

void Publications::publishImports(std::uint32_t group) {
  for (std::size_t r = 0; r < generations_.size(); ++r)
    if (pool_[r].publisher == group) show(r);
}

void Publications::show(std::size_t r) {
  GpuResource& resource = pool_[r];
  auto held = imports_.of(importOf(r)).hold();
  if (held != resource.held) ++resource.shows;
  resource.held = std::move(held);
  resource.shown = resource.imported;
}

void Publications::refreshImports(text::Diagnostics& diagnostics) {
  for (std::size_t r = 0; r < generations_.size(); ++r) {
    const graph::FlatResource& desc = plan_.graph->resources[r];
    if (desc.import == kNone) continue;
    const graph::ImportSpec& import = importOf(r);
    if (desc.kind == ResourceKind::imported_texture) {
      text::Diagnostics said;
      pool_[r].imported = imports_.texture(import, said);
      for (text::Diagnostic each : said.items()) {
        if (each.place.line == 0 && import.place.file) {
          if (each.place.file && each.message.find(*each.place.file) == std::string::npos)
            each.message += " (" + *each.place.file + ")";
          each.place = placeOfFile(*plan_.graph, import, each.place.file ? *each.place.file : "");
        }
        if (each.resource.empty()) each.resource = plan_.graph->resourceNames[r];
        diagnostics.add(std::move(each));
      }
      if (pool_[r].publisher == kNone || !imports_.of(import).hold()) show(r);
    }
    generations_[r] = imports_.generation(import);
  }
}

// Of those that reset it.
std::uint64_t Publications::hashOfImports(const graph::HistorySpec& history) {
  std::uint64_t hash = text::kHashSeed;
  for (const std::uint32_t import : history.resetImports)
    hash = text::hashCombine(hash, imports_.generation(plan_.graph->imports[import]));
  return hash;
}

void Publications::resetHistories(text::Diagnostics& diagnostics) {
  const graph::FlatGraph& graph = *plan_.graph;
  for (std::size_t h = 0; h < graph.histories.size(); ++h) {
    const graph::HistorySpec& history = graph.histories[h];
    std::uint64_t state = text::kHashSeed;
    for (const std::uint32_t resource : history.resetResources)
      state = text::hashCombine(state, generations_[resource]);
    for (const graph::Value& value : history.resetValues)
      for (const double x : value.v) state = text::hashCombine(state, std::bit_cast<std::uint64_t>(x));
    state += hashOfImports(history);
    const bool changed = framesRun_ > 0 && state != resetState_[h];
    resetState_[h] = state;
    if (!changed) continue;
    pool_[history.resource].publications = 0;
    ++pool_[history.resource].resets;
    pool_.fill(plan_, history.resource, history.first, diagnostics);
  }
}

bool Publications::announce() {
  bool any = false;
  for (std::size_t step = 0; step < passes_.size(); ++step) {
    if (!cadence_.runs(step) || plan_.passOf(step).cadence == Cadence::always) continue;
    for (const std::uint32_t r : passes_[step].written)
      if (pool_[r].group == kNone) {
        publishing_[r] = 1;
        any = true;
      }
  }
  for (std::uint32_t group = 0; group < plan_.groups.sliced.size(); ++group) {
    if (plan_.groups.sliced[group]) continue;
    bool runs = false;
    for (std::size_t step = 0; step < passes_.size(); ++step)
      runs |= passes_[step].group == group && cadence_.runs(step);
    if (!runs) continue;
    publishImports(group);
    any = true;
  }
  return any;
}

void Publications::beginRound() {
  generationsBefore_ = generations_;
  std::fill(turned_.begin(), turned_.end(), std::uint8_t{0});
}

// The history of what a time-sliced group writes does not rotate here; it rotates when the group publishes.
void Publications::publishWritten(const PreparedPass& pass) {
  for (const std::uint32_t r : pass.written) {
    if (pool_[r].group != kNone) continue;
    if (std::exchange(turned_[r], std::uint8_t{1}) != 0)
      generations_[r] = nextGeneration_++;
    else
      publish(r);
  }
}

// A resource that is not published yet has the age 0, because it will be soon. In a headless run, which publishes everything
// before its frame 0, its age is infinite. A resource that no live pass writes is never published, so its age is infinite too.
double Publications::ageOf(std::uint32_t r) const {
  if (!made_[r]) return kForever;
  const GpuResource& resource = pool_[r];
  if (resource.publications == 0 || publishing_[r]) return firstHeadlessFrame() ? kForever : 0.0;
  return std::max(0.0, input_.time - resource.publishedAt);
}

void Publications::carry(StateStream& state, text::Diagnostics& diagnostics) {
  state.carry(framesRun_);
  state.carry(nextGeneration_);
  for (std::size_t r = 0; r < generations_.size(); ++r) {
    if (plan_.graph->resources[r].import == kNone) {
      state.carry(generations_[r]);
      continue;
    }
    const GpuResource& resource = pool_[r];
    bool shown = resource.shown.id == resource.imported.id;
    state.require(shown || resource.shown.id == 0);  // no older one
    state.carry(shown);
    if (state.loading() && shown) show(r);
  }
  for (std::size_t h = 0; h < resetState_.size(); ++h)
    state.carryFrom(hashOfImports(plan_.graph->histories[h]), resetState_[h]);
  pool_.carry(plan_, state, diagnostics);
}

// Generations go with storage: a resource that lies where it lay before holds what it held.
void Publications::continueGenerations(const Publications& before) {
  for (std::uint64_t& generation : generations_) generation += before.nextGeneration_;
  nextGeneration_ += before.nextGeneration_;
  for (std::size_t r = 0; r < generations_.size(); ++r)
    if (pool_[r].before != kNone) generations_[r] = before.generations_[pool_[r].before];
}

// A group counts as published when everything that it writes is.
void Publications::continueGroups() {
  std::vector<std::uint8_t> published(plan_.groups.sliced.begin(), plan_.groups.sliced.end());
  for (std::uint32_t r = 0; r < generations_.size(); ++r) {
    const GpuResource& resource = pool_[r];
    if (resource.group != kNone && plan_.firstStep[r] != kNone && resource.publications == 0)
      published[resource.group] = 0;
  }
  for (std::uint32_t group = 0; group < published.size(); ++group)
    if (published[group]) cadence_.restorePublished(group);
}

void Publications::continueHistories(const Publications& before) {
  const graph::FlatGraph &mine = *plan_.graph, &theirs = *before.plan_.graph;
  std::unordered_map<std::string_view, std::size_t> historyOf;
  for (std::size_t h = 0; h < before.resetState_.size(); ++h)
    historyOf[theirs.resourceNames[theirs.histories[h].resource]] = h;
  for (std::size_t h = 0; h < resetState_.size(); ++h)
    if (const auto old = historyOf.find(mine.resourceNames[mine.histories[h].resource]);
        old != historyOf.end())
      resetState_[h] = before.resetState_[old->second];
}

// An import shows what it showed; one that has taken the place of a texture, that texture.
void Publications::continueImports(const Publications& before) {
  const graph::FlatGraph &graph = *plan_.graph, &theirs = *before.plan_.graph;
  for (std::size_t r = 0; r < graph.resources.size(); ++r) {
    if (graph.resources[r].kind != ResourceKind::imported_texture) continue;
    GpuResource& mine = pool_[r];
    const graph::ImportSpec& import = importOf(r);
    for (std::size_t old = 0; old < theirs.resources.size(); ++old) {
      if (theirs.resources[old].import == kNone || before.importOf(old).key != import.key) continue;
      const GpuResource& theirsOf = before.pool_[old];
      mine.shown = theirsOf.shown;
      mine.held = theirsOf.held;
      mine.shows = theirsOf.shows;
    }
    for (const std::string& name : import.standIns) {
      const std::uint32_t old = lastVersionOf(before.plan_, name);
      if (old == kNone || lastVersionOf(plan_, name) != kNone) continue;
      const GpuResource& stoodIn = before.pool_[old];
      if (!stoodIn.texture || stoodIn.publications == 0) continue;
      const gl::Texture& texture = stoodIn.texture->texture(stoodIn.copyOf(0));
      mine.held = std::shared_ptr<const gl::Texture>(stoodIn.texture, &texture);
      mine.shown = texture.ref();
      break;
    }
  }
}

std::uint32_t lastVersionOf(const graph::Plan& plan, std::string_view name) {
  std::uint32_t found = kNone;
  const auto& names = plan.graph->resourceNames;
  for (std::uint32_t r = 0; r < names.size(); ++r)
    if ((names[r] == name || graph::sharedName(names[r]) == name) && plan.firstStep[r] != kNone) found = r;
  return found;
}

}  // namespace weft::runtime
