#include "app/live/live_environment.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

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

std::optional<std::string> firstEnvironment(const std::string& fileOrFolder, text::Diagnostics& diagnostics) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(fileOrFolder, ignored)) return fileOrFolder;
  const std::vector<std::string> files = listEnvironments(fileOrFolder);
  if (!files.empty()) return files.front();
  text::Diagnostic& d =
      diagnostics.error(text::Code::unreadableImage, {std::make_shared<const std::string>(fileOrFolder)},
                        fmt::format("there is no environment in the folder '{}'", fileOrFolder));
  d.expected = "a .hdr or .exr file in it";
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

std::optional<LiveEnvironment::Event> LiveEnvironment::poll(imports::EnvironmentTextures& textures,
                                                            text::Diagnostics& diagnostics) {
  if (auto result = loader_.poll()) {
    loading_ = false;
    incoming_ = result->as<assets::EnvironmentMap>();
    said_ = std::move(result->diagnostics);
    if (!incoming_) {
      diagnostics.append(said_);
      textures.stopSending();
      return Event{};
    }
  }
  if (!incoming_) return std::nullopt;
  const std::optional<float> sent = textures.send(incoming_, diagnostics);
  if (!sent) {
    incoming_ = nullptr;
    textures.stopSending();
    return Event{};
  }
  sent_ = *sent;
  if (sent_ < 1) return std::nullopt;
  diagnostics.append(said_);
  shown_ = wanted_;
  return Event{std::exchange(incoming_, nullptr)};
}

std::optional<LoadStatus> LiveEnvironment::status() const {
  const std::string name = std::filesystem::path(wanted_).filename().string();
  if (incoming_) return LoadStatus{name, "sending", kLoadingShare + (1 - kLoadingShare) * sent_};
  if (!loading_) return std::nullopt;
  const assets::LoadProgress progress = loader_.progress();
  return LoadStatus{name, assets::nameOf(progress.stage), kLoadingShare * progress.done};
}

}  // namespace weft::app
