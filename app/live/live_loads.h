// What a window loads beside its frames: its scene and its environment. Nothing here waits for the disk or a decoder.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/assets/images/image.h"
#include "engine/assets/loading/loader.h"
#include "engine/imports/environment/environment.h"
#include "engine/scene/files/scene_file.h"

namespace weft::app {

// The scene of a window: the file that is followed, and its loading beside the frames. Models are read, decoded and converted
// on a loader thread. What arrived stays until the files change again, so that it can be tried with one graph after another.
class LiveScene {
 public:
  // `files`: of the scene that is shown.
  LiveScene(std::string path, scene::SceneChoice choice, std::vector<std::string> files);

  const std::string& path() const { return path_; }
  std::string name() const { return std::filesystem::path(path_).filename().string(); }
  // Everything that was read or should have been, also after errors: what to watch.
  const std::vector<std::string>& files() const { return files_; }

  // Another file from now on, as when the one before had changed.
  void choose(std::string path) {
    if (!before_) before_.emplace(path_, choice_, files_);
    path_ = std::move(path);
    files_ = {path_};
    choice_ = {};
    outdate();
  }
  // The file before, as when it had changed. False unless another one was chosen and is not shown yet.
  bool goBack();
  // To be called when the files have changed since they were read: what arrived, or is on its way, is out of date.
  void outdate();
  bool outdated() const { return outdated_; }
  // What is in the files is shown.
  void settle() {
    outdated_ = false;
    arrived_ = nullptr;
    before_.reset();
  }

  // Begins to read the scene beside the frames. Even when it is read at once, only arrived() takes it.
  void request();
  // Whether what is in the files has arrived; else it is on its way from now on. Never waits.
  bool arrived();
  bool loading() const { return loading_; }
  // What arrived, with what is to be said of it; null after errors. Read at once where nothing has.
  const scene::Scene* scene(text::Diagnostics& diagnostics);

 private:
  struct Loaded {
    std::optional<scene::Scene> scene;
    std::vector<std::string> files;
    text::Diagnostics said;
  };
  static std::shared_ptr<const Loaded> read(const std::string& path, const scene::SceneChoice& choice,
                                            const std::stop_token& stop = {});

  std::string path_;
  scene::SceneChoice choice_;  // of the first file
  std::vector<std::string> files_;
  std::optional<std::tuple<std::string, scene::SceneChoice, std::vector<std::string>>> before_;
  bool outdated_ = false;
  bool loading_ = false;
  std::shared_ptr<const Loaded> arrived_;  // null: not yet
  assets::Loader loader_;
};

// The file that `--environment` means: itself, or the first of a folder. Empty after W150: it is not there, or there is none.
std::optional<std::string> firstEnvironment(const std::string& fileOrFolder, text::Diagnostics& diagnostics);

// The environment of a window: the file that is shown, the one on its way, and the others of its folder. Loads on the loader
// thread. A failed load changes nothing but what is said.
class LiveEnvironment {
 public:
  using Map = std::shared_ptr<const assets::EnvironmentMap>;

  // `path` is already shown.
  void assume(std::string path) { wanted_ = shown_ = std::move(path); }
  // Loads `path`, instead of whatever is on its way.
  void request(std::string path);
  // The one `by` files after the last one asked for, in a circle, by name. False when there is no other.
  bool step(int by);

  // Once per frame: something came of the last request. A map, for which the GPU has room; null: it failed, and `diagnostics` says why.
  std::optional<Map> poll(text::Diagnostics& diagnostics);

  // Whether wanted() is on its way.
  bool loading() const { return loading_; }

  // To watch: the file that is shown and the one last asked for; empty names for none.
  const std::string& shown() const { return shown_; }
  const std::string& wanted() const { return wanted_; }
  std::string wantedName() const { return std::filesystem::path(wanted_).filename().string(); }

 private:
  std::string shown_, wanted_;
  bool loading_ = false;
  assets::Loader loader_{[](const std::string& path, text::Diagnostics& diagnostics,
                            const std::stop_token& stop) -> std::shared_ptr<const void> {
    auto map = assets::loadEnvironmentMap(path, diagnostics, stop);
    return map ? std::make_shared<const assets::EnvironmentMap>(std::move(*map)) : nullptr;
  }};
};

}  // namespace weft::app
