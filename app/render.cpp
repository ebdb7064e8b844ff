// weft render: frames of a graph to image files, reproducible to the byte.
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/device_session.h"
#include "app/session.h"

namespace weft::app {

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// "f_%04d.png" with the frame number; the name as it is when it has no pattern.
std::optional<std::string> outputOf(const std::string& pattern, std::uint32_t frame) {
  const std::size_t at = pattern.find('%');
  if (at == std::string::npos) return pattern;
  std::size_t end = at + 1;
  std::string width;
  while (end < pattern.size() && pattern[end] >= '0' && pattern[end] <= '9') width += pattern[end++];
  if (end >= pattern.size() || pattern[end] != 'd' || pattern.find('%', end) != std::string::npos || width.size() > 3)
    return std::nullopt;
  const int digits = width.empty() ? 0 : std::atoi(width.c_str());
  const std::string number =
      !width.empty() && width[0] == '0' ? fmt::format("{:0{}}", frame, digits) : fmt::format("{:{}}", frame, digits);
  return pattern.substr(0, at) + number + pattern.substr(end + 1);
}

bool checkOutput(const Options& options, base::Diagnostics& diagnostics) {
  const auto fail = [&](const std::string& message, const std::string& hint) {
    diagnostics.error(base::Code::W180, {std::make_shared<const std::string>(options.output), 0, 0}, message).hint = hint;
    return false;
  };
  const auto first = outputOf(options.output, options.firstFrame);
  if (!first) return fail(fmt::format("'{}' is no pattern for frame numbers", options.output), "write one %d or %04d");
  const bool several = options.lastFrame > options.firstFrame;
  if (several && options.output.find('%') == std::string::npos)
    return fail(fmt::format("{} frames would all be written to '{}'", options.lastFrame - options.firstFrame + 1, options.output),
                "put a frame number into the name: f_%04d.png");
  const std::string extension = std::filesystem::path(*first).extension().string();
  if (extension != ".png" && extension != ".exr")
    return fail(fmt::format("cannot write '{}': unknown kind of image '{}'", *first, extension), "name a .png or an .exr file");
  std::error_code ec;
  const std::filesystem::path folder = std::filesystem::path(*first).parent_path();
  if (!folder.empty()) std::filesystem::create_directories(folder, ec);
  if (ec) return fail(fmt::format("cannot make the folder '{}': {}", folder.string(), ec.message()), "");
  if (std::filesystem::is_directory(*first)) return fail(fmt::format("cannot write '{}': it is a directory", *first), "name a file");
  return true;
}

bool save(runtime::Renderer& renderer, const std::string& path, base::Diagnostics& diagnostics) {
  if (path.ends_with(".exr")) {
    const auto image = renderer.readPresentedFloat();
    return image && assets::saveExr(path, *image, diagnostics);
  }
  const auto image = renderer.readPresented8();
  return image && assets::savePng8(path, image->width, image->height, image->channels, image->texels, diagnostics);
}

void showProgress(std::uint32_t done, std::uint32_t total, double seconds) {
  const int width = 40;
  const int filled = static_cast<int>(std::uint64_t{done} * width / total);
  const double rest = done ? seconds / done * (total - done) : 0;
  fmt::print(stderr, "\r[{}{}] {}/{} frames, {:.1f} s left ", std::string(static_cast<std::size_t>(filled), '#'),
             std::string(static_cast<std::size_t>(width - filled), '.'), done, total, rest);
  if (done == total) std::fputc('\n', stderr);
  std::fflush(stderr);
}

}  // namespace

int runRender(const Options& options) {
  const double start = now();
  base::Diagnostics diagnostics;
  checkOutput(options, diagnostics);
  auto world = loadWorld(options, diagnostics);
  if (!world || diagnostics.hasErrors()) {
    // The graph's own mistakes are reported in the same run.
    makePlan(options, world ? world->facts() : factsWithoutWorld(), true, diagnostics);
    return report(diagnostics);
  }
  auto session = openDevice(options, diagnostics);
  if (!session) return report(diagnostics) ? 3 : 3;
  if (!session->renderer.load(settingsOf(options, session->context->device().software), *world, diagnostics))
    return report(diagnostics);
  if (session->renderer.execution()->presented().id == 0) {
    diagnostics.error(base::Code::W188, {std::make_shared<const std::string>(options.graph), 1, 1},
                      "the graph presents nothing to write").hint = "add \"present\": \"<texture>\"";
    return report(diagnostics);
  }
  const double prepared = now();
  double firstFrame = 0;
  const bool progress = options.lastFrame > 0 && !options.quiet;  // frames before the first one written run too
  session->renderer.device().timers.setEnabled(options.profile);
  runtime::FrameReport last;
  // Every frame from 0 runs, so that frame N with history does not depend on where the range starts.
  for (std::uint32_t frame = 0; frame <= options.lastFrame; ++frame) {
    const double before = now();
    last = session->renderer.frame(*world, runtime::headlessFrame(*world, frame, options.fps), diagnostics);
    session->context->debugLog().drain(diagnostics);
    if (frame == 0) {
      glFinish();
      firstFrame = now() - before;
    }
    if (progress) showProgress(frame + 1, options.lastFrame + 1, now() - prepared);
    if (frame < options.firstFrame) continue;
    if (diagnostics.hasErrors() || !save(session->renderer, *outputOf(options.output, frame), diagnostics)) return report(diagnostics);
  }
  session->context->debugLog().drain(diagnostics);
  if (options.stats) printStats(*session, {{"setup_ms", (prepared - start) * 1e3},
                                           {"first_frame_ms", firstFrame * 1e3},
                                           {"total_ms", (now() - start) * 1e3},
                                           {"passes_run_last_frame", last.passesRun},
                                           {"passes_skipped_last_frame", last.passesSkipped},
                                           {"barriers_last_frame", last.barriers}});
  return report(diagnostics);
}

}  // namespace weft::app
