// .exr through OpenEXR: any flat picture in, 32-bit float ZIP scanlines out. The only file that includes its headers.
// Declared in image_codecs.h and image.h.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

#include "engine/assets/images/image_codecs.h"
#include "engine/text/files/file.h"

namespace weft::assets {

using text::Diagnostics;

namespace {

class BytesIn final : public Imf::IStream {
 public:
  BytesIn(std::string_view bytes, const std::string& name) : IStream(name.c_str()), bytes_(bytes) {}
  bool read(char to[], int count) override {
    if (count < 0 || at_ > bytes_.size() || static_cast<std::size_t>(count) > bytes_.size() - at_)
      throw std::runtime_error("the file ends early");
    std::memcpy(to, bytes_.data() + at_, static_cast<std::size_t>(count));
    at_ += static_cast<std::size_t>(count);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t at) override { at_ = at; }

 private:
  std::string_view bytes_;
  std::uint64_t at_ = 0;
};

class BytesOut final : public Imf::OStream {
 public:
  BytesOut(std::string& bytes, const std::string& name) : OStream(name.c_str()), bytes_(bytes) {}
  void write(const char from[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    bytes_.resize(std::max(bytes_.size(), at_ + size));
    std::memcpy(bytes_.data() + at_, from, size);
    at_ += size;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t at) override { at_ = at; }

 private:
  std::string& bytes_;
  std::uint64_t at_ = 0;
};

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

struct Window {
  long long left = 0, top = 0, width = 0, height = 0;
};

Window windowOf(const Imath::Box2i& box) {
  return {box.min.x, box.min.y, static_cast<long long>(box.max.x) - box.min.x + 1,
          static_cast<long long>(box.max.y) - box.min.y + 1};
}

// The part that is the picture: the first with one layer of colors, else the first that is gray.
struct Opening {
  BytesIn stream;
  Imf::MultiPartInputFile file;
  int part = 0;
  Layer layer{};
  Window display{}, data{};

  Opening(std::string_view bytes, const std::string& name) : stream(bytes, name), file(stream) {}
};

// Rows that are packed as one, or a row of tiles, are unpacked with all their channels.
bool isTooMuchAtOnce(const Imf::Header& header, const Window& data) {
  constexpr long long kMost = 512 << 20, kRowsOfDwab = 256;
  const long long rows =
      header.hasTileDescription()
          ? std::min<long long>(header.tileDescription().ySize, data.height)
          : std::min(header.compression() == Imf::DWAB_COMPRESSION ? kRowsOfDwab : 32, data.height);
  long long channels = 0;
  for (auto at = header.channels().begin(); at != header.channels().end(); ++at) ++channels;
  return rows * data.width * 4 * channels > kMost;
}

// What is wrong with the part that was chosen, or "".
std::string problemOf(const Opening& opening) {
  const Imf::Header& header = opening.file.header(opening.part);
  if (isTooMuchAtOnce(header, opening.data)) return "a row of it holds too many channels";
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
  auto opening = std::make_unique<Opening>(bytes, name);
  std::optional<Layer> chosen;
  std::vector<Layer> others;
  bool deep = false;
  for (int part = 0; part < opening->file.parts(); ++part) {
    const Imf::Header& header = opening->file.header(part);
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
  const Imf::Header& header = opening->file.header(opening->part);
  opening->layer = *chosen;
  opening->display = windowOf(header.displayWindow());
  opening->data = windowOf(header.dataWindow());
  for (const Window& window : {opening->display, opening->data})
    if (!checkSize(diagnostics, name, window.width, window.height)) return {};
  if (const std::string problem = problemOf(*opening); !problem.empty()) {
    reportUnreadable(diagnostics, name, problem);
    return {};
  }
  return opening;
}

// The texels of the data window; alpha 1 where the file has none.
ImageF readData(Opening& opening, std::string_view bytes, const std::string& name) {
  const Window& data = opening.data;
  const auto count = static_cast<std::size_t>(data.width * data.height);
  ImageF image{static_cast<int>(data.width), static_cast<int>(data.height), 4,
               std::vector<float>(count * 4, 1.0f)};
  const Imath::Box2i box = opening.file.header(opening.part).dataWindow();
  if (opening.layer.chroma) {
    std::vector<Imf::Rgba> colors(count);
    BytesIn again(bytes, name);
    Imf::RgbaInputFile file(again);
    file.setFrameBuffer(colors.data() - box.min.x - box.min.y * data.width, 1,
                        static_cast<std::size_t>(data.width));
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
                                              4 * sizeof(float) * static_cast<std::size_t>(data.width)));
  Imf::InputPart part(opening.file, opening.part);
  part.setFrameBuffer(planes);
  part.readPixels(box.min.y, box.max.y);
  if (gray)
    for (std::size_t i = 0; i < count * 4; i += 4)
      image.texels[i + 1] = image.texels[i + 2] = image.texels[i];
  return image;
}

// Cut to the display window; what the data lacks of it is transparent.
ImageF cropToDisplay(ImageF data, const Opening& opening) {
  const Window &from = opening.data, &to = opening.display;
  if (from.left == to.left && from.top == to.top && from.width == to.width && from.height == to.height)
    return data;
  ImageF image{static_cast<int>(to.width), static_cast<int>(to.height), 4, {}};
  image.texels.resize(static_cast<std::size_t>(to.width * to.height) * 4);
  const long long left = std::max(from.left, to.left),
                  right = std::min(from.left + from.width, to.left + to.width);
  for (long long y = std::max(from.top, to.top); y < std::min(from.top + from.height, to.top + to.height);
       ++y)
    if (left < right)
      std::copy_n(data.texels.begin() + ((y - from.top) * from.width + left - from.left) * 4,
                  (right - left) * 4, image.texels.begin() + ((y - to.top) * to.width + left - to.left) * 4);
  return image;
}

// The library throws what is wrong with a file.
template <class Result, class Work>
std::optional<Result> guarded(const std::string& name, Diagnostics& diagnostics, const Work& work) try {
  return work();
} catch (const std::exception& error) {
  reportUnreadable(diagnostics, name, error.what());
  return {};
}

}  // namespace

std::optional<ImageF> decodeExr(std::string_view bytes, const std::string& name, Diagnostics& diagnostics) {
  return guarded<ImageF>(name, diagnostics, [&]() -> std::optional<ImageF> {
    const std::unique_ptr<Opening> opening = openExr(bytes, name, diagnostics);
    if (!opening) return {};
    return cropToDisplay(readData(*opening, bytes, name), *opening);
  });
}

std::optional<ImageHeader> readExrHeader(std::string_view bytes, const std::string& name,
                                         Diagnostics& diagnostics) {
  return guarded<ImageHeader>(name, diagnostics, [&]() -> std::optional<ImageHeader> {
    const std::unique_ptr<Opening> opening = openExr(bytes, name, diagnostics);
    if (!opening) return {};
    return ImageHeader{static_cast<int>(opening->display.width), static_cast<int>(opening->display.height), 4,
                       StoredType::real};
  });
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
  std::string bytes;
  {
    BytesOut stream(bytes, path);
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(planes);
    file.writePixels(image.height);
  }  // which writes where its lines are
  return text::writeFile(path, bytes, diagnostics);
} catch (const std::exception& error) {
  diagnostics.error(text::Code::outputNotWritten, {path},
                    fmt::format("cannot encode '{}' as OpenEXR: {}", path, error.what()));
  return false;
}

}  // namespace weft::assets
