// What follows from publications: which variant of a pass a frame takes, and which of its textures an import
// shows.
#include <algorithm>
#include <utility>

#include "engine/runtime/frame/execution.h"
#include "engine/runtime/prepare/program_check.h"
#include "engine/runtime/prepare/program_request.h"

namespace weft::runtime {

using graph::Cadence;
using graph::kNone;

// An import that an `on_change` pass of a job reads is shown with what the job makes of it; a spread job
// before others.
void Execution::findMakers() {
  const graph::FlatGraph& graph = *plan_->graph;
  for (const graph::Step& step : plan_->steps) {
    const graph::FlatPass& pass = graph.passes[step.pass];
    const std::uint32_t job = plan_->jobs.jobOf(step.pass);
    if (job == kNone || pass.cadence != Cadence::on_change) continue;
    for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u) {
      const graph::FlatUse& use = graph.uses[u];
      GpuResource& resource = (*pool_)[use.resource];
      const bool import = graph.resources[use.resource].kind == graph::ResourceKind::imported_texture;
      if (!import || use.history > 0) continue;
      if (resource.maker == kNone || (plan_->jobs.spread[job] && !plan_->jobs.spread[resource.maker]))
        resource.maker = job;
    }
  }
}

void Execution::viewImports(base::Diagnostics& diagnostics) {
  const graph::FlatGraph& graph = *plan_->graph;
  for (std::size_t r = 0; r < graph.resources.size(); ++r) {
    if (graph.resources[r].kind != graph::ResourceKind::imported_texture) continue;
    const graph::ImportSpec& import = graph.imports[graph.resources[r].import];
    (*pool_)[r].shown = device_.imports.shown(import, diagnostics);
    (*pool_)[r].before = device_.imports.before(import, diagnostics);
  }
}

void Execution::publishImports(std::uint32_t job) {
  const graph::FlatGraph& graph = *plan_->graph;
  for (std::size_t r = 0; r < graph.resources.size(); ++r)
    if ((*pool_)[r].maker == job) device_.imports.publish(graph.imports[graph.resources[r].import]);
}

// What was shown before is kept while a pass that may run reads it.
void Execution::releaseImports() {
  const graph::FlatGraph& graph = *plan_->graph;
  for (std::size_t r = 0; r < graph.resources.size(); ++r) {
    if (graph.resources[r].kind != graph::ResourceKind::imported_texture) continue;
    const bool read = std::ranges::any_of(passes_, [&](const PreparedPass& pass) {
      return std::ranges::any_of(pass.textures, [&](const TextureBinding& binding) {
        return binding.resource == r && binding.history > 0;
      });
    });
    if (!read) device_.imports.releaseBefore(graph.imports[graph.resources[r].import]);
  }
}

// While a variant that age() chose for a time reads what a resource held before, the resource is not
// published again: the picture would jump. What would publish it waits.
void Execution::holdFading() {
  std::vector<std::uint8_t>& held = cadence_->held();
  std::fill(held.begin(), held.end(), std::uint8_t{0});
  const graph::FlatGraph& graph = *plan_->graph;
  const auto hold = [&](std::uint32_t r) {
    const GpuResource& resource = (*pool_)[r];
    const std::uint32_t import = graph.resources[r].import;
    const bool shown =
        import == kNone ? resource.publications > 0 : device_.imports.publications(graph.imports[import]) > 0;
    if (!shown) return;
    for (std::size_t step = 0; step < passes_.size(); ++step) {
      const PreparedPass& pass = passes_[step];
      if (graph.passes[plan_->steps[step].pass].cadence == Cadence::always) continue;
      held[step] |= import == kNone ? std::ranges::find(pass.written, r) != pass.written.end()
                                    : pass.job != kNone && pass.job == resource.maker;
    }
  };
  for (const PreparedPass& pass : passes_) {
    if (!pass.passing) continue;
    for (const TextureBinding& binding : pass.textures)
      if (binding.history > 0) hold(binding.resource);
    for (const ImageBinding& binding : pass.images)
      if (binding.history > 0) hold(binding.resource);
    for (const BufferBinding& binding : pass.buffers)
      if (binding.history > 0) hold(binding.resource);
  }
}

// Where an import has taken the place of a texture that stood in for it: that texture is what was shown.
void Execution::adoptStandIns(Execution& before) {
  const graph::FlatGraph& graph = *plan_->graph;
  for (const graph::FlatResource& mine : graph.resources) {
    if (mine.kind != graph::ResourceKind::imported_texture) continue;
    const graph::ImportSpec& import = graph.imports[mine.import];
    for (const std::string& name : import.standIns) {
      const std::uint32_t old = before.lastVersionOf(name);
      if (old == kNone || lastVersionOf(name) != kNone) continue;
      GpuResource& stoodIn = (*before.pool_)[old];
      if (!stoodIn.texture || stoodIn.publications == 0) continue;
      device_.imports.adopt(import, stoodIn.texture->take(stoodIn.copyOf(0)),
                            stoodIn.copies > 1 ? stoodIn.texture->take(stoodIn.copyOf(1)) : gl::Texture{});
      break;
    }
  }
}

// Passes that are not `always` and publish in this frame: what else the frame shows is of age 0 already.
void Execution::followWhole(base::Diagnostics& diagnostics) {
  bool any = false;
  for (std::size_t step = 0; step < passes_.size(); ++step) {
    const PreparedPass& pass = passes_[step];
    if (!cadence_->runs(step) || plan_->graph->passes[plan_->steps[step].pass].cadence == Cadence::always)
      continue;
    for (const std::uint32_t r : pass.written)
      if ((*pool_)[r].job == kNone) {
        publishing_[r] = 1;
        any = true;
      }
  }
  for (std::uint32_t job = 0; job < plan_->jobs.spread.size(); ++job) {
    if (plan_->jobs.spread[job]) continue;
    const auto runs = [&](const PreparedPass& pass) {
      return pass.job == job && cadence_->runs(static_cast<std::size_t>(&pass - passes_.data()));
    };
    if (std::ranges::none_of(passes_, runs)) continue;
    publishImports(job);
    any = true;
  }
  if (!any) return;
  viewImports(diagnostics);
  choosePasses(true, diagnostics);
  refreshUniforms(true);
}

void Execution::choosePasses(bool alwaysOnly, base::Diagnostics& diagnostics) {
  bool more = false;
  for (std::size_t step = 0; step < passes_.size(); ++step) {
    const PreparedPass& pass = passes_[step];
    const bool always = plan_->graph->passes[plan_->steps[step].pass].cadence == Cadence::always;
    if (!pass.conditional || (alwaysOnly && !always)) continue;
    const std::uint32_t conditions =
        conditionsOf(*pass.context.spec, [this](std::uint32_t resource) { return ageOf(resource); });
    if (conditions != pass.conditions) more |= choosePass(step, conditions, diagnostics);
  }
  if (!more) return;
  layoutUniforms(diagnostics);
  refreshUniforms(false);
}

// True when the variant was prepared now. One that does not compile is told once, and the pass stays as it
// is.
bool Execution::choosePass(std::size_t step, std::uint32_t conditions, base::Diagnostics& diagnostics) {
  for (Parked& parked : parked_) {
    if (parked.step != step || parked.pass.conditions != conditions) continue;
    if (parked.pass.usable) std::swap(passes_[step], parked.pass);
    return false;
  }
  const std::uint32_t pass = plan_->steps[step].pass;
  const graph::PassType type = passes_[step].type->reflect();
  PrepareContext context = prepareContext(diagnostics);
  context.conditions = conditions;
  context.variant =
      device_.programs.get(programRequestOf(*plan_->graph, *plan_, pass, type, conditions), diagnostics);
  PreparedPass made;
  if (context.variant &&
      checkProgram(*plan_, pass, *context.variant, device_.context.device().limits, diagnostics))
    made = preparePass(context, step);
  made.conditions = conditions;
  std::copy_n(passes_[step].context.maxGroups, 3, made.context.maxGroups);
  parked_.push_back({step, std::move(made)});
  if (!parked_.back().pass.usable) return false;
  std::swap(passes_[step], parked_.back().pass);
  return true;
}

}  // namespace weft::runtime
