// What the viewer asks before it writes, and before it closes with changes that are in no file. Declared in panels.h.

#include <algorithm>

#include "app/output/standard_streams.h"
#include "app/ui/panels.h"
#include "engine/text/chars.h"
#include "engine/text/printable.h"

namespace weft::app::ui {

namespace {

const ImVec4 kOld{1, 0.55f, 0.5f, 1}, kNew{0.6f, 1, 0.6f, 1};

// The lines that differ. The edits of a write are small and keep the order of lines.
void drawDifference(const graph::WriteBack::File& file) {
  const std::vector<std::string> before = text::linesOf(file.before), after = text::linesOf(file.after);
  std::size_t a = 0, b = 0;
  while (a < before.size() || b < after.size()) {
    if (a < before.size() && b < after.size() && before[a] == after[b]) {
      ++a;
      ++b;
      continue;
    }
    // As few lines as lead to one that both have.
    std::size_t gone = 0, come = 0;
    for (std::size_t far = 1; gone + come == 0; ++far)
      for (std::size_t k = 0; k <= far && gone + come == 0; ++k) {
        const std::size_t x = a + k, y = b + far - k;
        const bool ends = x >= before.size() && y >= after.size();
        if (ends || (x < before.size() && y < after.size() && before[x] == after[y])) {
          gone = std::min(k, before.size() - a);
          come = std::min(far - k, after.size() - b);
        }
      }
    for (; gone > 0; --gone) ImGui::TextColored(kOld, "- %s", before[a++].c_str());
    for (; come > 0; --come) ImGui::TextColored(kNew, "+ %s", after[b++].c_str());
  }
}

}  // namespace

std::string Panels::writeBack(text::Diagnostics& diagnostics) {
  if (question_ != Question::write) {
    writes_ = live_.planWrites(diagnostics);
    if (!writes_) return "nothing can be written: see the messages";
    if (writes_->files.empty() && live_.unsaved() == 0) return "the files say so already";
    question_ = Question::write;
    return "";
  }
  question_ = Question::none;
  if (!writes_ || !live_.write(*writes_, diagnostics)) return "nothing was written: see the messages";
  std::string said = "wrote";
  for (const graph::WriteBack::File& file : writes_->files) said += " " + file.path;
  printNow(text::printable(said) + "\n");
  return said + "; Ctrl Z takes it back";
}

void Panels::drawWrites(text::Diagnostics& diagnostics) {
  bool wefts = false;
  ImGui::BeginChild("files", {0, -2.5f * ImGui::GetFrameHeightWithSpacing()}, false,
                    ImGuiWindowFlags_HorizontalScrollbar);
  for (const graph::WriteBack::File& file : writes_->files) {
    const bool own = LiveGraph::isWefts(file.path);
    wefts |= own;
    ImGui::TextUnformatted(file.path.c_str());
    if (own) ImGui::TextColored(kOld, "is Weft's own: save a preset");
    drawDifference(file);
  }
  ImGui::EndChild();
  ImGui::SetNextItemWidth(14 * em_);
  ImGui::InputTextWithHint("##preset", "name of a new preset", preset_, sizeof preset_);
  ImGui::SameLine();
  ImGui::BeginDisabled(preset_[0] == 0);
  if (ImGui::Button("Save as preset")) {
    if (const auto file = live_.savePreset(preset_, diagnostics))
      printNow(text::printable("wrote " + *file) + "\n");
    question_ = Question::none;
  }
  ImGui::EndDisabled();
  ImGui::BeginDisabled(wefts || writes_->files.empty());
  if (ImGui::Button("Write into these files (F8)")) act_("write_back");
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (ImGui::Button("Back (Esc)")) question_ = Question::none;
}

void Panels::drawOpen(const LoopState& state) {
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  if (ImGui::InputTextWithHint("##file", "a graph, scene, model, environment or preset", file_, sizeof file_,
                               ImGuiInputTextFlags_EnterReturnsTrue))
    chosen_ = file_;
  const bool leaves = ImGui::IsItemDeactivated() && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
  ImGui::BeginChild("recent", {0, -ImGui::GetFrameHeightWithSpacing()});
  for (const std::string& file : state.recent)
    if (ImGui::Selectable(file.c_str())) chosen_ = file;
  ImGui::EndChild();
  if (ImGui::Button("Back (Esc)") || leaves || !chosen_.empty()) question_ = Question::none;
}

void Panels::drawQuestion(const LoopState& state, text::Diagnostics& diagnostics) {
  if (question_ == Question::none) return;
  const bool write = question_ == Question::write, open = question_ == Question::open;
  const float width = std::min(60 * em_, width_ - em_), height = std::min((write  ? 30
                                                                           : open ? 20
                                                                                  : 7) *
                                                                              em_,
                                                                          height_ - em_);
  ImGui::SetNextWindowPos({width_ / 2, height_ / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({width, height});
  ImGui::Begin(write  ? "Write into the files"
               : open ? "Open"
                      : "Close",
               nullptr,
               ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                   ImGuiWindowFlags_NoSavedSettings);
  if (write) {
    drawWrites(diagnostics);
  } else if (open) {
    drawOpen(state);
  } else {
    ImGui::TextWrapped("%s",
                       fmt::format("{} made here {} in no file.", text::counted(live_.unsaved(), "change"),
                                   live_.unsaved() == 1 ? "is" : "are")
                           .c_str());
    if (ImGui::Button("Look at what would be written (F8)")) act_("write_back");
    ImGui::SameLine();
    if (ImGui::Button("Close without them (Shift Esc)")) act_("close_at_once");
    ImGui::SameLine();
    if (ImGui::Button("Stay (Esc)")) question_ = Question::none;
  }
  ImGui::End();
}

}  // namespace weft::app::ui
