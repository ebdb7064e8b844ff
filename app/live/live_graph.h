// A graph that follows its files: what the viewer shows, its settings, and the watch on all that was read. A change is validated whole;
// after an error the last good frame goes on, and the settings that led to it are taken back.
#pragma once

#include "app/live/live_loads.h"
#include "app/session/options.h"
#include "engine/graph/edit/edit.h"
#include "engine/runtime/frame/renderer.h"
#include "engine/text/files/file_watcher.h"

namespace weft::app {

class LiveGraph {
 public:
  // Reads nothing yet. `renderer` must outlive this. An environment that `world` expects is asked for: options.environment.
  LiveGraph(const Options& options, runtime::Renderer& renderer, runtime::World world,
            graph::Settings settings);

  // The scene of `world` stands in for that of the files, which is read beside the frames. Before the first load().
  void expectScene();
  // Reads everything but the environment again and switches to it. False after errors, and what ran goes on. A set or disable that the
  // graph does not take any more is left out with a warning; the first time it is an error.
  bool load(text::Diagnostics& diagnostics);
  // Loads when watched files changed: at once when they are good, else when they were quiet for a moment. A scene is read
  // beside the frames. `now` in seconds. True when something came of it that is to be reported.
  bool poll(double now, text::Diagnostics& diagnostics);
  // Whether files changed that poll() has not loaded yet; false while a scene is on its way.
  bool pending() const { return (graphStale_ && !scene_.loading()) || !changedEnvironment_.empty(); }
  // Once per frame: takes up an environment that has arrived. True when something came of the last request.
  bool pollEnvironment(text::Diagnostics& diagnostics);
  // Asks for the next (1) or previous (-1) environment of the folder. False when there is no other.
  bool stepEnvironment(int by);
  // The size of the screen. False when it is what it was.
  bool resize(std::uint32_t width, std::uint32_t height, text::Diagnostics& diagnostics);
  // These take the full name of a parameter, of a pass. A live parameter is set at once; everything else takes another
  // plan. False after errors, and nothing has changed.
  bool setParameter(const std::string& name, const graph::Value& value, text::Diagnostics& diagnostics);
  bool setEnabled(const std::string& pass, bool enabled, text::Diagnostics& diagnostics);

  // Goes back to what the files say, instead of what setParameter() said. False after errors.
  bool resetParameter(const std::string& name, text::Diagnostics& diagnostics);
  bool isChanged(const std::string& parameter) const;
  // How many changes made here are in no file.
  std::size_t unsaved() const;
  // What writing changed parameters and disabled passes into the files they come from would do. Nothing after errors.
  std::optional<graph::WriteBack> planWrites(text::Diagnostics& diagnostics);
  // Does it. False after errors, and nothing was written: also when a file is Weft's own (isWefts).
  bool write(const graph::WriteBack& plan, text::Diagnostics& diagnostics);
  // Whether a file belongs to what is installed, and is never written here.
  static bool isWefts(const std::string& file);
  // Writes what was changed into a new preset of the user's, and lays that over the graph. The file; nothing after errors.
  std::optional<std::string> savePreset(const std::string& name, text::Diagnostics& diagnostics);
  // Adds a camera "view_1", or a later number, to the scene file. False after errors.
  bool saveCamera(const scene::CameraPose& pose, text::Diagnostics& diagnostics);
  // Takes back the last change or write, and does it again; changes of one parameter up to endChange() are one. False when there is none.
  bool undo(text::Diagnostics& diagnostics) { return travel(undo_, redo_, diagnostics); }
  bool redo(text::Diagnostics& diagnostics) { return travel(redo_, undo_, diagnostics); }
  bool canUndo() const { return !undo_.empty(); }
  bool canRedo() const { return !redo_.empty(); }
  void endChange() { changing_.clear(); }
  // Another graph, scene or environment, or one more preset: what the file holds decides. False, and nothing has changed.
  bool open(const std::string& file, text::Diagnostics& diagnostics);
  // The next (1) or previous (-1) preset that the graph takes, of all that have names; instead of the last one, if that has a name. False when it takes none.
  bool stepPreset(int by, text::Diagnostics& diagnostics);

  // Everything that was read, or missed.
  std::vector<std::string> files() const;

  const runtime::World& world() const { return world_; }
  const graph::Settings& settings() const { return settings_; }
  const LiveEnvironment& environment() const { return environment_; }
  const LiveScene& scene() const { return scene_; }
  // Whether there is something to draw: some load was good.
  bool running() const { return renderer_.execution() != nullptr; }
  // Whether the files as they are on disk are what is shown.
  bool good() const { return good_ && environmentGood_; }
  // Whether the last load was refused for a scene that was opened: the one before comes back.
  bool wentBack() const { return wentBack_; }
  // Count switches to another plan, live parameters that were set, and calls of setParameter and setEnabled.
  std::uint64_t switches() const { return switches_; }
  std::uint64_t livesSet() const { return livesSet_; }
  std::uint64_t changes() const { return changes_; }

 private:
  // What a load that is not `final` finds wrong may come right by the next file that is saved: settings stay.
  enum class Attempt { early, final };
  // Whether files changed, and poll() is to load them now.
  bool wantsLoad(double now);
  bool tryLoad(Attempt attempt, text::Diagnostics& diagnostics);
  bool tryScene(runtime::World& world, text::Diagnostics& diagnostics);
  bool tryGraph(Attempt attempt, const runtime::World& world, text::Diagnostics& diagnostics);
  bool tryWorld(runtime::World world, text::Diagnostics& diagnostics);
  bool trySetLive(const std::string& name, const graph::Value& value);
  bool trySettings(graph::Settings settings, text::Diagnostics& diagnostics);
  void watch(text::Diagnostics* diagnostics = nullptr);
  bool change(graph::Settings settings, text::Diagnostics& diagnostics);
  // What ran before a change, and what is to be written to have it again.
  struct Moment {
    std::string graph;
    std::vector<std::string> presets;
    graph::Settings settings;
    graph::WriteBack files;
  };
  Moment now() const;
  // After a change. `name`: of the parameter that may go on changing.
  void remember(Moment before, const std::string& name = {});
  bool travel(std::vector<Moment>& from, std::vector<Moment>& to, text::Diagnostics& diagnostics);
  bool takeUp(Moment moment, text::Diagnostics& diagnostics);

  runtime::Renderer& renderer_;
  runtime::World world_;
  graph::Settings settings_;
  graph::Settings lost_;  // that the files, as they are, do not take: tried again at each load
  LiveScene scene_;
  LiveEnvironment environment_;
  std::vector<std::string> presetFolders_;
  text::FileWatcher watcher_;
  bool graphStale_ = false, good_ = false, environmentGood_ = true, wentBack_ = false;
  bool untried_ = false;              // as the files are since the last change
  std::string changedEnvironment_;    // to be loaded again, or empty
  double changedAt_ = 0, quiet_ = 0;  // seconds
  std::uint64_t switches_ = 0, livesSet_ = 0, changes_ = 0;
  std::vector<Moment> undo_, redo_;
  std::string changing_;  // the parameter whose changes are one
};

}  // namespace weft::app
