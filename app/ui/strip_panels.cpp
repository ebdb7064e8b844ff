// The tabs of the strip below the picture. Declared in panels.h.
#include <algorithm>
#include <cmath>
#include <span>

#include "app/ui/panels.h"
#include "engine/graph/language/names.h"
#include "engine/text/hash.h"

namespace weft::app::ui {

namespace {

// ---- times: the last frames as stacked bars, one color per pass; the passes by their median time below ----

// A color that a name has wherever it is drawn.
ImU32 colorOf(const std::string& name, float saturation, float value) {
  return ImColor::HSV(static_cast<float>(text::hashBytes(name, text::kHashSeed) % 997) / 997.0f, saturation,
                      value);
}

double totalOf(const runtime::FrameProfile& profile, double gl::PassTime::*time) {
  double total = 0;
  for (const gl::PassTime& pass : profile.passes) total += pass.ran ? pass.*time : 0;
  return total;
}

struct PassMedian {
  std::string name;
  double gpu = 0, cpu = 0;
};

// The slowest first.
std::vector<PassMedian> mediansOf(const std::deque<runtime::FrameProfile>& history, bool gpu) {
  std::map<std::string, std::pair<std::vector<double>, std::vector<double>>> byName;
  for (std::size_t f = history.size() - std::min(runtime::FrameProfiler::kAveraged, history.size());
       f < history.size(); ++f)
    for (std::size_t step = 0; step < history[f].passes.size() && step < history[f].names->size(); ++step) {
      const gl::PassTime& time = history[f].passes[step];
      if (!time.ran) continue;
      auto& [gpuTimes, cpuTimes] = byName[(*history[f].names)[step]];
      gpuTimes.push_back(time.gpu);
      cpuTimes.push_back(time.cpu);
    }
  std::vector<PassMedian> medians;
  for (const auto& [name, times] : byName)
    medians.push_back({name, runtime::FrameProfiler::medianOf(times.first),
                       runtime::FrameProfiler::medianOf(times.second)});
  std::ranges::stable_sort(medians, std::greater(), gpu ? &PassMedian::gpu : &PassMedian::cpu);
  return medians;
}

// ---- storage: which physical texture, or which bytes of the arena, hold which resource over the steps of the frame ----

std::string bytesText(std::uint64_t bytes) {
  if (bytes >= 1 << 20) return fmt::format("{:.1f} MiB", static_cast<double>(bytes) / (1 << 20));
  if (bytes >= 1 << 10) return fmt::format("{:.1f} KiB", static_cast<double>(bytes) / (1 << 10));
  return fmt::format("{} B", bytes);
}

struct Row {
  std::string name, bytes;
  std::vector<std::uint32_t> resources;
};

std::vector<Row> rowsOf(const graph::Plan& plan) {
  std::vector<Row> rows;
  for (const graph::Storage& storage : plan.storages)
    rows.push_back(
        {storage.copies > 1 ? fmt::format(", {} copies", storage.copies) : "", bytesText(storage.bytes), {}});
  for (std::uint32_t r = 0; r < plan.graph->resources.size(); ++r) {
    if (plan.firstStep[r] == graph::kNone) continue;
    if (plan.storageOf[r] != graph::kNone) {
      Row& row = rows[plan.storageOf[r]];
      const std::string shape = graph::shapeText(plan.graph->resources[r]);  // ends with ", 4096 bytes"
      if (row.resources.empty()) row.name.insert(0, shape, 0, shape.rfind(','));
      row.resources.push_back(r);
    } else if (plan.graph->resources[r].kind == graph::ResourceKind::buffer) {
      const bool transient = plan.bufferOffsetOf[r] != graph::Plan::kNoOffset;
      rows.push_back({transient ? fmt::format("arena + {}", plan.bufferOffsetOf[r]) : "buffer of its own",
                      bytesText(plan.graph->resources[r].bytes),
                      {r}});
    }
  }
  return rows;
}

// ---- histogram: what the graph puts out, and the presented picture ----

// A bar for each bin. The tallest of all but the ends, which may hold a whole sky, is as high as the plot.
void drawBars(const char* name, std::span<const float> bins, ImU32 color, float share) {
  const float highest = std::max(1e-4f, std::ranges::max(bins.subspan(1, bins.size() - 2)));
  const ImVec2 room = ImGui::GetContentRegionAvail();
  ImGui::PushStyleColor(ImGuiCol_PlotHistogram, color);
  ImGui::PushID(name);
  ImGui::PlotHistogram("##bins", bins.data(), static_cast<int>(bins.size()), 0, name, 0, highest,
                       {room.x, std::max(32.0f, room.y * share)});
  ImGui::PopID();
  ImGui::PopStyleColor();
}

// The outputs of the graph that have arrived: a few numbers as a line, more as bars.
void drawOutputs(runtime::Execution& execution) {
  constexpr std::size_t kOfLine = 8, kMost = 4096;
  execution.readBack().collect();
  for (const runtime::Output& output : execution.readBack().outputs()) {
    std::vector<float> numbers(output.arrived ? std::min(output.count(), kMost) : 0);
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<float>(output.number(i));
    if (numbers.size() > kOfLine)
      drawBars(output.name.c_str(), numbers, IM_COL32(235, 235, 235, 170), 0.4f);
    else if (!numbers.empty())
      ImGui::TextDisabled("%s", fmt::format("{}: {:.3g}", output.name, fmt::join(numbers, ", ")).c_str());
  }
}

}  // namespace

void Panels::drawProfiler() {
  const auto& history = profiler_.history();
  const bool measure = measureBox();
  ImGui::SameLine();
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 5);
  ImGui::Combo("##kind", &stacked_, "GPU\0CPU\0");
  const bool gpu = stacked_ == 0;
  const auto time = gpu ? &gl::PassTime::gpu : &gl::PassTime::cpu;
  if (history.empty()) return;
  const runtime::FrameProfile& last = history.back();
  ImGui::TextDisabled("%s",
                      fmt::format("frame {:.2f} ms{}", last.ms,
                                  last.passes.empty() ? std::string()
                                                      : fmt::format(", passes: GPU {:.2f} ms, CPU {:.2f} ms",
                                                                    totalOf(last, &gl::PassTime::gpu),
                                                                    totalOf(last, &gl::PassTime::cpu)))
                          .c_str());

  const float em = ImGui::GetFontSize();
  const ImVec2 area(std::max(32.0f, ImGui::GetContentRegionAvail().x),
                    std::max(3 * em, ImGui::GetContentRegionAvail().y * 0.45f));
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("history", area);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(corner, {corner.x + area.x, corner.y + area.y}, IM_COL32(20, 20, 24, 255));
  // A few frames that took much longer (the first, a reload) may stand out of the picture.
  std::vector<double> totals;
  for (const auto& profile : history) totals.push_back(std::max(profile.ms, totalOf(profile, time)));
  std::ranges::sort(totals);
  const double highest = std::max(1e-3, totals[(totals.size() - 1) * 19 / 20] * 1.25);
  const float bar = area.x / 240.0f;
  for (std::size_t f = 0; f < history.size(); ++f) {
    const runtime::FrameProfile& profile = history[f];
    const float right = corner.x + area.x - bar * static_cast<float>(history.size() - 1 - f),
                left = right - bar;
    const auto level = [&](double ms) {
      return corner.y + area.y * (1 - static_cast<float>(std::min(1.0, ms / highest)));
    };
    draw.AddRectFilled({left, level(profile.ms)}, {right, corner.y + area.y}, IM_COL32(60, 60, 68, 255));
    double sum = 0;
    for (std::size_t step = 0; step < profile.passes.size() && step < profile.names->size(); ++step) {
      const double ms = profile.passes[step].ran ? profile.passes[step].*time : 0;
      if (ms <= 0) continue;
      draw.AddRectFilled({left, level(sum + ms)}, {right, level(sum)},
                         colorOf((*profile.names)[step], 0.55f, 0.7f));
      sum += ms;
    }
  }
  draw.AddText({corner.x + 4, corner.y + 2}, IM_COL32(230, 230, 230, 255),
               fmt::format("{:.1f} ms", highest).c_str());

  if (!measure) return;
  if (!beginTable("means", {"median of the last 30 frames in which it ran", "GPU ms", "CPU ms"}, 0,
                  ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg))
    return;
  for (const PassMedian& median : mediansOf(history, gpu)) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, colorOf(median.name, 0.55f, 0.7f));
    ImGui::Bullet();
    ImGui::PopStyleColor();
    ImGui::TextUnformatted(median.name.c_str());
    cell(fmt::format("{:7.2f}", median.gpu));
    cell(fmt::format("{:7.2f}", median.cpu));
  }
  ImGui::EndTable();
}

void Panels::drawStorage() {
  const graph::Plan& plan = renderer_.execution()->plan();
  const graph::FlatGraph& graph = *plan.graph;
  ImGui::PushTextWrapPos(0);
  ImGui::TextDisabled("%s in %zu textures; each resource by itself: %s; the least possible: %s",
                      bytesText(plan.bytesAllocated).c_str(), plan.storages.size(),
                      bytesText(plan.bytesDeclared).c_str(), bytesText(plan.bytesLowerBound).c_str());
  ImGui::PopTextWrapPos();
  if (!beginTable("storage", {"storage", "bytes", "steps of the frame"}, 2,
                  ImGuiTableFlags_ScrollY | ImGuiTableFlags_BordersInnerV))
    return;
  const float line = ImGui::GetTextLineHeight();
  const auto steps = static_cast<float>(std::max<std::size_t>(1, plan.steps.size()));
  int id = 0;
  for (const Row& row : rowsOf(plan)) {
    ImGui::TableNextRow();
    cell(row.name);
    cell(row.bytes);
    ImGui::TableNextColumn();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = std::max(16.0f, ImGui::GetContentRegionAvail().x);
    ImGui::PushID(id++);
    ImGui::InvisibleButton("bar", {width, line});
    ImGui::PopID();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(corner, {corner.x + width, corner.y + line}, IM_COL32(30, 30, 36, 255));
    for (const std::uint32_t r : row.resources) {
      const std::string& name = graph.resourceNames[r];
      const std::uint32_t last =
          std::min(plan.lastStep[r], static_cast<std::uint32_t>(plan.steps.size()) - 1);
      // What persists holds its contents for the whole frame; its uses stand out.
      const bool kept = plan.persistent[r] != 0;
      const ImVec2 from(corner.x + width * static_cast<float>(plan.firstStep[r]) / steps, corner.y + 1);
      const ImVec2 to(corner.x + width * static_cast<float>(last + 1) / steps - 1, corner.y + line - 1);
      if (kept)
        draw.AddRectFilled({corner.x, corner.y + 1}, {corner.x + width, corner.y + line - 1},
                           colorOf(name, 0.4f, 0.35f));
      draw.AddRectFilled(from, to, colorOf(name, 0.5f, 0.6f));
      if (ImGui::CalcTextSize(name.c_str()).x + 4 <= to.x - from.x)
        draw.AddText({from.x + 3, from.y - 1}, IM_COL32(255, 255, 255, 255), name.c_str());
      const ImVec2 mouse = ImGui::GetIO().MousePos;
      if (!ImGui::IsItemHovered() || mouse.x < (kept ? corner.x : from.x) ||
          mouse.x > (kept ? corner.x + width : to.x))
        continue;
      const auto passName = [&](std::uint32_t step) { return graph.passNames[plan.steps[step].pass]; };
      tooltip(fmt::format("{}: {}\nfrom step {} ({}) to step {} ({})\n{}", name,
                          bytesText(graph.resources[r].bytes), plan.firstStep[r],
                          passName(std::min(plan.firstStep[r], last)), last, passName(last),
                          explainer_->whyStorage(r)));
    }
  }
  ImGui::EndTable();
}

void Panels::drawHistogram() {
  drawOutputs(*renderer_.execution());
  // Again after a while, so that a picture at rest has its own; in idle mode that is drawn for longer.
  if (ImGui::GetTime() - counted_ > 0.1) {
    const auto image = renderer_.readPresented8();
    const std::size_t texels = image ? image->texels.size() / 4 : 0, every = texels / 40'000 + 1;
    for (auto& bins : bins_) bins.fill(0);
    for (std::size_t i = 0; i < texels; i += every) {
      const std::uint8_t* const texel = &image->texels[4 * i];
      for (std::size_t c = 0; c < 3; ++c) ++bins_[c][texel[c]];
      ++bins_[3][static_cast<std::size_t>(0.2126 * texel[0] + 0.7152 * texel[1] + 0.0722 * texel[2] + 0.5)];
    }
    counted_ = ImGui::GetTime();
  }
  ImGui::TextDisabled("the picture as presented, 8-bit values");
  static constexpr const char* kNames[] = {"red", "green", "blue", "luminance"};
  static constexpr ImU32 kColors[] = {IM_COL32(220, 60, 60, 255), IM_COL32(60, 200, 80, 255),
                                      IM_COL32(70, 110, 240, 255), IM_COL32(235, 235, 235, 255)};
  for (std::size_t c = 0; c < 4; ++c)
    drawBars(kNames[c], bins_[c], kColors[c], 1 / static_cast<float>(4 - c));
}

}  // namespace weft::app::ui
