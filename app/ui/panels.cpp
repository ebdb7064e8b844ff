#include "app/ui/panels.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace weft::app::ui {

namespace {

constexpr std::array<const char*, 9> kTitles = {"Parameters", "Passes",  "Selected",  "Pictures", "Pixel",
                                                "Times",      "Storage", "Histogram", "Messages"};
constexpr ImGuiWindowFlags kFixed =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBringToFrontOnFocus;
constexpr double kTipSeconds = 0.4;
double g_still = 0;  // seconds for which the mouse has not moved, nor had a button down

ImVec4 colorOf(text::Severity severity) {
  return severity == text::Severity::error     ? ImVec4(1, 0.45f, 0.4f, 1)
         : severity == text::Severity::warning ? ImVec4(1, 0.85f, 0.4f, 1)
                                               : ImVec4(0.7f, 0.7f, 0.7f, 1);
}

void beginFixed(const char* name, float x, float y, float width, float height, ImGuiWindowFlags flags = 0) {
  ImGui::SetNextWindowPos({x, y});
  ImGui::SetNextWindowSize({width, height});
  ImGui::Begin(name, nullptr, kFixed | flags);
}

}  // namespace

void tooltip(const std::string& text, bool hovered) {
  if (!hovered || text.empty() || g_still < kTipSeconds) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 30);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool beginTable(const char* id, std::initializer_list<const char*> titles, int stretched,
                ImGuiTableFlags flags) {
  if (!ImGui::BeginTable(id, static_cast<int>(titles.size()),
                         flags | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_Resizable))
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

Panels::Panels(LiveGraph& live, runtime::Renderer& renderer, Log& log, std::function<void(const char*)> act,
               EditFile edit)
    : live_(live), renderer_(renderer), log_(log), act_(std::move(act)), edit_(std::move(edit)) {}

Panels::~Panels() {
  inspector_.release();
}

void Panels::open(std::string_view tab) {
  for (std::size_t i = 0; i < kTabCount; ++i)
    if (tab == names()[i]) wanted_.set(i);
  visible_ = true;
}

std::string Panels::places() const {
  return fmt::format("{} {} {}", visible_ ? int{*visible_} : -1, names()[shown_[1]], names()[shown_[0]]);
}

void Panels::restore(std::istream& places) {
  int shown = -1;
  std::string tab;
  if (places >> shown)
    while (places >> tab) open(tab);
  visible_ = shown < 0 ? std::nullopt : std::optional(shown > 0);
}

std::vector<std::string> Panels::names() {
  std::vector<std::string> names(kTitles.begin(), kTitles.end());
  for (std::string& name : names) name[0] = static_cast<char>(name[0] + 'a' - 'A');
  return names;
}

// The column takes the right side, the strip what is below the picture. A narrow window has no strip, and all tabs in the column.
void Panels::measure(float textSize, float width, float height) {
  em_ = textSize;
  width_ = width;
  height_ = height;
  column_ = visible() ? std::round(std::min(29 * em_, width * 0.5f)) : 0;
  line_ = visible() ? std::round(std::min(2 * em_, height * 0.2f)) : 0;
  strip_ = visible() && wide() ? std::round(std::min(13 * em_, height * 0.3f)) : 0;
}

Panels::Area Panels::picture() const {
  const auto pixels = [](float length) { return static_cast<std::uint32_t>(std::max(1.0f, length)); };
  return {0, static_cast<std::uint32_t>(line_ + strip_), pixels(width_ - column_),
          pixels(height_ - line_ - strip_)};
}

void Panels::markPixel(glm::dvec2 place) {
  pixel_.mark(place);
  open("pixel");
}

void Panels::drawPixel() {
  const graph::Plan& plan = renderer_.execution()->plan();
  if (const std::uint32_t pass = pixel_.draw(plan); pass != graph::kNone) select(plan.graph->passNames[pass]);
}

void Panels::beforeFrame(const scene::CameraPose& pose) {
  runtime::StepWatch::Look also;
  // Of a plan that is not listed yet nothing is drawn.
  if (shows(kPictures) && explainer_ && explained_ == live_.switches()) {
    const bool moved = std::exchange(pose_, pose) != pose;
    const bool changed = std::exchange(livesSet_, live_.livesSet()) != live_.livesSet();
    pictures_.beforeFrame(moved || changed || std::exchange(renewed_, false));
    also = [this](std::uint32_t step) { pictures_.afterStep(*renderer_.execution(), step); };
  } else if (shows(kPixel)) {
    pixel_.beforeFrame();
    also = [this](std::uint32_t step) { pixel_.afterStep(*renderer_.execution(), step); };
  }
  inspector_.beforeFrame(shows(kSelected) || inspector_.large, std::move(also));
  profiler_.begin();
}

void Panels::afterFrame() {
  if (renderer_.execution()) profiler_.end(renderer_.execution()->plan());
}

bool Panels::wantsFrame() const {
  const bool unmeasured = renderer_.device().timers.enabled() &&
                          (profiler_.history().empty() || profiler_.history().back().passes.empty());
  return unmeasured || ((shows(kSelected) || inspector_.large) && inspector_.wantsFrame()) ||
         (shows(kPictures) && pictures_.wantsFrame());
}

bool Panels::wantsLayout() const {
  return visible() && g_still < kTipSeconds;
}

void Panels::draw(const runtime::FrameReport& report, const LoopState& state,
                  text::Diagnostics& diagnostics) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool still = io.MouseDelta.x == 0 && io.MouseDelta.y == 0 && !ImGui::IsAnyMouseDown();
  g_still = still ? g_still + static_cast<double>(io.DeltaTime) : 0;
  if (!ImGui::IsAnyItemActive()) live_.endChange();
  renewed_ |= report.slowRun > 0;
  if (live_.running() && (explained_ != live_.switches() || !explainer_)) {
    explainer_ = std::make_unique<graph::Explainer>(renderer_.execution()->plan());
    rows_ = passRowsOf(*renderer_.desc(), renderer_.execution()->plan());
    pictures_.list(rows_, renderer_.execution()->plan());
    explained_ = live_.switches();
  }
  const std::size_t errors = log_.errors();
  if (std::exchange(errors_, errors) < errors && wide() && visible()) wanted_.set(kMessages);
  if (visible() && live_.running()) {
    const std::bitset<kTabCount> wanted = wanted_;
    if (strip_ > 0) {
      beginFixed("strip", 0, height_ - line_ - strip_, width_ - column_, strip_);
      drawTabs(1, kPictures, kTabCount, report, diagnostics);
      ImGui::End();
    }
    // After the strip, in which a click brings a tab of the column to the front.
    beginFixed("column", width_ - column_, 0, column_, height_ - line_);
    drawTabs(0, 0, wide() ? kPictures : kTabCount, report, diagnostics);
    ImGui::End();
    wanted_ &= ~wanted;  // a click may want one that was drawn before
  }
  if (inspector_.large && live_.running()) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    beginFixed("large", 0, 0, width_ - column_, height_ - line_ - strip_, ImGuiWindowFlags_NoInputs);
    ImGui::PopStyleVar();
    inspector_.draw(true, diagnostics);
    ImGui::End();
  }
  if (visible()) drawLine(state);
  if (!shows(kMessages) || !live_.running()) drawAlarm();
  drawLoading();
  drawQuestion(state, diagnostics);
  if (visible()) return;
  ImGui::SetNextWindowPos({width_, 0}, ImGuiCond_Always, {1, 0});
  ImGui::Begin("button", nullptr, kFixed | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_AlwaysAutoResize);
  if (ImGui::SmallButton("Panels")) act_("panels");
  ImGui::End();
}

void Panels::drawTabs(std::size_t place, std::size_t first, std::size_t end,
                      const runtime::FrameReport& report, text::Diagnostics& diagnostics) {
  const std::array<std::function<void()>, kTabCount> draws = {[&] { drawParameters(report, diagnostics); },
                                                              [&] { drawPasses(diagnostics); },
                                                              [&] { inspector_.draw(false, diagnostics); },
                                                              [&] { drawPictures(diagnostics); },
                                                              [&] { drawPixel(); },
                                                              [&] { drawProfiler(); },
                                                              [&] { drawStorage(); },
                                                              [&] { drawHistogram(); },
                                                              [&] { drawMessages(true); }};
  if (!ImGui::BeginTabBar("tabs", ImGuiTabBarFlags_FittingPolicyScroll)) return;
  for (std::size_t i = first; i < end; ++i) {
    const ImGuiTabItemFlags flags = wanted_[i] ? ImGuiTabItemFlags_SetSelected : 0;
    if (!ImGui::BeginTabItem(kTitles[i], nullptr, flags)) continue;
    shown_[place] = static_cast<Tab>(i);
    ImGui::BeginChild(kTitles[i]);
    if (explained_ == live_.switches())
      draws[i]();  // else a parameter has just replaced the plan: in the next frame
    ImGui::EndChild();
    ImGui::EndTabItem();
  }
  ImGui::EndTabBar();
}

bool Panels::measureBox() {
  gl::PassTimers& timers = renderer_.device().timers;
  bool measure = timers.enabled();
  if (ImGui::Checkbox("measure each pass", &measure)) timers.setEnabled(measure);
  return measure;
}

void Panels::drawLine(const LoopState& state) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {em_ / 2, em_ / 4});
  beginFixed("line", 0, height_ - line_, width_, line_);
  ImGui::PopStyleVar();
  const auto button = [&](const char* title, const char* action, const char* tip) {
    ImGui::SameLine();
    if (ImGui::SmallButton(title)) act_(action);
    tooltip(tip);
  };
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(fmt::format("frame {:<6} {:8.2f} s", state.frame, state.time).c_str());
  button("open", "open", "another graph, scene, model, environment or preset (Ctrl O)");
  button(state.paused ? "run" : "pause", "pause", "time stands still, or goes on (T)");
  button("step", "step", "one frame of 1/60 s, while it stands still (.)");
  button("0 s", "reset_time", "time begins anew (Home)");
  ImGui::SameLine();
  const double ms = profiler_.median();
  ImGui::TextUnformatted(ms > 0 ? fmt::format("{:.1f} ms", ms).c_str() : "- ms");
  tooltip("median of the last 30 frames that were drawn");
  if (!state.modes.empty()) {
    ImGui::SameLine();
    ImGui::TextColored({1, 0.6f, 0.4f, 1}, "%s", state.modes.c_str());
  }
  if (const std::size_t unsaved = live_.unsaved()) {
    button(fmt::format("{} unsaved", unsaved).c_str(), "write_back",
           "shows what would be written where (F8)");
  }
  const std::vector<const text::Diagnostic*> messages = log_.shown(true);
  const bool error = !messages.empty() && messages.front()->severity == text::Severity::error;
  const std::string said =
      state.said.empty() || error ? messages.empty() ? "" : text::format(*messages.front()) : state.said;
  if (!said.empty()) {
    ImGui::SameLine();
    if (ImGui::SmallButton("copy")) ImGui::SetClipboardText(said.c_str());
    ImGui::SameLine();
    ImGui::TextColored(error ? colorOf(text::Severity::error) : ImGui::GetStyleColorVec4(ImGuiCol_Text), "%s",
                       said.substr(0, said.find('\n')).c_str());
    tooltip(said);
  }
  ImGui::End();
}

void Panels::drawMessages(bool all) {
  const char* const lastGood =
      !live_.running() ? "Nothing to show yet; the picture comes when the files are saved without errors:"
      : live_.good()   ? nullptr
                       : "This is the last good picture; the files on disk have errors:";
  ImGui::PushTextWrapPos(0);
  if (lastGood) ImGui::TextColored({1, 0.7f, 0.3f, 1}, "%s", lastGood);
  int id = 0;
  for (const text::Diagnostic* each : log_.shown(all)) {
    const std::string text = text::format(*each);
    ImGui::PushID(id++);
    if (ImGui::SmallButton("copy")) ImGui::SetClipboardText(text.c_str());
    ImGui::SameLine();
    if (each->place.file && each->place.line > 0) {
      if (ImGui::SmallButton("edit")) edit_(each->place.inFile());
      ImGui::SameLine();
    }
    ImGui::TextColored(colorOf(each->severity), "%s", text.c_str());
    ImGui::PopID();
  }
  ImGui::PopTextWrapPos();
}

void Panels::drawAlarm() {
  const std::vector<const text::Diagnostic*> shown = log_.shown(false);
  if (shown.empty()) return;
  const float width = width_ - column_ - em_;
  // The first is to be read whole, message and fix.
  const float wrap = std::max(1.0f, width - 9 * em_);
  const float text = ImGui::CalcTextSize(text::format(*shown.front()).c_str(), nullptr, false, wrap).y;
  const float height = std::min(7 * em_ + text, (height_ - line_ - strip_) * 0.6f);
  ImGui::SetNextWindowPos({em_ / 2, height_ - line_ - strip_ - height - em_ / 2});
  ImGui::SetNextWindowSize({width, height});
  bool stays = true;
  ImGui::Begin("Messages", &stays,
               ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse);
  drawMessages(false);
  ImGui::End();
  if (!stays) log_.dismiss();
}

void Panels::drawLoading() {
  std::string said;
  if (live_.environment().loading()) said += "loading " + live_.environment().wantedName() + "\n";
  if (live_.scene().loading()) said += "loading " + live_.scene().name() + "\n";
  if (said.empty()) return;
  const float room = width_ - column_, width = std::min(30 * em_, room - em_);
  ImGui::SetNextWindowPos({room / 2, (height_ - line_ - strip_) * 0.9f}, ImGuiCond_Always, {0.5f, 1});
  ImGui::SetNextWindowSize({width, 0});
  ImGui::Begin("Loading", nullptr, kFixed | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoFocusOnAppearing);
  said.pop_back();
  ImGui::TextUnformatted(said.c_str());
  ImGui::End();
}

}  // namespace weft::app::ui
