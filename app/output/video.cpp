#include "app/output/video.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

#include "app/output/output_files.h"
#include "app_sentences.h"
#include "engine/text/apart.h"
#include "engine/text/chars.h"
#include "engine/text/files/file.h"

namespace weft::app {

namespace {

constexpr const char* kLossless = "-c:v ffv1 -level 3 -pix_fmt bgr0 -f matroska";
constexpr const char* kSmall =
    "-vf scale=out_color_matrix=bt709:out_range=tv,format=yuv420p -c:v libx264 -crf 16 -colorspace bt709 "
    "-color_primaries bt709 -color_trc iec61966-2-1 -movflags +faststart -f mp4";

// The last lines of what ffmpeg said.
std::string lastLines(int file) {
  constexpr off_t kMost = 1000;
  const off_t size = ::lseek(file, 0, SEEK_END), begin = std::max<off_t>(0, size - kMost);
  std::string bytes(static_cast<std::size_t>(size - begin), '\0');
  bytes.resize(
      static_cast<std::size_t>(std::max<ssize_t>(0, ::pread(file, bytes.data(), bytes.size(), begin))));
  std::vector<std::string> lines;
  for (std::string_view rest = bytes; !rest.empty();)
    if (const std::string_view line = text::trimmed(text::takeLine(rest)); !line.empty())
      lines.emplace_back(line);
  const std::size_t count = std::min<std::size_t>(3, lines.size());
  return fmt::format("{}", fmt::join(lines.end() - static_cast<std::ptrdiff_t>(count), lines.end(), "; "));
}

}  // namespace

bool isVideo(const std::string& path) {
  const std::string kind = text::lowerExtension(path);
  return kind == ".mp4" || kind == ".mkv";
}

std::unique_ptr<Video> Video::start(const std::string& path, std::uint32_t width, std::uint32_t height,
                                    double fps, text::Diagnostics& diagnostics) {
  if (text::lowerExtension(path) == ".mp4" && (width % 2 != 0 || height % 2 != 0)) {
    refuseOutput(diagnostics, say::oddSizeOfMp4, path, path, width, height, width + width % 2,
                 height + height % 2);
    return nullptr;
  }
  std::string line = fmt::format(
      "ffmpeg -hide_banner -loglevel error -xerror -nostats -y -f rawvideo -pix_fmt rgba -video_size {}x{} "
      "-framerate {} "
      "-i pipe:0 -map_metadata -1 -fflags +bitexact -flags:v +bitexact {}",
      width, height, fps, text::lowerExtension(path) == ".mkv" ? kLossless : kSmall);
  std::vector<std::string> command;
  for (std::string_view rest = line; !rest.empty();) command.emplace_back(text::takeWord(rest));
  if (!makeFolderOf(path, diagnostics)) return nullptr;
  auto video = std::unique_ptr<Video>(new Video(path));
  command.push_back("file:" + video->file_.name());
  return video->run(std::move(command), diagnostics) ? std::move(video) : nullptr;
}

bool Video::run(std::vector<std::string> command, text::Diagnostics& diagnostics) {
  if (file_.error() == EWOULDBLOCK)
    return refuse("another run is writing it", "name another file", diagnostics);
  if (file_.error() != 0)
    return refuse(std::strerror(file_.error()), "name a file in a folder that can be written to",
                  diagnostics);
  int ends[2] = {-1, -1};
  errors_ = ::memfd_create("ffmpeg", MFD_CLOEXEC);
  if (errors_ >= 0 && ::pipe2(ends, O_CLOEXEC) == 0)
    process_ = text::startProcess(std::move(command), ends[0], -1, errors_);
  const int error = errno;
  pipe_ = ends[1];
  ::close(ends[0]);
  return process_ >= 0 ||
         refuse(fmt::format("the program ffmpeg cannot be started: {}", std::strerror(error)),
                "install it (apt-get install ffmpeg), or write pictures: f_%04d.png", diagnostics);
}

bool Video::refuse(const std::string& why, const std::string& hint, text::Diagnostics& diagnostics) const {
  return refuseOutput(diagnostics, say::cannotWrite, path_, path_, why, hint);
}

// Waits for ffmpeg. False after W180, when it failed, or when it ended before the film did.
bool Video::end(bool early, text::Diagnostics& diagnostics) {
  ::close(std::exchange(pipe_, -1));
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  if (!early && WIFEXITED(status) && WEXITSTATUS(status) == 0) return true;
  const std::string how = WIFSIGNALED(status) ? fmt::format("signal {}", WTERMSIG(status))
                                              : fmt::format("exit code {}", WEXITSTATUS(status));
  diagnostics.error(say::ffmpegFailed, {path_}, path_, how, lastLines(errors_));
  return false;
}

bool Video::add(const assets::Image8& picture, text::Diagnostics& diagnostics) {
  for (std::span<const std::uint8_t> bytes = picture.texels; !bytes.empty();) {
    const ssize_t got = ::write(pipe_, bytes.data(), bytes.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return end(true, diagnostics);
    bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
  return true;
}

bool Video::finish(text::Diagnostics& diagnostics) {
  if (!end(false, diagnostics)) return false;
  std::error_code ec;
  if (std::filesystem::file_size(file_.name(), ec) == 0)
    return refuse("the program ffmpeg wrote nothing", "see which program has that name: command -v ffmpeg",
                  diagnostics);
  return (file_.putInPlace() || refuse(std::strerror(file_.error()), "name another file", diagnostics));
}

Video::~Video() {
  if (pipe_ >= 0) ::close(pipe_);
  if (errors_ >= 0) ::close(errors_);
  if (process_ < 0) return;
  ::kill(process_, SIGKILL);
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

}  // namespace weft::app
