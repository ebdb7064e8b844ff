#include "app/live/live_loads.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app_sentences.h"
#include "engine/text/files/file.h"

namespace weft::app {

namespace {

constexpr float kLoadingShare = 0.8f;  // of the bar; the rest is sending

std::vector<std::string> listEnvironments(const std::filesystem::path& folder) {
  std::vector<std::string> files;
  std::error_code ec, ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ec))
    if (assets::isEnvironmentName(entry.path().string()) && entry.is_regular_file(ignored))
      files.push_back(entry.path().string());
  std::ranges::sort(files);
  return files;
}

}  // namespace

LiveScene::LiveScene(std::string path, scene::SceneChoice choice, std::vector<std::string> files)
    : path_(std::move(path)),
      choice_(std::move(choice)),
      files_(std::move(files)),
      loader_([first = path_, chosen = choice_](const std::string& file, text::Diagnostics&,
                                                const assets::LoadObserver& observer) {
        return read(file, file == first ? chosen : scene::SceneChoice{}, observer);
      }) {}

std::shared_ptr<const LiveScene::Loaded> LiveScene::read(const std::string& path,
                                                         const scene::SceneChoice& choice,
                                                         const assets::LoadObserver& observer) {
  auto loaded = std::make_shared<Loaded>();
  loaded->scene = scene::loadScene(path, loaded->said, &loaded->files, choice, observer);
  return loaded;
}

void LiveScene::outdate() {
  outdated_ = true;
  arrived_ = nullptr;
  if (std::exchange(loading_, false)) loader_.cancel();
}

void LiveScene::request() {
  if (arrived_ || loading_) return;
  loading_ = true;
  loader_.request(path_);
}

bool LiveScene::arrived() {
  if (arrived_) return true;
  request();
  const auto result = loader_.poll();
  if (!result) return false;
  loading_ = false;
  arrived_ = result->as<Loaded>();
  files_ = arrived_->files;
  return true;
}

const scene::Scene* LiveScene::scene(text::Diagnostics& diagnostics) {
  if (!arrived_) {
    arrived_ = read(path_, choice_);
    files_ = arrived_->files;
  }
  diagnostics.append(arrived_->said);
  return arrived_->scene ? &*arrived_->scene : nullptr;
}

std::optional<LoadStatus> LiveScene::status() const {
  if (!loading_) return std::nullopt;
  const assets::LoadProgress progress = loader_.progress();
  return LoadStatus{std::filesystem::path(path_).filename().string(), assets::nameOf(progress.stage),
                    progress.done};
}

std::optional<std::string> firstEnvironment(const std::string& fileOrFolder, text::Diagnostics& diagnostics) {
  if (!text::isFolder(fileOrFolder)) return fileOrFolder;
  const std::vector<std::string> files = listEnvironments(fileOrFolder);
  if (!files.empty()) return files.front();
  diagnostics.error(say::noEnvironmentInFolder, {fileOrFolder}, fileOrFolder);
  return std::nullopt;
}

void LiveEnvironment::request(std::string path) {
  wanted_ = std::move(path);
  incoming_ = nullptr;
  sent_ = 0;
  loading_ = true;
  loader_.request(wanted_);
}

bool LiveEnvironment::step(int by) {
  if (wanted_.empty()) return false;
  const std::filesystem::path folder = std::filesystem::path(wanted_).parent_path();
  const std::vector<std::string> files = listEnvironments(folder.empty() ? "." : folder);
  const auto here =
      std::ranges::find(files, std::filesystem::path(wanted_).filename(),
                        [](const std::string& file) { return std::filesystem::path(file).filename(); });
  if (files.empty() || (files.size() == 1 && here != files.end())) return false;
  const auto count = static_cast<std::ptrdiff_t>(files.size());
  const std::ptrdiff_t at = here != files.end() ? here - files.begin() + by : 0;
  request(files[static_cast<std::size_t>((at % count + count) % count)]);
  return true;
}

std::optional<LiveEnvironment::Map> LiveEnvironment::poll(imports::EnvironmentProvider& provider,
                                                          text::Diagnostics& diagnostics) {
  auto result = loader_.poll();
  if (result) {
    loading_ = false;
    incoming_ = result->as<assets::EnvironmentMap>();
    said_ = std::move(result->diagnostics);
  }
  if (!result && !incoming_) return std::nullopt;
  const std::optional<float> sent = incoming_ ? provider.send(incoming_, diagnostics) : std::nullopt;
  if (sent && (sent_ = *sent) < 1) return std::nullopt;
  if (!incoming_ || sent) diagnostics.append(said_);
  if (sent)
    shown_ = wanted_;
  else
    provider.stopSending();
  return sent ? std::exchange(incoming_, nullptr) : (incoming_ = nullptr);
}

std::optional<LoadStatus> LiveEnvironment::status() const {
  const std::string name = std::filesystem::path(wanted_).filename().string();
  if (incoming_) return LoadStatus{name, "sending", kLoadingShare + (1 - kLoadingShare) * sent_};
  if (!loading_) return std::nullopt;
  const assets::LoadProgress progress = loader_.progress();
  return LoadStatus{name, assets::nameOf(progress.stage), kLoadingShare * progress.done};
}

}  // namespace weft::app
