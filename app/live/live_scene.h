// The scene of a window: the file that is followed, and its loading beside the frames. Models are read, decoded and converted
// on a loader thread; nothing here waits for the disk or a decoder. What arrived stays until the files change again, so that
// it can be tried with one graph after another.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/assets/loading/loader.h"
#include "engine/scene/files/scene_file.h"

namespace weft::app {

// What is on its way.
struct LoadStatus {
  std::string name;   // of the file, without folders
  const char* stage;  // "reading"
  float done = 0;     // 0 to 1
};

class LiveScene {
 public:
  // `files`: of the scene that is shown.
  LiveScene(std::string path, scene::SceneChoice choice, std::vector<std::string> files);

  const std::string& path() const { return path_; }
  std::string name() const;  // without folders
  // Everything that was read or should have been, also after errors: what to watch.
  const std::vector<std::string>& files() const { return files_; }

  // To be called when the files have changed since they were read: what arrived, or is on its way, is out of date.
  void outdate();
  bool outdated() const { return outdated_; }
  // What is in the files is shown.
  void settle();

  // Whether what is in the files may take long to read: a scene with models. Others are there sooner than a frame.
  bool slow();
  // Reads the scene at once: for when there is nothing to keep showing, or reading is not slow.
  void readNow();
  // Begins to read the scene beside the frames. Even when it is read at once, only arrived() takes it.
  void request();
  // Whether what is in the files has arrived; else it is on its way from now on. Never waits.
  bool arrived();
  bool ready() const { return arrived_ != nullptr; }
  bool loading() const { return loading_; }
  // How many times that was begun beside the frames.
  std::uint64_t reads() const { return reads_; }
  // What arrived, with what is to be said of it; null after errors.
  const scene::Scene* scene(text::Diagnostics& diagnostics) const;

  std::optional<LoadStatus> status() const;

 private:
  // What the loader makes, also after errors.
  struct Loaded {
    std::optional<scene::Scene> scene;
    std::vector<std::string> files;
  };
  void take(std::shared_ptr<const Loaded> loaded, text::Diagnostics diagnostics);

  std::string path_;
  scene::SceneChoice choice_;
  std::vector<std::string> files_;
  bool outdated_ = false;
  std::optional<bool> slow_;  // as the files are; empty: nobody asked
  bool loading_ = false;
  std::uint64_t reads_ = 0;
  std::shared_ptr<const Loaded> arrived_;  // null: not yet
  text::Diagnostics said_;                 // while it was read
  assets::Loader loader_;
};

}  // namespace weft::app
