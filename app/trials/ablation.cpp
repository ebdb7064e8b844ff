#include "app/trials/ablation.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/output/standard_streams.h"
#include "app/session/session.h"
#include "app/trials/report_page.h"
#include "app/trials/work_lines.h"
#include "engine/base/counted.h"

namespace weft::app {

namespace {

// Declared names of the passes that run, each once, in order of the plan.
std::vector<std::string> passesOf(const graph::Plan& plan) {
  std::vector<std::string> names;
  for (const graph::Step& step : plan.steps)
    if (const std::string& name = plan.graph->specs[step.pass].declared;
        std::ranges::find(names, name) == names.end())
      names.push_back(name);
  return names;
}

std::string firstError(const base::Diagnostics& said) {
  for (const base::Diagnostic& each : said.items())
    if (each.severity == base::Severity::error) return each.message;
  return {};
}

}  // namespace

std::optional<AblationTable> ablatePasses(gl::Context& context, const Options& options, std::uint32_t repeats,
                                          const runtime::World& world, base::Diagnostics& diagnostics) {
  const std::uint32_t frame = options.lastFrame;
  const ShotWish wish{.frames = {frame}, .repeats = repeats};
  const auto whole = takeShot(context, options, world, wish, diagnostics);
  if (!whole) return std::nullopt;
  AblationTable table{.ms = whole->milliseconds,
                      .bytes = whole->plan->bytesAllocated,
                      .steps = whole->plan->steps.size(),
                      .picture = whole->pictures.at(frame),
                      .rows = {}};
  const auto passes = passesOf(*whole->plan);
  WorkLines lines(passes.size(), "passes");
  for (const std::string& pass : passes) {
    Ablation row{.pass = pass};
    if (const auto own = whole->passMilliseconds.find(pass); own != whole->passMilliseconds.end())
      row.ownMs = own->second;
    Options without = options;
    without.disables.emplace_back(pass);
    base::Diagnostics said;
    const bool software = context.device().software;
    const auto shot = makePlan(without, world.facts(), software, said)
                          ? takeShot(context, without, world, wish, said)
                          : std::nullopt;
    if (!shot) {
      row.needed = firstError(said);
    } else {
      row.savedMs = table.ms - shot->milliseconds;
      row.savedBytes =
          static_cast<std::int64_t>(table.bytes) - static_cast<std::int64_t>(shot->plan->bytesAllocated);
      row.stepsGone = table.steps - std::min(table.steps, shot->plan->steps.size());
      row.picture = shot->pictures.at(frame);
      row.map = assets::computeFlip(table.picture, row.picture);
      row.flip = assets::summarizeFlip(row.map);
    }
    table.rows.push_back(std::move(row));
    lines.countOne();
  }
  return table;
}

std::string ablationText(const AblationTable& table) {
  std::size_t width = 4;
  for (const Ablation& row : table.rows) width = std::max(width, row.pass.size());
  std::string text =
      fmt::format("{} run, {:.2f} ms, {} bytes\n\n{:{}}  {:>8}  {:>8}  {:>12}  {:>5}  {:>7}  {:>7}\n",
                  base::counted(table.steps, "pass"), table.ms, table.bytes, "pass", width, "own ms",
                  "saved ms", "saved bytes", "steps", "FLIP", "at most");
  for (const Ablation& row : table.rows)
    text += fmt::format("{:{}}  {:8.2f}  ", row.pass, width, row.ownMs) +
            (row.needed.empty() ? fmt::format("{:8.2f}  {:12}  {:5}  {:7.4f}  {:7.3f}\n", row.savedMs,
                                              row.savedBytes, row.stepsGone, row.flip.mean, row.flip.peak)
                                : fmt::format("{:>8}\n", "needed"));
  return text;
}

std::string ablationJson(const AblationTable& table) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const Ablation& row : table.rows) {
    nlohmann::ordered_json entry = {{"pass", row.pass}, {"own_ms", row.ownMs}};
    if (row.needed.empty())
      entry.update({{"saved_ms", row.savedMs},
                    {"saved_bytes", row.savedBytes},
                    {"steps_gone", row.stepsGone},
                    {"flip", row.flip.mean},
                    {"flip_peak", row.flip.peak}});
    else
      entry["needed"] = row.needed;
    rows.push_back(std::move(entry));
  }
  return dumpJson({{"steps", table.steps},
                   {"ms", table.ms},
                   {"bytes", table.bytes},
                   {"passes", std::move(rows)}}) +
         "\n";
}

std::string ablationPage(const AblationTable& table, const std::string& graph) {
  std::string page = pageHead("weft ablate");
  page += fmt::format("<h1>{}: what each pass costs and does</h1>\n<p>{} run, {:.2f} ms, {} bytes</p>\n{}\n",
                      escapeHtml(graph), base::counted(table.steps, "pass"), table.ms, table.bytes,
                      imageTag(table.picture, "the whole frame"));
  page +=
      "<table>\n<tr><th>pass</th><th>own ms</th><th>saved ms</th><th>saved "
      "bytes</th><th>steps</th><th>FLIP</th>"
      "<th>at most</th><th>without it</th><th>difference</th></tr>\n";
  for (const Ablation& row : table.rows) {
    page += fmt::format("<tr><td>{}</td><td>{:.2f}</td>", escapeHtml(row.pass), row.ownMs);
    page +=
        row.needed.empty()
            ? fmt::format(
                  "<td>{:.2f}</td><td>{}</td><td>{}</td><td>{:.4f}</td><td>{:.3f}</td><td>{}</td><td>{}</td>",
                  row.savedMs, row.savedBytes, row.stepsGone, row.flip.mean, row.flip.peak,
                  imageTag(row.picture, "without it"), imageTag(assets::colorFlip(row.map), "FLIP"))
            : fmt::format("<td colspan=\"7\">needed: {}</td>", escapeHtml(row.needed));
    page += "</tr>\n";
  }
  return page + "</table>\n</body></html>\n";
}

}  // namespace weft::app
