// .exr through OpenEXR: any flat picture in, 32-bit float ZIP scanlines out. The only file that includes its headers.
// Declared in image_codecs.h and image.h.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "assets_sentences.h"
#include "engine/assets/images/image_codecs.h"
#include "engine/text/files/file.h"

namespace weft::assets {

using text::Diagnostics;

namespace {

// Which channel of the file each of R, G, B, A is, "" for none, and the layer ("diffuse" of "diffuse.R") that they belong to.
struct Layer {
  std::string name;  // empty for the picture itself
  std::array<std::string, 4> channels{};
  bool chroma = false;  // luminance and two differences, which RgbaInputFile makes colors of
  bool isWhole() const { return !channels[0].empty() && !channels[1].empty() && !channels[2].empty(); }
};

// Those with channels R, G and B, in the order of the file. A part with one channel, or with Y where that
// is no part of a color, is gray.
std::vector<Layer> findLayers(const Imf::ChannelList& list) {
  std::vector<Layer> layers;
  std::map<std::string, std::size_t> places;  // of layers in `layers`
  std::size_t count = 0;
  for (auto at = list.begin(); at != list.end(); ++at, ++count) {
    const std::string name = at.name();
    const std::size_t dot = name.rfind('.');
    const std::string of = dot == name.npos ? "" : name.substr(0, dot);
    const std::string last = dot == name.npos ? name : name.substr(dot + 1);
    const std::size_t index = last.size() == 1 ? std::string_view("RGBA").find(last[0]) : last.npos;
    if (index == last.npos) continue;
    const auto [known, fresh] = places.try_emplace(of, layers.size());
    if (fresh) layers.push_back({.name = of});
    layers[known->second].channels[index] = name;
  }
  const auto own = std::ranges::find(layers, "", &Layer::name);
  const std::string alpha = own == layers.end() ? "" : own->channels[3];
  if (own != layers.end() && own->isWhole()) return {*own};
  std::erase_if(layers, [](const Layer& layer) { return !layer.isWhole(); });
  if (!layers.empty() || count == 0) return layers;
  const bool differences = list.findChannel("RY") && list.findChannel("BY");
  const std::string gray = count == 1 ? list.begin().name() : "Y";
  if (list.findChannel(gray) && gray != alpha && (count == 1 || differences || !list.findChannel("X")))
    layers = {{"", {gray, gray, gray, alpha}, differences}};
  return layers;
}

// Why no picture can be chosen.
std::string reasonOf(const std::vector<Layer>& layers) {
  if (layers.empty()) return "it has no channels R, G and B";
  std::string names;
  for (std::size_t i = 0; i < std::min<std::size_t>(layers.size(), 8); ++i)
    names += fmt::format("{}'{}'", i == 0 ? "" : ", ", layers[i].name);
  return fmt::format("it has several layers ({}{}) and no picture of its own; save one of them as a file",
                     names, layers.size() > 8 ? ", …" : "");
}

long long widthOf(const Imath::Box2i& box) {
  return static_cast<long long>(box.max.x) - box.min.x + 1;
}
long long heightOf(const Imath::Box2i& box) {
  return static_cast<long long>(box.max.y) - box.min.y + 1;
}

// The part that is the picture: the first with one layer of colors, else the first that is gray.
struct Opening {
  Imf::StdISStream stream;
  std::optional<Imf::MultiPartInputFile> file{};
  int part = 0;
  Layer layer{};
  Imath::Box2i display{}, data{};
};

// Rows that are packed as one, or a row of tiles, are unpacked with all their channels.
bool isTooMuchAtOnce(const Imf::Header& header) {
  constexpr long long kMost = 512 << 20, kRowsOfDwab = 256;
  const long long rows = header.hasTileDescription()                     ? header.tileDescription().ySize
                         : header.compression() == Imf::DWAB_COMPRESSION ? kRowsOfDwab
                                                                         : 32;
  long long channels = 0;
  for (auto at = header.channels().begin(); at != header.channels().end(); ++at) ++channels;
  return std::min(rows, heightOf(header.dataWindow())) * widthOf(header.dataWindow()) * 4 * channels > kMost;
}

// What is wrong with the part that was chosen, or "".
std::string problemOf(const Opening& opening) {
  const Imf::Header& header = opening.file->header(opening.part);
  if (isTooMuchAtOnce(header)) return "a row of it holds too many channels";
  if (opening.layer.chroma && opening.part > 0) return "only its first part may hold luminance and chroma";
  for (const std::string& name : opening.layer.channels) {
    if (name.empty() || opening.layer.chroma) continue;
    const Imf::Channel& channel = header.channels()[name.c_str()];
    if (channel.type == Imf::UINT) return "a color channel holds whole numbers";
    if (channel.xSampling != 1 || channel.ySampling != 1)
      return fmt::format("channel '{}' is subsampled", name);
  }
  return "";
}

std::unique_ptr<Opening> openExr(std::string_view bytes, const std::string& name, Diagnostics& diagnostics) {
  // What is larger is refused by checkSize(), which says how large a picture may be.
  [[maybe_unused]] static const bool bounded = [] {
    Imf::Header::setMaxImageSize(8 * kMaxImageSide, 8 * kMaxImageSide);
    Imf::Header::setMaxTileSize(kMaxImageSide, kMaxImageSide);
    return true;
  }();
  auto opening = std::make_unique<Opening>();
  opening->stream.str(std::string(bytes));
  opening->file.emplace(opening->stream);
  std::optional<Layer> chosen;
  std::vector<Layer> others;
  bool deep = false;
  for (int part = 0; part < opening->file->parts(); ++part) {
    const Imf::Header& header = opening->file->header(part);
    if (header.hasType() && !Imf::isImage(header.type())) {
      deep = true;
      continue;
    }
    const std::vector<Layer> layers = findLayers(header.channels());
    const bool colored =
        layers.size() == 1 && (layers[0].chroma || layers[0].channels[0] != layers[0].channels[1]);
    if (layers.size() == 1 && (colored || !chosen)) {
      chosen = layers[0];
      opening->part = part;
    }
    if (colored) break;
    if (layers.size() > 1) others = layers;
  }
  if (!chosen) {
    reportUnreadable(
        diagnostics, name,
        deep && others.empty() ? "it holds deep data; save it as one flat picture" : reasonOf(others));
    return {};
  }
  const Imf::Header& header = opening->file->header(opening->part);
  opening->layer = *chosen;
  opening->display = header.displayWindow();
  opening->data = header.dataWindow();
  for (const Imath::Box2i& window : {opening->display, opening->data})
    if (!checkSize(diagnostics, name, widthOf(window), heightOf(window))) return {};
  if (const std::string problem = problemOf(*opening); !problem.empty()) {
    reportUnreadable(diagnostics, name, problem);
    return {};
  }
  return opening;
}

// The texels of the data window; alpha 1 where the file has none.
ImageF readData(Opening& opening) {
  const Imath::Box2i& box = opening.data;
  const auto width = static_cast<std::size_t>(widthOf(box)), height = static_cast<std::size_t>(heightOf(box)),
             count = width * height;
  ImageF image{static_cast<int>(width), static_cast<int>(height), 4, std::vector<float>(count * 4, 1.0f)};
  if (opening.layer.chroma) {
    std::vector<Imf::Rgba> colors(count);
    opening.stream.clear();
    opening.stream.seekg(0);
    Imf::RgbaInputFile file(opening.stream);
    file.setFrameBuffer(colors.data() - box.min.x - box.min.y * widthOf(box), 1, width);
    file.readPixels(box.min.y, box.max.y);
    for (std::size_t i = 0; i < count; ++i) {
      const Imf::Rgba& from = colors[i];
      const std::array<float, 4> color = {from.r, from.g, from.b, from.a};
      std::ranges::copy(color, image.texels.begin() + static_cast<std::ptrdiff_t>(i * 4));
    }
    return image;
  }
  const bool gray = opening.layer.channels[0] == opening.layer.channels[1];
  Imf::FrameBuffer planes;
  for (std::size_t c = 0; c < 4; ++c)
    if (const std::string& channel = opening.layer.channels[c];
        !channel.empty() && !(gray && (c == 1 || c == 2)))
      planes.insert(channel, Imf::Slice::Make(Imf::FLOAT, image.texels.data() + c, box, 4 * sizeof(float),
                                              4 * sizeof(float) * width));
  Imf::InputPart part(*opening.file, opening.part);
  part.setFrameBuffer(planes);
  part.readPixels(box.min.y, box.max.y);
  if (gray)
    for (std::size_t i = 0; i < count * 4; i += 4)
      image.texels[i + 1] = image.texels[i + 2] = image.texels[i];
  return image;
}

// Cut to the display window; what the data lacks of it is transparent.
ImageF cropToDisplay(ImageF data, const Opening& opening) {
  const Imath::Box2i &from = opening.data, &to = opening.display;
  if (from == to) return data;
  ImageF image{static_cast<int>(widthOf(to)), static_cast<int>(heightOf(to)), 4, {}};
  image.texels.resize(static_cast<std::size_t>(widthOf(to) * heightOf(to)) * 4);
  const long long left = std::max(from.min.x, to.min.x), right = std::min(from.max.x, to.max.x) + 1LL;
  for (long long y = std::max(from.min.y, to.min.y); left < right && y <= std::min(from.max.y, to.max.y); ++y)
    std::copy_n(data.texels.begin() + ((y - from.min.y) * widthOf(from) + left - from.min.x) * 4,
                (right - left) * 4,
                image.texels.begin() + ((y - to.min.y) * widthOf(to) + left - to.min.x) * 4);
  return image;
}

}  // namespace

std::optional<ImageF> readExr(std::string_view bytes, const std::string& name, bool decodes,
                              Diagnostics& diagnostics) try {
  const std::unique_ptr<Opening> opening = openExr(bytes, name, diagnostics);
  if (!opening) return {};
  const Imath::Box2i& shown = opening->display;
  if (!decodes) return ImageF{static_cast<int>(widthOf(shown)), static_cast<int>(heightOf(shown)), 4};
  const auto textOf = [](const Imath::Box2i& b) {
    return fmt::format("({}, {}) to ({}, {})", b.min.x, b.min.y, b.max.x, b.max.y);
  };
  if (!shown.intersects(opening->data))
    diagnostics.warning(say::nothingInWindow, {name}, name, textOf(shown), textOf(opening->data));
  return cropToDisplay(readData(*opening), *opening);
} catch (const std::exception& error) {  // what is wrong with the file
  reportUnreadable(diagnostics, name, error.what());
  return {};
}

bool saveExr(const std::string& path, const ImageF& image, Diagnostics& diagnostics) try {
  assert(image.width > 0 && image.height > 0);
  assert(image.channels == 1 || image.channels == 3 || image.channels == 4);
  const auto width = static_cast<std::size_t>(image.width),
             channels = static_cast<std::size_t>(image.channels);
  assert(image.texels.size() == width * static_cast<std::size_t>(image.height) * channels);
  const std::string_view names = channels == 1 ? "Y" : "RGBA";
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::FrameBuffer planes;
  for (std::size_t c = 0; c < channels; ++c) {
    const std::string name(1, names[c]);
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    planes.insert(name, Imf::Slice::Make(Imf::FLOAT, image.texels.data() + c, header.dataWindow(),
                                         channels * sizeof(float), channels * sizeof(float) * width));
  }
  Imf::StdOSStream stream;
  {
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(planes);
    file.writePixels(image.height);
  }  // which writes where its lines are
  return text::writeFile(path, stream.str(), diagnostics);
} catch (const std::exception& error) {
  diagnostics.error(say::exrNotEncoded, {path}, path, error.what());
  return false;
}

}  // namespace weft::assets
