#include "app/live/live_scene.h"

#include <filesystem>
#include <utility>

namespace weft::app {

LiveScene::LiveScene(std::string path, scene::SceneChoice choice, std::vector<std::string> files)
    : path_(std::move(path)),
      choice_(std::move(choice)),
      files_(std::move(files)),
      loader_([chosen = choice_](const std::string& file, text::Diagnostics& diagnostics,
                                 const assets::LoadObserver& observer) -> std::shared_ptr<const void> {
        auto loaded = std::make_shared<Loaded>();
        loaded->scene = scene::loadScene(file, diagnostics, &loaded->files, chosen, observer);
        return loaded;
      }) {}

std::string LiveScene::name() const {
  return std::filesystem::path(path_).filename().string();
}

void LiveScene::outdate() {
  outdated_ = true;
  slow_.reset();
  arrived_ = nullptr;
  if (std::exchange(loading_, false)) loader_.cancel();
}

bool LiveScene::slow() {
  if (!slow_) slow_ = scene::namesModels(path_);
  return *slow_;
}

void LiveScene::settle() {
  outdated_ = false;
  arrived_ = nullptr;
}

void LiveScene::take(std::shared_ptr<const Loaded> loaded, text::Diagnostics diagnostics) {
  arrived_ = std::move(loaded);
  said_ = std::move(diagnostics);
  files_ = arrived_->files;
}

void LiveScene::readNow() {
  if (std::exchange(loading_, false)) loader_.cancel();
  auto loaded = std::make_shared<Loaded>();
  text::Diagnostics said;
  loaded->scene = scene::loadScene(path_, said, &loaded->files, choice_);
  take(std::move(loaded), std::move(said));
}

void LiveScene::request() {
  if (arrived_ || loading_) return;
  loading_ = true;
  loader_.request(path_);
  ++reads_;
}

bool LiveScene::arrived() {
  if (arrived_) return true;
  request();
  auto result = loader_.poll();
  if (!result) return false;
  loading_ = false;
  take(result->as<Loaded>(), std::move(result->diagnostics));
  return true;
}

const scene::Scene* LiveScene::scene(text::Diagnostics& diagnostics) const {
  if (!arrived_) return nullptr;
  diagnostics.append(said_);
  return arrived_->scene ? &*arrived_->scene : nullptr;
}

std::optional<LoadStatus> LiveScene::status() const {
  if (!loading_) return std::nullopt;
  const assets::LoadProgress progress = loader_.progress();
  return LoadStatus{name(), assets::nameOf(progress.stage), progress.done};
}

}  // namespace weft::app
