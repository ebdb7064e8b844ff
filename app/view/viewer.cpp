// What the viewer can do, by name; its loop; and its help.
#include "app/view/viewer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cassert>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

#include "app/output/output_files.h"
#include "app/output/standard_streams.h"
#include "engine/graph/language/names.h"
#include "engine/text/files/file.h"
#include "engine/text/hash.h"
#include "engine/text/json/report.h"
#include "engine/text/printable.h"

namespace weft::app {

namespace {

constexpr double kLookAround = 0.05;   // seconds between looks at everything while nothing is drawn
constexpr double kLookAtFiles = 0.02;  // the same while files that changed are to settle
constexpr std::chrono::milliseconds kWaitForWrites{5};
constexpr int kWaitsForWrites = 10;     // who writes for longer than this gets frames in between
constexpr double kHandRests = 0.3;      // seconds without a movement of the camera
constexpr double kSlow = 0.1;           // seconds of a frame
constexpr int kRestlessAfterEvent = 4;  // panels answer an event within so many redraws

// What is wrong with the files or with a change made here is reported, and does not count against the program.
void tell(text::Diagnostics& diagnostics, ui::Log& log, ui::Log::Topic topic) {
  report(diagnostics);
  log.set(topic, text::chooseMessages(diagnostics).items());
  diagnostics.clear();
}

// In two columns and as small as the window asks for.
void drawHelp(const std::vector<std::pair<std::string, std::string>>& rows) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const std::size_t high = (rows.size() + 1) / 2;
  float width = 0;
  for (const auto& [keys, help] : rows) width = std::max(width, ImGui::CalcTextSize((keys + help).c_str()).x);
  ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowFocus();
  ImGui::Begin("Help", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::SetWindowFontScale(
      std::min({1.0f, (screen.x - 16) / (2 * width + 8 * ImGui::GetFontSize()),
                (screen.y - 16) / (static_cast<float>(high + 1) * ImGui::GetTextLineHeightWithSpacing())}));
  if (ImGui::BeginTable("keys", 4, ImGuiTableFlags_SizingFixedFit)) {
    for (std::size_t row = 0; row < high; ++row)
      for (std::size_t at = row; at < rows.size(); at += high) {
        ImGui::TableNextColumn();
        ImGui::TextColored({0.6f, 0.85f, 1, 1}, "%s", rows[at].first.c_str());
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(rows[at].second.c_str());
      }
    ImGui::EndTable();
  }
  ImGui::End();
}

// Threads over and under each other.
void setIcon(GLFWwindow* window) {
  constexpr int kSize = 48, kThread = 12;
  std::vector<unsigned char> texels;
  const auto covers = [](int at) { return at % kThread > 1 && at % kThread < kThread - 2; };
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const bool warp = covers(x) && (!covers(y) || (x / kThread + y / kThread) % 2 == 0);
      const unsigned char alpha = warp || covers(y) ? 255 : 0;
      if (warp)
        texels.insert(texels.end(), {70, 130, 220, alpha});
      else
        texels.insert(texels.end(), {240, 150, 50, alpha});
    }
  const GLFWimage icon{kSize, kSize, texels.data()};
  glfwSetWindowIcon(window, 1, &icon);
}

// Unless no screen is there now.
void moveTo(GLFWwindow* window, int x, int y) {
  int count = 0, at[4];
  GLFWmonitor** const screens = glfwGetMonitors(&count);
  for (GLFWmonitor* screen : std::span(screens, static_cast<std::size_t>(count))) {
    glfwGetMonitorWorkarea(screen, &at[0], &at[1], &at[2], &at[3]);
    if (x >= at[0] && y >= at[1] && x < at[0] + at[2] && y < at[1] + at[3]) glfwSetWindowPos(window, x, y);
  }
}

}  // namespace

std::string ViewOptions::keptFile(const char* name) const {
  const bool script = !ui || events || maxFrames > 0 || !record.empty() || !screenshot.empty();
  return script ? "" : userFile("XDG_STATE_HOME", ".local/state", name);
}

std::string ViewOptions::kept(const char* name) const {
  const std::string file = keptFile(name);
  if (!text::isThere(file)) return "";
  text::Diagnostics ignored;
  text::chooseFile(file);
  return text::readTextFile(file, ignored).value_or("");
}

void ViewOptions::keep(const char* name, const std::string& text) const {
  const std::string file = keptFile(name);
  if (file.empty()) return;
  text::Diagnostics ignored;  // a home that cannot be written
  std::error_code none;
  std::filesystem::create_directories(std::filesystem::path(file).parent_path(), none);
  text::writeFile(file, text, ignored);
}

void ViewOptions::recallPlaces() {
  std::uint32_t size[2] = {0, 0};
  std::istringstream lines(kept("places"));
  lines >> corner[0] >> corner[1] >> size[0] >> size[1] >> std::ws;
  std::getline(lines, panelPlaces);
  std::getline(lines, tables, '\0');
  if (width > 0) return;
  const bool good = std::ranges::all_of(size, [](std::uint32_t each) { return each >= 16 && each <= 16384; });
  width = good ? size[0] : 1280;
  height = good ? size[1] : 720;
}

Viewer::Viewer(const ViewOptions& options, DeviceSession& session, LiveGraph& live, PageServer* server)
    : options_(options), session_(session), live_(live), server_(server) {
  uiScale_ = options.uiScale > 0 ? static_cast<float>(options.uiScale) : session.context->contentScale();
  if (options.ui) overlay_ = ui::Overlay::create(window_, uiScale_);
  input_.setOverlay(overlay_.get());
  if (const std::string file = userFile("XDG_CONFIG_HOME", ".config", "keys.json"); text::isThere(file)) {
    text::chooseFile(file);
    text::Diagnostics said;
    if (const auto json = text::readTextFile(file, said)) keys_.add(*json, file, said);
    log_.addPast(said);
    report(said);
  }
  addActions();
  setIcon(window_);
  moveTo(window_, options.corner[0], options.corner[1]);
  renderer_.device().timers.setEnabled(options.profile);
  std::istringstream places(options.panelPlaces);
  panels_.restore(places);
  for (const std::string& panel : options.panels) panels_.open(panel);
  if (!overlay_) return;
  ImGui::LoadIniSettingsFromMemory(options.tables.data(), options.tables.size());
  overlay_->begin();
  ImGui::SetNextWindowPos({ImGui::GetIO().DisplaySize.x / 2, ImGui::GetIO().DisplaySize.y / 2}, 0,
                          {0.5f, 0.5f});
  ImGui::Begin("loading", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::TextUnformatted(fmt::format("{}: its shaders are being compiled", options.graph).c_str());
  ImGui::End();
  overlay_->end();
  glfwSwapBuffers(window_);
}

void Viewer::addActions() {
  gl::PassTimers& timers = renderer_.device().timers;
  const auto step = [this](int by) {
    if (!live_.stepEnvironment(by)) told_ = "there is no other environment in the folder";
  };
  const auto preset = [this](int by) {
    if (!live_.stepPreset(by, diagnostics_)) return void(told_ = "the graph takes no preset");
    const auto presets = renderer_.presets();
    told_ = presets.empty() ? "no preset" : "preset " + std::filesystem::path(presets.back()).stem().string();
  };
  const auto atRest = [this](const std::function<void()>& change) {  // shows only in another frame
    return [this, change] {
      change();
      rest_.disturb();
    };
  };
  actions_ = {{"help", [this] { help_ = !help_; }},
              {"panels", [this] { panels_.toggle(); }},
              {"profile", [&timers] { timers.setEnabled(!timers.enabled()); }},
              {"fly", [this] { toggleFlight(); }},
              {"head_bob", [this] { rig_.headBob = !rig_.headBob; }},
              {"reset_camera", [this] { lookThrough(0); }},
              {"copy_command",
               [this] {
                 told_ = command();
                 printNow(text::printable(told_) + "\n");
                 glfwSetClipboardString(window_, told_.c_str());
               }},
              {"save_camera",
               [this] {
                 const bool saved = live_.saveCamera(rig_.pose(), diagnostics_);
                 told_ = saved ? "the scene file has a new camera" : "no camera was saved: see the messages";
               }},
              {"next_environment", [step] { step(1); }},
              {"previous_environment", [step] { step(-1); }},
              {"next_preset", [this, preset] { preset(1); }},
              {"previous_preset", [this, preset] { preset(-1); }},
              {"open", [this] { panels_.askToOpen(); }},
              {"show_selected", [this] { panels_.showSelected(); }},
              {"undo", [this] { told_ = live_.undo(diagnostics_) ? "taken back" : "nothing to take back"; }},
              {"redo", [this] { told_ = live_.redo(diagnostics_) ? "made again" : "nothing to make again"; }},
              {"trace_pixel",
               [this] {
                 if (overlay_ && overlay_->wantsMouse())
                   return void(told_ = "the mouse is not over the picture");
                 panels_.markPixel(input_.place());
                 rest_.disturb();
               }},
              {"compare",
               [this] {
                 if (!live_.running() || !overlay_) return;
                 wipe_.toggle(renderer_.execution()->presented(), diagnostics_);
                 told_ = wipe_.on() ? "the picture is kept, left of the line" : "";
               }},
              {"edit_pass", [this] { edit(panels_.selectedPlace(false)); }},
              {"edit_shader", [this] { edit(panels_.selectedPlace(true)); }},
              {"pause", [this] { clock_.pause(!clock_.paused()); }},
              {"step", atRest([this] { clock_.step(); })},
              {"reset_time", atRest([this] { clock_.begin(); })},
              {"find_nan", atRest([this] { scan_ = true; })},
              {"full_screen",
               [this] {
                 const bool full = glfwGetWindowMonitor(window_) != nullptr;
                 GLFWmonitor* const screen = full ? nullptr : glfwGetPrimaryMonitor();
                 if (!full) {
                   glfwGetWindowPos(window_, &before_[0], &before_[1]);
                   glfwGetWindowSize(window_, &before_[2], &before_[3]);
                 }
                 const GLFWvidmode* const mode = screen ? glfwGetVideoMode(screen) : nullptr;
                 glfwSetWindowMonitor(window_, screen, before_[0], before_[1],
                                      mode ? mode->width : before_[2], mode ? mode->height : before_[3],
                                      GLFW_DONT_CARE);
               }},
              {"vsync", [this] { glfwSwapInterval((vsync_ = !vsync_) ? 1 : 0); }},
              {"idle", [this] { idle_ = !idle_; }},
              {"render_scale_down", [this] { renderScale_ = std::max(renderScale_ - 0.25, 0.25); }},
              {"render_scale_up", [this] { renderScale_ = std::min(renderScale_ + 0.25, 2.0); }},
              {"record", [this] { toggleRecording(); }},
              {"write_back", [this] { told_ = panels_.writeBack(diagnostics_); }},
              {"screenshot", [this] { screenshot_ = ".png"; }},
              {"screenshot_exr", [this] { screenshot_ = ".exr"; }},
              {"close", [this] { close(); }},
              {"close_at_once", [this] {
                 leave_ = true;
                 glfwSetWindowShouldClose(window_, GLFW_TRUE);
               }}};
  for (std::size_t i = 0; i < 9; ++i)
    actions_[fmt::format("camera_{}", i + 1)] = [this, i] { lookThrough(i); };
  for ([[maybe_unused]] const KeyBinding& key : keys_.rows())
    assert((key.verb != "do" || actions_.contains(key.name)) && "every key does something");
}

void Viewer::act(const KeyBinding& key) {
  const std::uint64_t changes = live_.changes();
  if (key.verb == "do")
    actions_.find(key.name)->second();
  else if (live_.running())
    told_ = key.verb == "show"   ? show(key)
            : key.verb == "open" ? open(presetFile(key.name, options_.presetFolder))
                                 : step(key);
  if (key.verb != "do") rest_.disturb();
  say("action " + (key.verb == "do" ? "" : key.verb + " ") + text::printable(key.name));
  if (live_.changes() != changes) tell(diagnostics_, log_, ui::Log::kChange);
}

std::string Viewer::step(const KeyBinding& key) {
  const std::span<const graph::ParameterSpec> parameters = renderer_.execution()->plan().graph->parameters;
  std::vector<std::string> names;
  for (const graph::ParameterSpec& each : parameters) names.push_back(each.path);
  const std::vector<std::size_t> found = graph::suffixMatches(names, key.name);
  if (found.empty()) {  // a pass or an effect
    text::Diagnostics said;
    const bool off = std::ranges::any_of(live_.settings().disables,
                                         [&](const graph::Disable& each) { return each.name == key.name; });
    if (!live_.setEnabled(key.name, off, said)) return said.items().front().message;
    return key.name + (off ? ": true" : ": false");
  }
  const graph::ParameterDesc& desc = parameters[found.front()].desc;
  graph::Value value = renderer_.execution()->uniforms().parameters()[found.front()];
  if (value.type == graph::Value::Type::boolean) {
    value = graph::Value::boolean(!value.truth());
  } else if (value.type == graph::Value::Type::number) {
    value.v[0] = std::clamp(value.v[0] + key.by, desc.min.value_or(-1e9), desc.max.value_or(1e9));
  } else if (const auto count = static_cast<std::ptrdiff_t>(desc.choices.size())) {
    const auto at = std::ranges::find(desc.choices, value.symbol) - desc.choices.begin();
    value.symbol = desc.choices[static_cast<std::size_t>((at + count + (key.by < 0 ? -1 : 1)) % count)];
  }
  live_.setParameter(names[found.front()], value, diagnostics_);
  live_.endChange();
  return fmt::format("{}: {}", names[found.front()], graph::toText(value));
}

std::string Viewer::show(const KeyBinding& key) {
  if (std::exchange(shownBy_, &key) == &key && panels_.hideShown()) return "";
  const graph::Plan& plan = renderer_.execution()->plan();
  text::Diagnostics said;
  const auto pick = graph::parsePick(key.name).value_or(graph::Pick{.text = key.name});
  const auto item = runtime::captureItemOf(plan, pick, said);
  if (!item) return panels_.hideShown(), said.items().front().message;
  const auto& names = plan.graph->resourceNames;
  const auto index =
      static_cast<std::size_t>(std::ranges::find(names, item->target.resource) - names.begin());
  ui::Look look{.view = runtime::Inspector::viewOf(plan.graph->resources[index])};
  look.view.channel = static_cast<runtime::InspectChannel>(key.channel);
  look.view.depth = key.as == 4;
  look.view.colors = static_cast<runtime::InspectColors>(key.as % 4);
  look.ranged = key.low || key.high;
  look.view.low = static_cast<float>(key.low.value_or(0));
  look.view.high = static_cast<float>(key.high.value_or(1));
  panels_.show(item->target, look);
  return key.name;
}

std::string Viewer::open(const std::string& file) {
  if (!live_.open(file, diagnostics_)) return "not opened, see the messages: " + file;
  if (text::isThere(file)) remember(file);  // an environment or a scene is still to be read
  return "opened " + file;
}

void Viewer::remember(const std::string& file) {
  if (const std::string list = options_.kept("recent"); !list.empty()) recent_ = text::linesOf(list);
  const std::string path = text::absolutePath(file);
  std::erase_if(recent_, [&](const std::string& each) { return each == path || each.empty(); });
  recent_.insert(recent_.begin(), path);
  recent_.resize(std::min<std::size_t>(recent_.size(), 12));
  options_.keep("recent", fmt::format("{}\n", fmt::join(recent_, "\n")));
}

void Viewer::keepPlaces() const {
  if (!overlay_) return;
  int at[4];
  glfwGetWindowPos(window_, &at[0], &at[1]);
  glfwGetWindowSize(window_, &at[2], &at[3]);
  if (glfwGetWindowMonitor(window_)) std::ranges::copy(before_, at);
  options_.keep("places", fmt::format("{}\n{}\n{}", fmt::join(at, " "), panels_.places(),
                                      ImGui::SaveIniSettingsToMemory()));
}

void Viewer::edit(const text::Place& place) {
  told_ = editor_.open(place);
  say("edit " + text::printable(told_));
}

void Viewer::close() {
  if (overlay_ && (overlay_->closePopup() || std::exchange(help_, false) || panels_.closeQuestion() ||
                   panels_.hideShown()))
    return;
  if (input_.captured()) return toggleFlight();
  glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

std::string Viewer::command() const {
  const graph::Settings& settings = live_.settings();
  const scene::CameraPose pose = rig_.pose();
  const gl::Size size = movingScale_ < 1 ? pixelsAt(renderScale_)  // as it is once the hand rests
                                         : gl::Size{settings.screenWidth, settings.screenHeight};
  std::string text =
      fmt::format("weft render {} --size {}x{}", quoted(renderer_.graphPath()), size.width, size.height);
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) text += fmt::format(" --{} {}", option, quoted(value));
  };
  add("scene", live_.scene().path() == dataFolder() + "/scenes/spheres.json" ? "" : live_.scene().path());
  add("materials", options_.materials);
  add("environment", live_.environment().shown());
  for (const std::string& preset : renderer_.presets()) add("preset", preset);
  for (const graph::Setting& set : settings.sets)
    add("set", set.name + "=" + (set.text.empty() ? graph::toText(set.value) : set.text));
  for (const graph::Disable& disable : settings.disables) add("disable", disable.name);
  add("camera", fmt::format("{},{},{},{},{},{},{},{}", pose.position.x, pose.position.y, pose.position.z,
                            pose.target.x, pose.target.y, pose.target.z, pose.fovDegrees, pose.nearPlane));
  return text;
}

const scene::Camera* Viewer::sceneCamera() const {
  const scene::Camera* named = scene::findCamera(live_.world().scene(), cameraName_);
  return named ? named : scene::findCamera(live_.world().scene(), "");
}

void Viewer::lookThrough(std::size_t camera) {
  const auto cameras = live_.world().scene().cameras.rows();
  if (camera >= cameras.size()) {
    told_ = fmt::format("the scene has {}", text::counted(cameras.size(), "camera"));
    return;
  }
  if (rig_.mode() == CameraRig::Mode::fly) toggleFlight();
  cameraName_ = camera == 0 ? "" : cameras[camera].name;
  rig_.jumpTo(scene::poseAt(cameras[camera], clock_.last().time));
}

void Viewer::toggleFlight() {
  const bool fly = rig_.mode() != CameraRig::Mode::fly;
  rig_.setMode(fly ? CameraRig::Mode::fly : CameraRig::Mode::orbit);
  input_.capture(fly);
}

void Viewer::toggleRecording() {
  if (!recording_.empty()) return stopRecording();
  recording_ = options_.record;
  for (int i = 1; recording_.empty(); ++i)
    if (const std::string folder = fmt::format("record_{}", i); !text::isThere(folder))
      recording_ = folder + "/f_%05d.png";
  recorded_ = 0;
  if (checkOutput(recording_, 0, true, diagnostics_))
    clock_.fix(options_.fps);
  else
    recording_.clear();
}

void Viewer::stopRecording() {
  if (recording_.empty()) return;
  clock_.fix(0);
  printNow(fmt::format("wrote {} to {}\n", text::counted(recorded_, "frame"),
                       text::printable(std::exchange(recording_, {}))));
  std::exchange(recorder_, {}).tell(diagnostics_);
}

void Viewer::say(std::string_view event) const {
  if (options_.events) printNow(fmt::format("event {} {}\n", frame_, event));
}

int Viewer::run(text::Diagnostics said) {
  diagnostics_ = std::move(said);
  tell(diagnostics_, log_, ui::Log::kFiles);
  if (!options_.record.empty()) toggleRecording();
  remember(renderer_.graphPath());
  while (true) {
    if (glfwWindowShouldClose(window_)) {
      if (leave_ || !overlay_ || live_.unsaved() == 0) break;
      glfwSetWindowShouldClose(window_, GLFW_FALSE);
      panels_.askToLeave();
      restless_ = kRestlessAfterEvent;
    }
    input_.giveButton(readsMouse());  // before the first events, too: some came while files were loaded
    waitForEvents();
    const gl::Size size = session_.context->framebufferSize();
    minimized_ = size.width == 0 || size.height == 0;
    if (minimized_) {
      clock_.skip(glfwGetTime());
      continue;
    }
    takeInput(size);
    update(size);
    if (mustDraw()) {
      frame();
    } else {
      clock_.skip(glfwGetTime());
      if (restless_ > 0) redraw();
    }
    if (options_.maxFrames && frame_ >= options_.maxFrames) break;
  }
  if (!options_.screenshot.empty() && frame_ > 0) savePicture(*outputNameOf(options_.screenshot, frame_ - 1));
  stopRecording();
  input_.capture(false);
  keepPlaces();
  say("closed");
  return report(diagnostics_) || broken_ || !live_.good() ? 1 : 0;
}

void Viewer::waitForEvents() {
  const bool nothingToDo = restless_ == 0 && idle_ && live_.running() && rest_.resting() && !busy();
  if (minimized_ || nothingToDo || !live_.running())
    glfwWaitEventsTimeout(live_.pending() ? kLookAtFiles : kLookAround);
  else
    glfwPollEvents();
}

void Viewer::takeInput(gl::Size size) {
  if (overlay_) {
    const float uiScale =
        options_.uiScale > 0 ? static_cast<float>(options_.uiScale) : session_.context->contentScale();
    if (std::exchange(uiScale_, uiScale) != uiScale) overlay_->setScale(uiScale);
    panels_.measure(ui::Overlay::textSize(uiScale_), static_cast<float>(size.width),
                    static_cast<float>(size.height));
  }
  area_ = overlay_ ? panels_.picture() : ui::Panels::Area{0, 0, size.width, size.height};
  input_.setPicture(glm::dvec2(area_.x, area_.y) / glm::dvec2(size.width, size.height),
                    glm::dvec2(area_.width, area_.height) / glm::dvec2(size.width, size.height));
  for (bool more = true; more;) {
    const bool came = input_.waiting();
    more = input_.hand(readsMouse() && report_.passesRun + report_.passesSkipped > 0);
    // A layout follows: without one the panels would be nowhere for the next.
    if (overlay_ && came) overlay_->begin();
    input_.decide(overlay_ && overlay_->wantsMouse());
    for (const KeyBinding* key : input_.takeActions()) act(*key);
    if (more && overlay_) drawUi(false);
  }
  const auto take = [&](const std::string& file, const char* how) {
    told_ = open(file);
    tell(diagnostics_, log_, ui::Log::kChange);
    say(fmt::format("{} {}", how, text::printable(file)));
  };
  for (const std::string& file : input_.takeDropped()) take(file, "dropped");
  if (const std::string file = panels_.takeChosen(); !file.empty()) take(file, "opened");
}

void Viewer::chooseScale() {
  const double now = glfwGetTime(),
               slow = std::min(slow_[0], slow_[1]);  // one alone may have compiled shaders
  if (input_.movesCamera() || rig_.moving()) movedAt_ = now;
  const bool never = options_.maxFrames || options_.events || slow < kSlow;
  const double wanted = options_.movingScale.value_or(never ? 1 : slow < 4 * kSlow ? 0.5 : 0.25);
  const bool moves = recording_.empty() && now - movedAt_ < kHandRests;
  const double scale = !moves ? 1 : movingScale_ < 1 ? movingScale_ : wanted;
  if (std::exchange(movingScale_, scale) != scale) say(fmt::format("scale {}", renderScale_ * scale));
}

gl::Size Viewer::pixelsAt(double scale) const {
  const auto scaled = [&](std::uint32_t pixels) {
    return static_cast<std::uint32_t>(std::clamp(std::lround(pixels * scale), 1l, 16384l));
  };
  return {scaled(area_.width), scaled(area_.height)};
}

void Viewer::update(gl::Size size) {
  if (std::exchange(inputs_, input_.events()) != input_.events()) restless_ = kRestlessAfterEvent;
  if (size.width != size_.width || size.height != size_.height)
    say(fmt::format("size {} {}", size.width, size.height));
  size_ = size;
  // A recording keeps the size it began with.
  chooseScale();
  if (recording_.empty() || recorded_ == 0) {
    const gl::Size pixels = pixelsAt(std::max(renderScale_ * movingScale_, std::min(renderScale_, 0.25)));
    if (live_.resize(pixels.width, pixels.height, diagnostics_)) tell(diagnostics_, log_, ui::Log::kChange);
  }
  if (const std::string failure = editor_.takeFailure(); !failure.empty()) {
    told_ = failure;
    say("edit " + text::printable(told_));
    restless_ = kRestlessAfterEvent;
  }
  bool looked = live_.poll(glfwGetTime(), diagnostics_);
  // Waits here while more may be written, instead of drawing another frame that is out of date.
  for (int i = 0; i < kWaitsForWrites && !looked && live_.pending(); ++i) {
    std::this_thread::sleep_for(kWaitForWrites);
    looked = live_.poll(glfwGetTime(), diagnostics_);
  }
  if (!std::exchange(sceneLoads_, live_.scene().loading()) && sceneLoads_)
    say("loading " + live_.scene().name());
  if (looked) {
    ++arrivals_;
    tell(diagnostics_, log_, live_.wentBack() ? ui::Log::kChange : ui::Log::kFiles);
    restless_ = kRestlessAfterEvent;
    say(live_.good() ? "files good" : "files wrong");
  }
  if (live_.pollEnvironment(diagnostics_)) {
    tell(diagnostics_, log_, ui::Log::kEnvironment);
    ++arrivals_;
    rest_.disturb();
    restless_ = kRestlessAfterEvent;
    say("environment " + live_.environment().shown());
  }
  if (rig_.mode() == CameraRig::Mode::fly && !input_.captured()) toggleFlight();  // the focus went elsewhere
  const std::uint64_t changed = live_.switches() + live_.livesSet();
  if (std::exchange(changed_, changed) != changed) rest_.disturb();
  if (server_) server_->setChanges(changed + arrivals_);
  if (server_ && server_->wanted() && !live_.running()) server_->give("the files have errors: nothing runs");
  showState();
}

void Viewer::showState() {
  std::string title = "weft: " + renderer_.graphPath();
  const auto add = [&](const std::string& mode) { title += " (" + mode + ")"; };
  if (!live_.running())
    add("waiting: the files have errors");
  else if (live_.scene().loading())
    add("loading " + live_.scene().name());
  else if (!live_.good())
    add("the files have errors");
  if (title == title_) return;
  title_ = title;
  glfwSetWindowTitle(window_, title_.c_str());
}

bool Viewer::readsMouse() {
  return live_.running() && renderer_.execution()->followsPointer();
}

imports::Pointer Viewer::pointer() {
  const gl::TextureDesc picture = renderer_.execution()->presented().desc;
  return input_.pointer(picture.width, picture.height);
}

bool Viewer::busy() {
  if (!recording_.empty() || rig_.moving() || movingScale_ < 1 || rig_.cuts() != cuts_ || input_.captured() ||
      input_.movesCamera() || input_.waiting() || (server_ && server_->wanted()) ||
      live_.environment().loading() || live_.scene().loading())
    return true;
  if (readsMouse() && pointer() != pointer_) return true;
  // What moves counts also while it pauses or is out of view, because it will go on.
  if (frame_ > 0 && live_.running() && renderer_.execution()->drawsMotion()) return true;
  const scene::Camera* camera = sceneCamera();
  return rig_.mode() == CameraRig::Mode::scene && camera && scene::isMoving(*camera);
}

bool Viewer::mustDraw() {
  if (!live_.running()) {
    restless_ = kRestlessAfterEvent;
    return false;
  }
  if (!idle_) return true;
  if (busy()) rest_.disturb();
  return !rest_.resting();
}

void Viewer::frame() {
  const double begun = glfwGetTime();
  const FrameClock::Tick tick = clock_.tick(begun);
  moveCamera(tick);
  runtime::FrameInput in;
  in.frame = frame_;
  in.time = tick.time;
  in.deltaTime = tick.delta;
  in.pose = rig_.pose();
  in.previousPose = frame_ == 0 || cuts_ != rig_.cuts() ? in.pose : previousPose_;
  in.cutGeneration = cuts_ = rig_.cuts();
  if (readsMouse()) in.pointer = pointer_ = pointer();
  // A recording has the frames that `weft render` makes. The first frame of a window that waited does not fade in.
  in.headless = !options_.record.empty() || (options_.waitForAssets && frame_ == 0);
  panels_.beforeFrame(in.pose);
  runtime::StepRecorder steps;
  if (scan_)
    renderer_.execution()->watch(
        {.after = [&](std::uint32_t step) { steps.look(*renderer_.execution(), step); }});
  std::optional<FrameLook> look;
  if (server_ && server_->wanted() && !scan_) look.emplace(renderer_).begin(diagnostics_);
  report_ = renderer_.frame(live_.world(), in, diagnostics_);
  // While an import is on its way no pass runs, and a click is kept for the frame in which one does.
  if (!readsMouse() || report_.passesRun + report_.passesSkipped > 0) input_.pointerShown();
  if (report_.slowRun > 0) clock_.worked();
  previousPose_ = in.pose;
  ++frame_;
  if (look) servePage(*look);
  show();
  if (movingScale_ == 1) slow_[frame_ % 2] = glfwGetTime() - begun;
  panels_.afterFrame();
  if (std::exchange(scan_, false)) tellBroken(steps.take());
}

void Viewer::servePage(FrameLook& look) {
  const graph::Settings& settings = live_.settings();
  const std::vector<std::string> facts{
      fmt::format("{}x{}", settings.screenWidth, settings.screenHeight), fmt::format("frame {}", frame_ - 1),
      withoutFolder(live_.scene().path()), session_.context->device().renderer};
  text::Diagnostics said;
  for (const text::Diagnostic* each : log_.shown(true)) said.add(*each);
  auto state = look.end(renderer_.graphPath(), facts, said);
  if (report_.passesRun + report_.passesSkipped == 0) return;  // an import is on its way: the next frame
  const auto page =
      pageOf({{"command", command()}, {"live", changed_ + arrivals_}, {"states", {std::move(state)}}},
             renderer_.graphPath(), diagnostics_);
  server_->give(page.value_or("no page: see the messages of the viewer"));
}

void Viewer::tellBroken(const std::vector<runtime::StepRecord>& records) {
  renderer_.execution()->watch({});
  const auto first = std::ranges::find_if(records, [](const auto& each) { return each.broken > 0; });
  told_ = first == records.end()
              ? "no NaN and no infinity in what the passes write"
              : fmt::format("pass '{}' is the first with NaN or infinities: {:.3g} % of the texels of '{}'",
                            first->pass, 100 * first->broken, first->resource);
  say("scan " + told_);
  restless_ = kRestlessAfterEvent;
  if (first != records.end()) panels_.select(first->pass);
}

void Viewer::show() {
  if (!recording_.empty()) {
    if (recorder_.save(renderer_, *outputNameOf(recording_, recorded_), diagnostics_))
      ++recorded_;
    else
      stopRecording();
  }
  renderer_.present(area_.width, area_.height, area_.x, area_.y);
  finishFrame();
  if (!std::exchange(shown_, true)) say("shown");
  if (!idle_) return;
  judgeRest();
  if (std::exchange(resting_, rest_.resting()) != rest_.resting()) say(resting_ ? "resting" : "awake");
}

void Viewer::moveCamera(const FrameClock::Tick& tick) {
  CameraInput input = input_.takeCamera();
  const scene::Camera* camera = sceneCamera();
  if (camera && rig_.mode() == CameraRig::Mode::scene) {
    const scene::CameraPose pose = scene::poseAt(*camera, tick.time);
    // In another scene the camera may stand elsewhere. One that a person took stays where it is.
    if (sceneGeneration_ != live_.world().sceneGeneration() && pose != rig_.pose())
      rig_.jumpTo(pose);
    else
      rig_.follow(pose);
  }
  sceneGeneration_ = live_.world().sceneGeneration();
  const std::optional<scene::Ground>& ground = live_.world().scene().ground;
  rig_.ground = ground ? std::optional<double>(ground->height) : std::nullopt;
  rig_.advance(tick.delta, input);
}

void Viewer::judgeRest() {
  // After a pass that runs only when something changed, the picture may follow later (slices, a load in steps).
  if (report_.slowRun > 0) rest_.disturb();
  const double now = glfwGetTime();
  if (!rest_.wantsLook(now)) return;
  const auto image = renderer_.readPresented8();
  rest_.look(now, image ? text::hashBytes(
                              {reinterpret_cast<const char*>(image->texels.data()), image->texels.size()})
                        : 0);
}

void Viewer::redraw() {
  --restless_;
  ++redraws_;
  renderer_.present(area_.width, area_.height, area_.x, area_.y);
  finishFrame();
}

void Viewer::finishFrame() {
  saveScreenshot();
  tellFrame();
  drawUi();
  glfwSwapBuffers(window_);
}

void Viewer::drawUi(bool seen) {
  if (!overlay_) return;
  const std::uint64_t before = live_.changes();
  overlay_->begin();
  std::string modes;
  const auto add = [&](const std::string& mode) { modes += (modes.empty() ? "" : "  ") + mode; };
  if (!recording_.empty()) add(fmt::format("REC {}", recorded_));
  if (rig_.mode() == CameraRig::Mode::fly) add("FLY");
  if (idle_) add("IDLE");
  if (!vsync_) add("NO VSYNC");
  if (renderScale_ * movingScale_ != 1) add(fmt::format("scale {}", renderScale_ * movingScale_));
  const ui::LoopState state{frame_, clock_.last().time, clock_.paused(), modes, told_, recent_};
  const auto layOut = [&] {
    panels_.draw(report_, state, diagnostics_);
    wipe_.draw(area_);
    if (help_) drawHelp(keys_.help());
  };
  const std::uint64_t plan = live_.switches();
  layOut();
  const auto click = overlay_->releasedMouse();
  if (seen && live_.switches() != plan) {  // nothing of the plan before is seen
    overlay_->skip();
    overlay_->begin();
    layOut();
  }
  seen ? overlay_->end() : overlay_->skip();
  if (panels_.wantsFrame()) rest_.disturb();
  if (panels_.wantsLayout()) restless_ = std::max(restless_, 1);
  if (live_.changes() != before) {
    tell(diagnostics_, log_, ui::Log::kChange);
    say("change");
  }
  if (click) say(fmt::format("click {} {}", click->first, click->second));
}

void Viewer::saveScreenshot() {
  if (screenshot_.empty()) return;
  const std::string kind = std::exchange(screenshot_, {});
  std::string name = fmt::format("weft_{:05}{}", frame_, kind);
  for (int i = 2; text::isThere(name); ++i) name = fmt::format("weft_{:05}_{}{}", frame_, i, kind);
  if (!savePicture(name)) return;
  told_ = "wrote " + name;
  printNow(fmt::format("wrote {}\n", text::printable(name)));
}

bool Viewer::savePicture(const std::string& name) {
  PictureWriter writer;
  const bool saved = live_.running() && writer.save(renderer_, name, diagnostics_);
  writer.tell(diagnostics_);
  return saved;
}

void Viewer::tellFrame() {
  session_.context->drainMessages(diagnostics_);
  if (diagnostics_.empty()) return;
  log_.addPast(diagnostics_);
  broken_ |= report(diagnostics_) != 0;
  diagnostics_.clear();
}

}  // namespace weft::app
