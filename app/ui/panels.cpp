#include "app/ui/panels.h"

#include <algorithm>

#include "app/output/standard_streams.h"
#include "engine/text/printable.h"

namespace weft::app::ui {

namespace {

constexpr std::array<const char*, 6> kNames = {"parameters", "passes",  "inspector",
                                               "profiler",   "storage", "histogram"};
constexpr std::array<const char*, 6> kTitles = {"Parameters",     "Passes",  "Texture inspector",
                                                "Frame profiler", "Storage", "Histogram"};

}  // namespace

void tooltip(const std::string& text) {
  tooltip(text, ImGui::IsItemHovered());
}

void tooltip(const std::string& text, bool hovered) {
  if (!hovered || text.empty()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 30);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool beginTable(const char* id, std::initializer_list<const char*> titles, int stretched,
                ImGuiTableFlags flags) {
  if (!ImGui::BeginTable(id, static_cast<int>(titles.size()), flags | ImGuiTableFlags_SizingFixedFit))
    return false;
  ImGui::TableSetupScrollFreeze(0, 1);
  for (const char* title : titles)
    ImGui::TableSetupColumn(title, stretched-- == 0 ? ImGuiTableColumnFlags_WidthStretch : 0);
  ImGui::TableHeadersRow();
  return true;
}

void cell(const std::string& text) {
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(text.c_str());
}

Panels::Panels(LiveGraph& live, runtime::Renderer& renderer, Log& log)
    : live_(live),
      renderer_(renderer),
      log_(log),
      profiler_(renderer.device().timers),
      inspector_(renderer) {}

Panels::~Panels() {
  inspector_.release();
}

bool Panels::toggle(std::string_view panel) {
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (panel == kNames[i]) {
      open_[i] = !open_[i] || !visible;
      latest_ = static_cast<Panel>(i);
      visible = true;
      arrange_ = true;
      return true;
    }
  return false;
}

std::vector<std::string> Panels::names() {
  return {kNames.begin(), kNames.end()};
}

void Panels::beforeFrame() {
  inspector_.beforeFrame(visible && open_[kInspector]);
  profiler_.begin();
}

void Panels::afterFrame() {
  if (!renderer_.execution()) return;
  profiler_.end(renderer_.execution()->plan());
  if (visible && open_[kHistogram]) histogram_.update(renderer_.execution()->presented());
}

void Panels::draw(const runtime::FrameReport& report, text::Diagnostics& diagnostics) {
  if (explained_ != live_.switches() || !explainer_) {
    explainer_ = std::make_unique<graph::Explainer>(renderer_.execution()->plan());
    explained_ = live_.switches();
  }
  if (visible) {
    drawMenu(diagnostics);
    arrange();
    for (std::size_t i = 0; i < kPanelCount; ++i) {
      if (begin(static_cast<Panel>(i))) {
        if (i == kParameters) drawParameters(report, diagnostics);
        if (i == kPasses) drawPasses(diagnostics);
        if (i == kInspector) inspector_.draw(diagnostics);
        if (i == kProfiler) drawProfiler();
        if (i == kStorage) drawStorage();
        if (i == kHistogram) drawHistogram();
      }
      if (open_[i]) ImGui::End();
    }
    arrange_ = false;
  }
  drawLog();
  drawLoading();
}

void Panels::drawMenu(text::Diagnostics& diagnostics) {
  if (!ImGui::BeginMainMenuBar()) return;
  if (ImGui::BeginMenu("Panels")) {
    for (std::size_t i = 0; i < kTitles.size(); ++i)
      if (ImGui::MenuItem(kTitles[i], nullptr, open_[i])) toggle(kNames[i]);
    ImGui::Separator();
    if (ImGui::MenuItem("Arrange")) arrange_ = true;
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu("Files")) {
    const graph::Settings& settings = live_.settings();
    const bool any = !settings.sets.empty() || !settings.disables.empty();
    if (ImGui::MenuItem("Write changes into the files", "F8", false, any)) writeBack(diagnostics);
    ImGui::EndMenu();
  }
  if (!said_.empty()) ImGui::TextDisabled("%s", said_.c_str());
  ImGui::EndMainMenuBar();
}

// Columns: parameters and passes at the sides, others one below the other between them; where the window is
// narrow, the two share the left side. Below all of it stands the log.
void Panels::arrange() {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  if (screen.x != width_ || screen.y != height_) arrange_ = true;
  width_ = screen.x;
  height_ = screen.y;
  if (!arrange_) return;
  const float gap = 6, top = ImGui::GetFrameHeight() + gap, em = ImGui::GetFontSize();
  const float bottom = screen.y - logHeight() - 2 * gap;  // the log's, also while there is none
  const float height = std::max(bottom - top, 4 * em);
  std::vector<Panel> others;
  for (const Panel panel : {kInspector, kProfiler, kStorage, kHistogram})
    if (open_[panel]) others.push_back(panel);
  // Where there is no room for all, the one opened last stays longest.
  while (others.size() > 1 &&
         height / static_cast<float>(others.size() + (open_[kInspector] ? 1 : 0)) < 10 * em) {
    const auto first = std::ranges::find_if(others, [&](Panel panel) { return panel != latest_; });
    open_[*first] = false;
    others.erase(first);
  }
  const bool narrow = screen.x < 88 * em && !others.empty();
  const float side = std::min(narrow ? screen.x * 0.42f : 29 * em, screen.x * 0.45f);
  const bool below = narrow && open_[kParameters] && open_[kPasses];  // the passes, below the parameters
  const float each = below ? (height - gap) / 2 : height;
  places_[kParameters] = {gap, top, side, each};
  places_[kPasses] = {narrow ? gap : screen.x - gap - side, below ? top + each + gap : top, side, each};
  const float left = open_[kParameters] || (narrow && open_[kPasses]) ? side + 2 * gap : gap;
  const float right = screen.x - (open_[kPasses] && !narrow ? side + 2 * gap : gap);
  float shares = 0, y = top;
  const auto shareOf = [](Panel panel) { return panel == kInspector ? 2.0f : 1.0f; };
  for (const Panel panel : others) shares += shareOf(panel);
  const float room = height - gap * (static_cast<float>(others.size()) - 1);
  for (const Panel panel : others) {
    const float share = room * shareOf(panel) / shares;
    places_[panel] = {left, y, right - left, share};
    y += share + gap;
  }
}

bool Panels::measureBox() {
  gl::PassTimers& timers = renderer_.device().timers;
  bool measure = timers.enabled();
  if (ImGui::Checkbox("measure each pass", &measure)) timers.setEnabled(measure);
  return measure;
}

bool Panels::begin(Panel panel) {
  if (!open_[panel]) return false;
  const ImGuiCond when = arrange_ ? ImGuiCond_Always : ImGuiCond_Appearing;
  const Place& place = places_[panel];
  ImGui::SetNextWindowPos({place.x, place.y}, when);
  ImGui::SetNextWindowSize({place.width, place.height}, when);
  bool stays = true;
  const bool shown = ImGui::Begin(kTitles[panel], &stays);
  if (!stays) {
    ImGui::End();
    open_[panel] = false;
    return false;
  }
  return shown;
}

void Panels::writeBack(text::Diagnostics& diagnostics) {
  std::vector<std::string> files;
  if (live_.writeBack(files, diagnostics)) {
    said_ = files.empty() ? "the files say so already" : "wrote";
    for (const std::string& file : files) said_ += " " + file;
    print(text::printable(said_) + "\n");
    flushPrinted();
  } else {
    said_ = "nothing was written: see the log";
  }
}

float Panels::logHeight() const {
  return std::max(64.0f, std::min(ImGui::GetIO().DisplaySize.y * 0.2f, ImGui::GetFontSize() * 9));
}

void Panels::drawLog() {
  const std::vector<const text::Diagnostic*> shown = log_.shown(visible);
  if (shown.empty()) return;
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const ImGuiStyle& style = ImGui::GetStyle();
  const char* const lastGood =
      !live_.running() ? "Nothing to show yet; the picture comes when the files are saved without errors:"
      : live_.good()   ? nullptr
                       : "This is the last good picture; the files on disk have errors:";
  // The first error is to be read whole, message and fix.
  float height = logHeight();
  if (shown.front()->severity == text::Severity::error) {
    const float wrap = std::max(1.0f, screen.x - 16 - 2 * style.WindowPadding.x - style.ScrollbarSize);
    float wanted = ImGui::GetFrameHeight() + 2 * style.WindowPadding.y + style.ItemSpacing.y;
    if (lastGood) wanted += ImGui::CalcTextSize(lastGood, nullptr, false, wrap).y + style.ItemSpacing.y;
    wanted += ImGui::CalcTextSize(text::format(*shown.front()).c_str(), nullptr, false, wrap).y;
    height = std::max(height, std::min(wanted, screen.y * 0.6f));
  }
  ImGui::SetNextWindowPos({8, screen.y - height - 8}, ImGuiCond_Always);
  ImGui::SetNextWindowSize({screen.x - 16, height}, ImGuiCond_Always);
  bool stays = true;
  ImGui::Begin("Log", &stays,
               ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse);
  ImGui::PushTextWrapPos(0);
  if (lastGood) ImGui::TextColored({1, 0.7f, 0.3f, 1}, "%s", lastGood);
  for (const text::Diagnostic* each : shown) {
    const ImVec4 color = each->severity == text::Severity::error     ? ImVec4(1, 0.45f, 0.4f, 1)
                         : each->severity == text::Severity::warning ? ImVec4(1, 0.85f, 0.4f, 1)
                                                                     : ImVec4(0.7f, 0.7f, 0.7f, 1);
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextUnformatted(text::format(*each).c_str());
    ImGui::PopStyleColor();
  }
  ImGui::PopTextWrapPos();
  ImGui::End();
  if (!stays) log_.dismiss();
}

void Panels::drawLoading() {
  const std::optional<LoadStatus> all[] = {live_.environment().status(), live_.scene().status()};
  if (!all[0] && !all[1]) return;
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float width = std::min(420.0f * ImGui::GetIO().FontGlobalScale, screen.x - 16);
  // Between the panels, which end at three quarters, and the log.
  ImGui::SetNextWindowPos({screen.x * 0.5f, screen.y * 0.8f - 12}, ImGuiCond_Always, {0.5f, 1});
  ImGui::SetNextWindowSize({width, 0}, ImGuiCond_Always);
  ImGui::Begin("Loading", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoSavedSettings);
  for (const auto& status : all) {
    if (!status) continue;
    ImGui::TextUnformatted(fmt::format("{}: {}", status->name, status->stage).c_str());
    ImGui::ProgressBar(status->done, {-1, 0}, fmt::format("{:.0f} %", status->done * 100.0f).c_str());
  }
  ImGui::End();
}

}  // namespace weft::app::ui
