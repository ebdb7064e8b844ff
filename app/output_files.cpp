#include "app/output_files.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <memory>

#include "engine/assets/image.h"

namespace weft::app {

std::optional<std::string> outputNameOf(const std::string& pattern, std::uint32_t frame) {
  const std::size_t at = pattern.find('%');
  if (at == std::string::npos) return pattern;
  std::size_t end = at + 1;
  std::string width;
  while (end < pattern.size() && pattern[end] >= '0' && pattern[end] <= '9') width += pattern[end++];
  if (end >= pattern.size() || pattern[end] != 'd' || pattern.find('%', end) != std::string::npos ||
      width.size() > 3)
    return std::nullopt;
  const int digits = width.empty() ? 0 : std::atoi(width.c_str());
  const std::string number = !width.empty() && width[0] == '0' ? fmt::format("{:0{}}", frame, digits)
                                                               : fmt::format("{:{}}", frame, digits);
  return pattern.substr(0, at) + number + pattern.substr(end + 1);
}

bool checkOutput(const std::string& pattern, std::uint32_t firstFrame, bool several,
                 base::Diagnostics& diagnostics) {
  const auto fail = [&](const std::string& message, const std::string& hint) {
    diagnostics.error(base::Code::W180, {std::make_shared<const std::string>(pattern), 0, 0}, message).hint =
        hint;
    return false;
  };
  const auto first = outputNameOf(pattern, firstFrame);
  if (!first)
    return fail(fmt::format("'{}' is no pattern for frame numbers", pattern), "write one %d or %04d");
  if (several && pattern.find('%') == std::string::npos)
    return fail(fmt::format("several frames would all be written to '{}'", pattern),
                "put a frame number into the name: f_%04d.png");
  const std::string extension = std::filesystem::path(*first).extension().string();
  if (extension != ".png" && extension != ".exr")
    return fail(fmt::format("cannot write '{}': unknown kind of image '{}'", *first, extension),
                "name a .png or an .exr file");
  std::error_code ec;
  const std::filesystem::path folder = std::filesystem::path(*first).parent_path();
  if (!folder.empty()) std::filesystem::create_directories(folder, ec);
  if (ec) return fail(fmt::format("cannot make the folder '{}': {}", folder.string(), ec.message()), "");
  if (std::filesystem::is_directory(*first))
    return fail(fmt::format("cannot write '{}': it is a directory", *first), "name a file");
  return true;
}

bool savePresented(runtime::Renderer& renderer, const std::string& path, base::Diagnostics& diagnostics) {
  if (path.ends_with(".exr")) {
    const auto image = renderer.readPresentedFloat();
    return image && assets::saveExr(path, *image, diagnostics);
  }
  const auto image = renderer.readPresented8();
  return image &&
         assets::savePng8(path, image->width, image->height, image->channels, image->texels, diagnostics);
}

}  // namespace weft::app
