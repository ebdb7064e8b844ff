// The viewer: a LiveGraph in a window, a camera, panels around the picture, and the loop over them.
#pragma once

#include <climits>

#include "app/output/frame_look.h"
#include "app/output/pictures.h"
#include "app/session/command_line.h"
#include "app/session/session.h"
#include "app/ui/panels.h"
#include "app/ui/wipe.h"
#include "app/view/editor.h"
#include "app/view/frame_clock.h"
#include "app/view/page_server.h"
#include "app/view/window_input.h"
#include "engine/runtime/inspection/step_watches.h"

namespace weft::app {

struct ViewOptions : Options {
  std::uint32_t maxFrames = 0;      // stop after this many frames; 0: until closed
  std::vector<std::string> panels;  // to the front at the start
  bool ui = true;                   // panels around the picture
  std::string screenshot;           // written at the end
  std::string record;               // pattern of a recording from the first frame on; empty: none
  bool waitForAssets = false;       // before the first frame
  bool events = false;              // says what happens, for scripts
  bool idle = false;
  double renderScale = 1;             // pixels of the scene per pixel of the window
  std::optional<double> movingScale;  // of that, while the camera moves; else by time, and 1 for scripts
  double uiScale = 0;                 // 0: as the screen says
  std::string editor;                 // its command; empty: the one of the environment
  std::optional<int> serve;           // the port of a page of the frame, 0 for any
  // Where things were in the run before: the corner of the window, and what its panels and their tables say.
  int corner[2] = {INT_MIN, INT_MIN};
  std::string panelPlaces, tables;

  // Text that is kept between runs, by a name; "" when there is none, and for scripts, which keep nothing.
  std::string kept(const char* name) const;
  void keep(const char* name, const std::string& text) const;
  // Takes up what keepPlaces() kept; a size of the command line stays.
  void recallPlaces();

 private:
  std::string keptFile(const char* name) const;
};

class Viewer {
 public:
  // `session` has a window, and outlives this. Shows that `live` is being loaded, which is to be done before run(). `server`: null, or
  // who gets the page of a frame.
  Viewer(const ViewOptions& options, DeviceSession& session, LiveGraph& live, PageServer* server);
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  // Until the window is closed. The exit code: 0 when the files were good in the end. `said`: while `live` was loaded.
  int run(text::Diagnostics said);

  // Frames of the graph, and times that only the panels over the last one were drawn anew.
  std::uint32_t frames() const { return frame_; }
  std::uint32_t redraws() const { return redraws_; }

 private:
  void addActions();
  void act(const KeyBinding& key);
  // What it led to, for the line at the bottom.
  std::string step(const KeyBinding& key);
  std::string show(const KeyBinding& key);
  std::string open(const std::string& file);
  // Files that were opened, the last first, are kept between runs.
  void remember(const std::string& file);
  void keepPlaces() const;
  void edit(const text::Place& place);
  void close();
  // The command that renders what is seen.
  std::string command() const;
  // The camera of the scene that is followed; the default one when it is gone. Null without a scene.
  const scene::Camera* sceneCamera() const;
  void lookThrough(std::size_t camera);
  void toggleFlight();
  // One recording at a time, numbered from 0, to --record or a new folder record_N; the first file that cannot be written ends it.
  void toggleRecording();
  void stopRecording();

  void waitForEvents();
  // Events, a few at a time, each time with a layout of the panels that sees them.
  void takeInput(gl::Size size);
  void update(gl::Size size);
  void showState();
  // Fewer pixels while a hand moves the camera and frames are slow.
  void chooseScale();
  gl::Size pixelsAt(double scale) const;  // of the picture's place in the window
  // Idle mode: whether something is under way that may not show for a while, and whether a frame is due.
  bool busy();
  bool mustDraw();
  // Whether the graph reads the mouse; the mouse over the picture that it presents.
  bool readsMouse();
  imports::Pointer pointer();
  // May end without a picture, when files change meanwhile.
  void frame();
  void servePage(FrameLook& look);
  // What the scan for NaN found: the passes' records of this frame, in order.
  void tellBroken(const std::vector<runtime::StepRecord>& records);
  void show();
  void moveCamera(const FrameClock::Tick& tick);
  void judgeRest();
  // The last picture again, for the panels over it.
  void redraw();
  // `seen`: on the screen, not only for the events that wait.
  void drawUi(bool seen = true);
  void finishFrame();
  void saveScreenshot();
  bool savePicture(const std::string& name);
  // With --events, "event 12 click 376 40" with the number of the next frame, when the thing is done: so scripts wait for no time.
  void say(std::string_view event) const;
  void tellFrame();

  const ViewOptions& options_;
  DeviceSession& session_;
  GLFWwindow* window_ = static_cast<GLFWwindow*>(session_.context->window());
  runtime::Renderer& renderer_ = session_.renderer;
  LiveGraph& live_;
  std::map<std::string, std::function<void()>, std::less<>> actions_;  // by name
  KeyTable keys_;
  WindowInput input_{window_, keys_};
  PageServer* server_;
  std::unique_ptr<ui::Overlay> overlay_;  // null with --no-ui
  ui::Log log_;
  Editor editor_{options_.editor};
  ui::Panels panels_{live_, renderer_, log_,
                     [this](const char* action) { act({.verb = "do", .name = action}); },
                     [this](const text::Place& place) { edit(place); }};
  ui::Wipe wipe_;
  CameraRig rig_{scene::CameraPose{}};
  std::string cameraName_;  // of the scene's camera that is followed; empty: the first
  scene::CameraPose previousPose_;
  imports::Pointer pointer_;  // of the last frame
  std::uint64_t cuts_ = 0, sceneGeneration_ = 0;
  FrameClock clock_;
  PictureWriter recorder_;
  std::string recording_;       // pattern of the recording that is on, or empty
  std::uint32_t recorded_ = 0;  // its frames
  PictureRest rest_;
  runtime::FrameReport report_;    // of the last frame
  text::Diagnostics diagnostics_;  // of what the loop is doing
  std::string screenshot_;         // extension of one that is wanted
  std::string title_, told_;       // the last: what was done, for the line at the bottom
  ui::Panels::Area area_;          // of the picture, in pixels of the window
  std::uint32_t frame_ = 0, redraws_ = 0;
  std::uint64_t inputs_ = 0, changed_ = 0;  // when they were last looked at
  std::uint64_t arrivals_ = 0;              // of files and environments
  int restless_ = 0;                        // redraws that the panels still want
  float uiScale_ = 1;
  gl::Size size_;       // of the window, as it was said last
  int before_[4] = {};  // place and size of the window, before it had the whole screen
  double renderScale_ = options_.renderScale;
  double movingScale_ = 1;                  // of that, now
  double movedAt_ = -1, slow_[2] = {0, 0};  // seconds: when the camera was moved; of the last frames at rest
  std::vector<std::string> recent_;
  const KeyBinding* shownBy_ = nullptr;
  bool vsync_ = options_.vsync, idle_ = options_.idle, help_ = false, minimized_ = false;
  bool scan_ = false;                     // for NaN, in the next frame
  bool resting_ = false, shown_ = false;  // as it was said last; a picture was
  bool sceneLoads_ = false;               // as it was said last
  bool leave_ = false;                    // the window closes whatever is unsaved
  bool broken_ = false;                   // the driver or an output reported an error
};

// The command `weft view`.
void addView(CommandLine& line);

}  // namespace weft::app
