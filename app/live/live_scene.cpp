#include "app/live/live_scene.h"

#include <filesystem>
#include <utility>

namespace weft::app {

namespace {

constexpr std::uint32_t kSceneChannel = 1;  // a request replaces the one before

}  // namespace

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
  if (ticket_ != 0) loader_.cancel(std::exchange(ticket_, 0));
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
  if (ticket_ != 0) loader_.cancel(std::exchange(ticket_, 0));
  auto loaded = std::make_shared<Loaded>();
  text::Diagnostics said;
  loaded->scene = scene::loadScene(path_, said, &loaded->files, choice_);
  take(std::move(loaded), std::move(said));
}

void LiveScene::request() {
  if (arrived_ || ticket_ != 0) return;
  ticket_ = loader_.request(path_, kSceneChannel);
  ++reads_;
}

bool LiveScene::arrived() {
  if (arrived_) return true;
  request();
  while (auto result = loader_.poll()) {
    if (result->ticket != ticket_) continue;
    ticket_ = 0;
    take(result->as<Loaded>(), std::move(result->diagnostics));
    return true;
  }
  return false;
}

const scene::Scene* LiveScene::scene(text::Diagnostics& diagnostics) const {
  if (!arrived_) return nullptr;
  diagnostics.append(said_);
  return arrived_->scene ? &*arrived_->scene : nullptr;
}

std::optional<LoadStatus> LiveScene::status() const {
  if (ticket_ == 0) return std::nullopt;
  const assets::LoadProgress progress = loader_.progress(ticket_);
  return LoadStatus{name(), assets::nameOf(progress.stage), progress.done};
}

}  // namespace weft::app
