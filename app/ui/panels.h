// What stands around the picture in the viewer: a column and a strip of tabs, and a line with the state of the loop. Each is made anew
// every frame and keeps what a person chose in it; changes go straight into the LiveGraph.
#pragma once

#include <fmt/format.h>
#include <imgui.h>

#include <bitset>
#include <initializer_list>
#include <map>
#include <span>
#include <string_view>

#include "app/live/live_graph.h"
#include "app/ui/log.h"
#include "app/ui/looks.h"
#include "app/ui/pass_pictures.h"
#include "app/ui/pass_rows.h"
#include "app/ui/pixel_panel.h"
#include "engine/graph/print/print.h"
#include "engine/runtime/inspection/frame_profiler.h"
#include "engine/runtime/inspection/inspector.h"

namespace weft::app::ui {

// When the mouse rests over the last item.
void tooltip(const std::string& text, bool hovered = ImGui::IsItemHovered());
// A table with titles, of which one column takes what the others leave. False where none of it is seen.
bool beginTable(const char* id, std::initializer_list<const char*> titles, int stretched,
                ImGuiTableFlags flags);
void cell(const std::string& text);  // the next one of a table

// What is selected: which resource, where in the frame, which part, how shown; zoom, pan and the value under the cursor.
class InspectorPanel {
 public:
  InspectorPanel(runtime::Renderer& renderer, Looks& looks)
      : renderer_(renderer), inspector_(renderer.device()), looks_(looks) {}

  // To be called before each frame. `wanted`: it is on the screen. `also`: what else is to be called after each step, or nothing.
  void beforeFrame(bool wanted, runtime::StepWatch::Look also);
  // `inPlace`: of the picture.
  void draw(bool inPlace, text::Diagnostics& diagnostics);
  void release() {
    if (renderer_.execution()) inspector_.release(*renderer_.execution());
  }
  bool wantsFrame() const { return wantsFrame_; }  // something else is to be copied
  // What a pass writes first, after that pass.
  void select(const graph::Plan& plan, std::uint32_t pass);
  void select(const runtime::InspectTarget& target) { target_ = target; }
  bool large = false;  // what is selected is in the place of the picture

 private:
  void chooseTarget(const graph::Plan& plan);
  void choosePart(const graph::FlatResource& resource);
  void chooseView(const graph::FlatResource& resource, Look& look);
  void drawPicture(Look& look, text::Diagnostics& diagnostics);
  void drawNumbers();

  runtime::Renderer& renderer_;
  runtime::Inspector inspector_;
  runtime::InspectTarget target_, watched_;
  Looks& looks_;
  ImGuiTextFilter filter_;
  std::uint64_t copiesBefore_ = 0;  // when what is watched changed
  bool found_ = false, wantsFrame_ = false;
  std::optional<runtime::InspectStatistics> statistics_;
  int numbers_ = 0;  // buffers: 0 float, 1 hexadecimal, 2 unsigned, 3 signed
};

// What the line at the bottom says of the loop.
struct LoopState {
  std::uint32_t frame = 0;
  double time = 0;  // seconds
  bool paused = false;
  std::string modes;                      // "REC 12, FLY"
  std::string said;                       // what was done last
  std::span<const std::string> recent{};  // files that were opened, the last first
};

class Panels {
 public:
  using EditFile = std::function<void(const text::Place& place)>;
  // `act` runs an action of the viewer (app/view/key_bindings.h), `edit` opens a file at a place.
  Panels(LiveGraph& live, runtime::Renderer& renderer, Log& log, std::function<void(const char*)> act,
         EditFile edit);
  ~Panels();
  Panels(const Panels&) = delete;
  Panels& operator=(const Panels&) = delete;

  // Shows or hides them all. At first they are there where the window is wide enough for a picture beside them.
  void toggle() { visible_ = !visible(); }
  // Brings one to the front by its name, which names() has.
  void open(std::string_view tab);
  static std::vector<std::string> names();
  // "0", "1", or "-1" while nobody chose whether panels are shown, and the tabs in front: between runs.
  std::string places() const;
  void restore(std::istream& places);
  // Brings a pass and what it writes to the front, by its full instance name.
  void select(std::string_view pass);
  // Brings what passes leave at a place of the picture to the front: from its lower left corner, 0 to 1 each way.
  void markPixel(glm::dvec2 place);
  // Shows a texture in the place of the picture; the same of what is selected, or the picture again.
  void show(const runtime::InspectTarget& target, const Look& look) {
    inspector_.select(target);
    looks_.choose(target.resource, look);
    inspector_.large = true;
  }
  void showSelected() { inspector_.large = !inspector_.large; }
  // False when the picture is there.
  bool hideShown() { return std::exchange(inspector_.large, false); }
  // Where the selected pass is written, or, with `shader`, its shader; nowhere when none is selected.
  text::Place selectedPlace(bool shader) const;
  // The height of text in pixels, and the size of the window; to be called before the functions below.
  void measure(float textSize, float width, float height);
  // Pixels of the window, from its lower left corner, that are the picture's.
  struct Area {
    std::uint32_t x = 0, y = 0, width = 1, height = 1;
  };
  Area picture() const;

  // Around a frame, with its time on the screen. `pose`: the frame's camera.
  void beforeFrame(const scene::CameraPose& pose);
  void afterFrame();
  // Between Overlay::begin() and end(). `diagnostics` gets what a change that was made here led to.
  void draw(const runtime::FrameReport& report, const LoopState& state, text::Diagnostics& diagnostics);

  // In idle mode: what was chosen shows only in another frame of the graph; in another layout of the panels.
  bool wantsFrame() const;
  bool wantsLayout() const;

  // Shows what F8 would write; once that is on the screen, writes it. What there is to say of it.
  std::string writeBack(text::Diagnostics& diagnostics);
  // Asks whether to close with changes that are in no file.
  void askToLeave() { question_ = Question::leave; }
  // Asks for a file to open.
  void askToOpen() { question_ = Question::open; }
  // The answer, once.
  std::string takeChosen() { return std::exchange(chosen_, {}); }
  // False when there is no question to close.
  bool closeQuestion() { return std::exchange(question_, Question::none) != Question::none; }

 private:
  enum Tab : std::size_t {
    kParameters,
    kPasses,
    kSelected,
    kPictures,
    kPixel,
    kTimes,
    kStorage,
    kHistogram,
    kMessages,
    kTabCount
  };
  enum class Question : std::uint8_t { none, write, leave, open };

  bool wide() const { return width_ >= 78.5f * em_; }  // 1,100 pixels at scale 1
  bool visible() const { return visible_.value_or(wide()); }
  bool shows(Tab tab) const { return visible() && (shown_[0] == tab || (wide() && shown_[1] == tab)); }
  void drawTabs(std::size_t place, std::size_t first, std::size_t end, const runtime::FrameReport& report,
                text::Diagnostics& diagnostics);
  void drawPasses(text::Diagnostics& diagnostics);
  void drawPassRow(std::size_t row, text::Diagnostics& diagnostics);
  void drawParameters(const runtime::FrameReport& report, text::Diagnostics& diagnostics);
  void drawPictures(text::Diagnostics& diagnostics);
  void drawPixel();
  void drawProfiler();
  void drawStorage();
  void drawHistogram();
  void drawMessages(bool all);
  void drawAlarm();  // messages that cannot wait, where their tab is not there
  void drawLine(const LoopState& state);
  void drawLoading();  // what is being loaded
  void drawQuestion(const LoopState& state, text::Diagnostics& diagnostics);
  void drawWrites(text::Diagnostics& diagnostics);
  void drawOpen(const LoopState& state);
  bool measureBox();  // whether each pass is measured

  LiveGraph& live_;
  runtime::Renderer& renderer_;
  Log& log_;
  std::function<void(const char*)> act_;
  EditFile edit_;
  runtime::FrameProfiler profiler_{renderer_.device().timers};
  Looks looks_;
  InspectorPanel inspector_{renderer_, looks_};
  PassPictures pictures_{renderer_.device(), looks_};
  PixelPanel pixel_;
  scene::CameraPose pose_;                        // of the last frame
  std::uint64_t livesSet_ = 0;                    // by then
  bool renewed_ = false;                          // what runs only when something changed ran since then
  std::array<std::array<float, 256>, 4> bins_{};  // of the picture: red, green, blue, luminance
  double counted_ = -1;                           // seconds: when the histogram was made
  std::unique_ptr<graph::Explainer> explainer_;   // of the plan of `explained_`
  std::vector<PassRow> rows_;                     // of the same
  std::uint64_t explained_ = 0;

  std::optional<bool> visible_;  // as a person chose it
  std::array<Tab, 2> shown_{kParameters, kPictures};
  std::bitset<kTabCount> wanted_;  // to be brought to the front
  float em_ = 14, width_ = 0, height_ = 0;
  float column_ = 0, strip_ = 0, line_ = 0;  // pixels; 0: not there
  std::size_t errors_ = 0;                   // in the log, when it was looked at last
  Question question_ = Question::none;
  std::optional<graph::WriteBack> writes_;
  char preset_[64] = {}, file_[1024] = {};
  std::string chosen_;
  ImGuiTextFilter filter_;  // of the parameters
  ImGuiTextFilter passFilter_;
  std::uint32_t selected_ = graph::kNone;  // a row
  int stacked_ = 0;                        // profiler: 0 GPU times, 1 CPU times
};

}  // namespace weft::app::ui
