#include "app/output/pictures.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "app/output/output_files.h"
#include "app/output/standard_streams.h"
#include "app_sentences.h"
#include "engine/text/files/file.h"
#include "engine/text/json/edit.h"
#include "engine/text/printable.h"

namespace weft::app {

namespace {

// Nothing of it ends an element.
std::string escaped(std::string_view text, std::string_view forLess) {
  std::string out;
  for (const char c : text) out += c == '<' ? std::string(forLess) : std::string(1, c);
  return out;
}

}  // namespace

bool savePng(const std::string& path, const assets::Image8& image, text::Diagnostics& diagnostics) {
  return makeFolderOf(path, diagnostics) &&
         assets::savePng8(path, image.width, image.height, image.channels, image.texels, diagnostics);
}

bool saveInspected(runtime::Inspector& inspector, const std::string& path, text::Diagnostics& diagnostics,
                   Video* video) {
  if (inspector.picture().id == 0) {
    const std::vector<std::byte> bytes = inspector.bytes(0, inspector.bufferBytes());
    return makeFolderOf(path, diagnostics) &&
           text::writeFile(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, diagnostics);
  }
  if (text::lowerExtension(path) != ".exr") {
    const auto image = inspector.drawWhole(inspector.fittedView(), diagnostics);
    return image && (video ? video->add(*image, diagnostics) : savePng(path, *image, diagnostics));
  }
  auto image = inspector.values();
  if (!image || !makeFolderOf(path, diagnostics)) return false;
  if (image->channels == 2) {  // .exr files have one channel, three or four
    assets::ImageF wide{image->width, image->height, 3, {}};
    for (std::size_t i = 0; i < image->texels.size(); i += 2)
      wide.texels.insert(wide.texels.end(), {image->texels[i], image->texels[i + 1], 0.0f});
    image = std::move(wide);
  }
  return assets::saveExr(path, *image, diagnostics);
}

void PictureWriter::look(const assets::ImageF& picture, runtime::Renderer& renderer,
                         const std::string& file) {
  Found found;
  const auto channels = static_cast<std::size_t>(picture.channels);
  for (std::size_t at = 0; at < picture.texels.size(); at += channels) {
    bool nan = false, infinite = false;
    for (std::size_t c = 0; c < channels; ++c) {
      nan |= std::isnan(picture.texels[at + c]);
      infinite |= std::isinf(picture.texels[at + c]);
    }
    if (!nan && !infinite) continue;
    if (found.pixels++ == 0) {
      const auto pixel = static_cast<int>(at / channels);
      found.x = pixel % picture.width;
      found.y = pixel / picture.width;
    }
    ++(nan ? found.nan : found.infinite);
  }
  if (found.pixels == 0) return;
  ++counts_.broken;
  counts_.pixels += found.pixels;
  if (first_.pixels > 0) return;
  found.file = file;
  const graph::FlatGraph& graph = *renderer.execution()->plan().graph;
  found.resource = graph.resourceNames[graph.present.resource];
  first_ = std::move(found);
}

bool PictureWriter::save(runtime::Renderer& renderer, const std::string& path, text::Diagnostics& diagnostics,
                         Video* video) {
  const bool values = text::lowerExtension(path) == ".exr";
  bool good = false;
  if (const auto image = renderer.readPresentedFloat()) {
    look(*image, renderer, path);
    good = video    ? video->add(runtime::toBytes(*image), diagnostics)
           : values ? makeFolderOf(path, diagnostics) && assets::saveExr(path, *image, diagnostics)
                    : savePng(path, runtime::toBytes(*image), diagnostics);
  }
  counts_.pictures += good;
  return good;
}

void PictureWriter::tell(text::Diagnostics& diagnostics) const {
  if (first_.pixels == 0) return;
  std::string found = fmt::format("NaN in {} and infinity in {}", first_.nan, first_.infinite);
  if (const std::uint64_t more = counts_.broken - 1; more > 0)
    found += fmt::format("; {} more of the pictures after it have such pixels", more);
  diagnostics.warning(say::pictureNotFinite, {first_.file, 0, 0}, text::counted(first_.pixels, "pixel"),
                      first_.pixels == 1 ? "is" : "are", first_.x, first_.y, found, first_.resource);
}

std::string encodeBase64(std::string_view bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : kDigits[word >> (18 - 6 * k) & 63];
  }
  return text;
}

std::string pictureAddress(const assets::Image8& image) {
  if (image.texels.empty()) return {};
  std::vector<std::uint8_t> opaque;
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < image.texels.size(); i += channels)
    opaque.insert(opaque.end(), &image.texels[i], &image.texels[i] + 3);
  return "data:image/png;base64," + encodeBase64(assets::encodePng8(image.width, image.height, 3, opaque));
}

std::optional<std::string> pageOf(const nlohmann::ordered_json& report, std::string_view title,
                                  text::Diagnostics& diagnostics) {
  const std::string folder = text::dataFolder() + "/app/report/page.";
  const auto style = text::readTextFile(folder + "css", diagnostics),
             script = text::readTextFile(folder + "js", diagnostics);
  if (!style || !script) return std::nullopt;
  return filledIn("report/page.html",
                  {{"{title}", escaped(title, "&lt;")},
                   {"{style}", *style},
                   {"{script}", *script},
                   {"{report}", escaped(text::dumpJson(report, -1, false), "\\u003c")}},
                  diagnostics);
}

}  // namespace weft::app
