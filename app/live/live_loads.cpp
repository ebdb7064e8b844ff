#include "app/live/live_loads.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app_sentences.h"
#include "engine/text/files/file.h"

namespace weft::app {

namespace {

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
                                                const std::stop_token& stop) {
        return read(file, file == first ? chosen : scene::SceneChoice{}, stop);
      }) {}

std::shared_ptr<const LiveScene::Loaded> LiveScene::read(const std::string& path,
                                                         const scene::SceneChoice& choice,
                                                         const std::stop_token& stop) {
  auto loaded = std::make_shared<Loaded>();
  loaded->scene = scene::loadScene(path, loaded->said, &loaded->files, choice, stop);
  return loaded;
}

bool LiveScene::goBack() {
  if (!before_) return false;
  std::tie(path_, choice_, files_) = *std::exchange(before_, {});
  outdate();
  return true;
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

std::optional<std::string> firstEnvironment(const std::string& fileOrFolder, text::Diagnostics& diagnostics) {
  if (!text::isFolder(fileOrFolder)) {
    const bool there = text::isThere(fileOrFolder);
    if (!there) assets::loadEnvironmentMap(fileOrFolder, diagnostics);  // says so
    return there ? std::optional(fileOrFolder) : std::nullopt;
  }
  const std::vector<std::string> files = listEnvironments(fileOrFolder);
  if (!files.empty()) return files.front();
  diagnostics.error(say::noEnvironmentInFolder, {fileOrFolder}, fileOrFolder);
  return std::nullopt;
}

void LiveEnvironment::request(std::string path) {
  wanted_ = std::move(path);
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

std::optional<LiveEnvironment::Map> LiveEnvironment::poll(text::Diagnostics& diagnostics) {
  const auto result = loader_.poll();
  if (!result) return std::nullopt;
  loading_ = false;
  Map map = result->as<assets::EnvironmentMap>();
  if (map && !imports::EnvironmentProvider::create(*map, diagnostics)) return nullptr;
  diagnostics.append(result->diagnostics);
  if (map) shown_ = wanted_;
  return map;
}

}  // namespace weft::app
