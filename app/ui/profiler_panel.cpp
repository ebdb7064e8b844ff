// The last frames as stacked bars, one color per pass; the passes by their median time below.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "app/ui/panels.h"
#include "engine/text/hash.h"

namespace weft::app::ui {

namespace {

ImU32 colorOf(const std::string& name) {
  const std::uint64_t hash = text::hashBytes(name, text::kHashSeed);
  return ImColor::HSV(static_cast<float>(hash % 997) / 997.0f, 0.55f,
                      0.65f + static_cast<float>(hash / 997 % 3) * 0.12f);
}

double timeOf(const gl::PassTime& time, bool gpu) {
  return !time.ran ? 0 : gpu ? time.gpu : time.cpu;
}

double totalOf(const runtime::FrameProfile& profile, bool gpu) {
  double total = 0;
  for (const gl::PassTime& time : profile.passes) total += timeOf(time, gpu);
  return total;
}

struct Median {
  std::vector<double> gpu, cpu;  // of the frames in which the pass ran, of the last kAveraged
};

// The slowest first.
std::vector<std::pair<std::string, std::pair<double, double>>> mediansOf(
    const std::deque<runtime::FrameProfile>& history, bool gpu) {
  std::map<std::string, Median> byName;
  for (std::size_t f = history.size() - std::min(runtime::FrameProfiler::kAveraged, history.size());
       f < history.size(); ++f)
    for (std::size_t step = 0; step < history[f].passes.size() && step < history[f].names->size(); ++step) {
      if (!history[f].passes[step].ran) continue;
      Median& median = byName[(*history[f].names)[step]];
      median.gpu.push_back(history[f].passes[step].gpu);
      median.cpu.push_back(history[f].passes[step].cpu);
    }
  std::vector<std::pair<std::string, std::pair<double, double>>> medians;
  for (const auto& [name, times] : byName)
    medians.emplace_back(name, std::pair(runtime::FrameProfiler::medianOf(times.gpu),
                                         runtime::FrameProfiler::medianOf(times.cpu)));
  std::ranges::stable_sort(medians, std::greater(),
                           [&](const auto& named) { return gpu ? named.second.first : named.second.second; });
  return medians;
}

}  // namespace

void Panels::drawProfiler() {
  const auto& history = profiler_.history();
  const bool measure = measureBox();
  ImGui::SameLine();
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 5);
  ImGui::Combo("##kind", &stacked_, "GPU\0CPU\0");
  const bool gpu = stacked_ == 0;
  if (history.empty()) return;
  const runtime::FrameProfile& last = history.back();
  ImGui::TextDisabled(
      "%s", fmt::format("frame {:.2f} ms{}", last.ms,
                        last.passes.empty() ? std::string()
                                            : fmt::format(", passes: GPU {:.2f} ms, CPU {:.2f} ms",
                                                          totalOf(last, true), totalOf(last, false)))
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
  for (const auto& profile : history) totals.push_back(std::max(profile.ms, totalOf(profile, gpu)));
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
      const double time = timeOf(profile.passes[step], gpu);
      if (time <= 0) continue;
      draw.AddRectFilled({left, level(sum + time)}, {right, level(sum)}, colorOf((*profile.names)[step]));
      sum += time;
    }
  }
  draw.AddText({corner.x + 4, corner.y + 2}, IM_COL32(230, 230, 230, 255),
               fmt::format("{:.1f} ms", highest).c_str());

  if (!measure) return;
  if (!beginTable("means", {"median of the last 30 frames in which it ran", "GPU ms", "CPU ms"}, 0,
                  ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg))
    return;
  for (const auto& [name, median] : mediansOf(history, gpu)) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, colorOf(name));
    ImGui::Bullet();
    ImGui::PopStyleColor();
    ImGui::TextUnformatted(name.c_str());
    cell(fmt::format("{:7.2f}", median.first));
    cell(fmt::format("{:7.2f}", median.second));
  }
  ImGui::EndTable();
}

}  // namespace weft::app::ui
