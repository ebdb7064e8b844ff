// The environment of a window: the file that is shown, the one on its way, and the others of its folder. Loads on the loader
// thread and sends to the GPU a portion per frame; nothing here waits for the disk, a decoder or the GPU. (Going on to
// another file lists the folder: names only.) A failed load changes nothing but what is said.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/live/live_scene.h"
#include "engine/assets/environments/environment_map.h"
#include "engine/imports/environment/environment.h"

namespace weft::app {

// The file that `--environment` means: itself, or of a folder the first that can be read, in the order of
// names. Empty after an error (W150): there is none. A path that does not exist is left to whoever loads it.
std::optional<std::string> firstEnvironment(const std::string& fileOrFolder, text::Diagnostics& diagnostics);

class LiveEnvironment {
 public:
  using Map = imports::EnvironmentTextures::Map;

  // `path` is already shown.
  void assume(std::string path) { wanted_ = shown_ = std::move(path); }
  // Loads `path`, instead of whatever is on its way.
  void request(std::string path);
  // The one `by` files after the last one asked for, in the order of names,
  // round and round. False when there is no other.
  bool step(int by);

  // Once per frame: something came of the last request. A map is whole on the GPU and to be taken into use at
  // once; none: it failed, and `diagnostics` says why.
  struct Event {
    Map map;
  };
  std::optional<Event> poll(imports::EnvironmentTextures& textures, text::Diagnostics& diagnostics);

  // What is on its way.
  std::optional<LoadStatus> status() const;

  // To watch: the file that is shown and the one last asked for; empty names for none.
  const std::string& shown() const { return shown_; }
  const std::string& wanted() const { return wanted_; }

 private:
  std::string shown_, wanted_;
  bool loading_ = false;
  Map incoming_;            // decoded, being sent
  text::Diagnostics said_;  // while it was decoded
  float sent_ = 0;
  assets::Loader loader_{[](const std::string& path, text::Diagnostics& diagnostics,
                            const assets::LoadObserver& observer) -> std::shared_ptr<const void> {
    auto map = assets::loadEnvironmentMap(path, diagnostics, observer);
    return map ? std::make_shared<const assets::EnvironmentMap>(std::move(*map)) : nullptr;
  }};
};

}  // namespace weft::app
