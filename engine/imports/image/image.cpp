#include "engine/assets/images/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <vector>

#include "engine/imports/builtin.h"
#include "engine/text/chars.h"
#include "engine/text/files/file.h"
#include "engine/text/files/file_cache.h"
#include "imports_sentences.h"

namespace weft::imports {

namespace {

using assets::ImageHeader;
using assets::StoredType;
using graph::Value;

struct ImageRequest {
  std::string file;
  double frame = -1;  // below 0: the sequence plays
  double fps = 0;     // 0: a picture per frame
  bool hold = false, srgb = false, mips = false;
};

ImageRequest imageRequestOf(const graph::ImportRequest& request) {
  return {.file = request.at("file").symbol,
          .frame = request.at("frame").v[0],
          .fps = request.at("fps").v[0],
          .hold = request.at("end").symbol == "hold",
          .srgb = request.at("srgb").truth(),
          .mips = request.at("mips").truth()};
}

struct TexelLayout {
  graph::Format format;
  GLenum stored, sent;
};
TexelLayout layoutOf(StoredType type, bool srgb) {
  if (type == StoredType::byte && srgb) return {graph::Format::srgb8_a8, GL_SRGB8_ALPHA8, GL_UNSIGNED_BYTE};
  if (type == StoredType::byte) return {graph::Format::rgba8, GL_RGBA8, GL_UNSIGNED_BYTE};
  // OpenGL decodes sRGB of 8 bits only.
  if (type == StoredType::word && !srgb) return {graph::Format::rgba16, GL_RGBA16, GL_UNSIGNED_SHORT};
  return {graph::Format::rgba32f, GL_RGBA32F, GL_FLOAT};
}

std::uint32_t levelsOf(const ImageHeader& header, bool mips) {
  return mips ? gl::mipsOf(static_cast<unsigned>(header.width), static_cast<unsigned>(header.height)) : 1;
}

gl::TextureDesc textureDescOf(const ImageHeader& header, const ImageRequest& request) {
  return {.format = layoutOf(header.type, request.srgb).stored,
          .width = static_cast<std::uint32_t>(header.width),
          .height = static_cast<std::uint32_t>(header.height),
          .mips = levelsOf(header, request.mips)};
}

// ---- numbered pictures: which files a name with #### or %04d stands for ----

// "clouds/####.png" in its parts. The number stands in the file's name, not in a folder's.
struct SequencePattern {
  std::string text;           // as written
  std::string before, after;  // "clouds/", ".png"
  std::size_t digits = 1;     // at least; filled up with zeros
  std::string nameOf(std::uint32_t number) const {
    return fmt::format("{}{:0{}}{}", before, number, digits, after);
  }
};

constexpr std::size_t kMaxDigits = 9;  // of a number

// Nothing when `file` is the name of one file: without two or more # in a row, and without %d, %4d or %04d.
std::optional<SequencePattern> sequencePatternOf(const std::string& file) {
  const std::size_t slash = file.rfind('/'), name = slash == std::string::npos ? 0 : slash + 1;
  const auto made = [&](std::size_t first, std::size_t end, std::size_t digits) {
    return SequencePattern{file, file.substr(0, first), file.substr(end),
                           std::clamp<std::size_t>(digits, 1, kMaxDigits)};
  };
  if (const std::size_t first = file.find("##", name); first != std::string::npos) {
    const std::size_t end = std::min(file.find_first_not_of('#', first), file.size());
    return made(first, end, end - first);
  }
  for (std::size_t first = file.find('%', name); first != std::string::npos;
       first = file.find('%', first + 1)) {
    std::size_t end = first + 1, width = 0;
    while (end < file.size() && text::isDigit(file[end]) && end - first <= 2)
      width = width * 10 + static_cast<std::size_t>(file[end++] - '0');
    if (end < file.size() && file[end] == 'd') return made(first, end + 1, width);
  }
  return std::nullopt;
}

// The numbers of the files that are there, ascending. Empty after an error.
std::vector<std::uint32_t> numbersOf(const SequencePattern& pattern, text::Diagnostics& diagnostics) {
  namespace fs = std::filesystem;
  const text::Place place{pattern.text};
  const std::string path = pattern.before.substr(0, pattern.before.rfind('/') + 1),
                    folder = path.empty() ? "." : path;
  if (!text::mayRead(folder)) {
    text::reportOutside(folder, diagnostics, place);
    return {};
  }
  std::vector<std::uint32_t> numbers;
  std::error_code ec;
  for (fs::directory_iterator entry(folder, ec), end; !ec && entry != end; entry.increment(ec)) {
    const std::string name = path + entry->path().filename().string();
    const std::size_t around = pattern.before.size() + pattern.after.size();
    if (name.size() <= around) continue;
    const auto number =
        text::numberIn<std::uint32_t>(name.substr(pattern.before.size(), name.size() - around));
    // 00012 is no name of number 12 in four digits, and neither is 12.
    if (number && pattern.nameOf(*number) == name) numbers.push_back(*number);
  }
  std::ranges::sort(numbers);
  if (numbers.empty()) {
    diagnostics.error(say::emptySequence, place, pattern.text, pattern.nameOf(1),
                      ec ? fmt::format("a folder that cannot be listed: {}", ec.message()) : "none");
  }
  return numbers;
}

// The file that is shown for the number `wanted` of a sequence; in a gap, the last file before it.
std::uint32_t numberAt(const std::vector<std::uint32_t>& numbers, double wanted) {
  const auto after = std::upper_bound(numbers.begin(), numbers.end(), wanted);
  return after == numbers.begin() ? numbers.front() : *(after - 1);
}

// Which number of a playing sequence a frame shows.
std::uint32_t numberNow(const std::vector<std::uint32_t>& numbers, const ImageRequest& request,
                        const FrameInput& input) {
  // A frame at exactly k / fps shows picture k, however its time was rounded.
  constexpr double kRounding = 1e-6;
  const double step =
      request.fps > 0 ? std::max(0.0, std::floor(input.time * request.fps + kRounding)) : input.frame;
  const std::uint64_t first = numbers.front(), count = numbers.back() - first + 1;
  const auto steps = static_cast<std::uint64_t>(std::min(step, 1e15));
  return numberAt(numbers,
                  static_cast<double>(first + (request.hold ? std::min(steps, count - 1) : steps % count)));
}

// The file whose header tells the size. Empty after errors.
std::string firstFileOf(const ImageRequest& request, Files& files, text::Diagnostics& diagnostics) {
  const auto pattern = sequencePatternOf(request.file);
  if (!pattern) {
    if (request.frame >= 0) {
      diagnostics.add(badArgument("\"frame\" chooses from a sequence",
                                  "a \"file\" with #### or %04d in its name", request.file,
                                  "leave \"frame\" out, or name a sequence: \"clouds.####.png\""));
      return {};
    }
    return request.file;
  }
  const std::vector<std::uint32_t> numbers = numbersOf(*pattern, diagnostics);
  if (numbers.empty()) return {};
  for (const std::uint32_t number : numbers) files.touch(pattern->nameOf(number));
  files.touch(pattern->nameOf(numbers.back() + 1));
  if (request.frame < 0) return pattern->nameOf(numbers.front());
  const std::uint32_t nearest = numberAt(numbers, request.frame);
  if (nearest != std::floor(request.frame)) {
    diagnostics.add(badArgument(fmt::format("the sequence '{}' has no such picture", request.file),
                                fmt::format("\"frame\" from {} to {}", numbers.front(), numbers.back()),
                                fmt::format("{}", request.frame), fmt::format("the nearest is {}", nearest)));
    return {};
  }
  return pattern->nameOf(nearest);
}

class ImageProvider : public Provider {
 public:
  static graph::ImportType reflect() {
    return {
        .name = "image",
        .kind = graph::ImportKind::texture,
        .doc =
            "A picture file as a 2D texture of its size, upright, with four channels: .png .jpg .webp .tga "
            "as rgba8 or rgba16, .hdr .exr as rgba32f; or a sequence of numbered files. Not there when "
            "`file` is empty.",
        .arguments = {
            argument("file", Value::text(""),
                     "path of the file; of a sequence with #### or %04d for the number"),
            argument("frame", Value::number(-1),
                     "number of the picture of a sequence; -1: it plays from its first number on"),
            argument("fps", Value::number(0),
                     "pictures per second of a sequence that plays; 0: one per frame"),
            argument("end", Value::text("loop"),
                     "what follows the last picture of a sequence: the first, or itself", {"loop", "hold"}),
            argument("srgb", Value::boolean(false),
                     "decode red, green and blue from sRGB, as pictures are stored; not for .hdr and .exr, "
                     "which are linear"),
            argument("mips", Value::boolean(false), "all levels down to one texel")}};
  }

  static graph::ImportFacts facts(const graph::ImportRequest& request, const WorldFacts&, Files& files) {
    graph::ImportFacts result;
    const ImageRequest image = imageRequestOf(request);
    if (image.file.empty()) return result;
    text::Diagnostics said;
    if (image.fps < 0)
      said.add(badArgument("\"fps\" is below 0", "pictures per second, or 0 for one per frame",
                           fmt::format("{}", image.fps)));
    const std::string path = firstFileOf(image, files, said);
    const auto header = path.empty() ? nullptr : files.get<ImageHeader>(path, assets::loadHeader, said);
    if (header) {
      result.exists = true;
      result.format = layoutOf(header->type, image.srgb).format;
      result.width = static_cast<std::uint32_t>(header->width);
      result.height = static_cast<std::uint32_t>(header->height);
      result.mips = levelsOf(*header, image.mips);
    }
    result.changing = image.frame < 0 && sequencePatternOf(image.file).has_value();
    result.problems = said.items();
    return result;
  }

  explicit ImageProvider(const graph::ImportRequest& request)
      : request_(imageRequestOf(request)), pattern_(sequencePatternOf(request_.file)) {}

  gl::TextureRef texture(const Frame& frame, text::Diagnostics& diagnostics) override {
    if (request_.file.empty()) return {};
    if (stale_ && pattern_) numbers_ = numbersOf(*pattern_, diagnostics);
    std::string path = request_.file;
    if (pattern_) path = numbers_.empty() ? "" : pattern_->nameOf(numberOf(frame));
    if (!path.empty() && (stale_ || path != path_)) show(frame, path, diagnostics);
    stale_ = false;
    return texture_ ? texture_.ref() : gl::TextureRef{};
  }
  std::uint64_t generation(const Frame&) override { return generation_; }
  bool isStill(const World&) const override { return !pattern_ || request_.frame >= 0; }
  bool renew(bool used) override {
    stale_ = true;
    return used;
  }

 private:
  std::uint32_t numberOf(const Frame& frame) const {
    return request_.frame >= 0 ? numberAt(numbers_, request_.frame)
                               : numberNow(numbers_, request_, frame.input);
  }

  // After an error the texture stays as it is, and the file is not tried again before it changes.
  void show(const Frame& frame, const std::string& path, text::Diagnostics& diagnostics) {
    const bool another = path != path_;
    path_ = path;
    text::Diagnostics said;
    const auto header = frame.files.get<ImageHeader>(path, assets::loadHeader, said);
    if (header && header == header_ && !another) return;  // as it was
    header_ = header;
    auto image = header ? assets::loadStored(path, request_.srgb, said) : std::nullopt;
    if (image && pattern_ && another && texture_ && !fits(image->header, path, said)) image.reset();
    diagnostics.append(said);
    if (!image) return;
    const gl::TextureDesc desc = textureDescOf(image->header, request_);
    const bool same = texture_ && texture_.desc() == desc;
    if (!same && !gl::remake(texture_, desc, request_.file, diagnostics)) return;
    const GLenum type = layoutOf(image->header.type, request_.srgb).sent;
    gl::uploadTexture(texture_.ref(), 0, 0, GL_RGBA, type, image->texels);
    if (desc.mips > 1) glGenerateTextureMipmap(texture_.id());
    generation_ = frame.newGeneration();
  }

  // A sequence has one size: the graph's sizes depend on it.
  bool fits(const ImageHeader& header, const std::string& path, text::Diagnostics& diagnostics) const {
    if (textureDescOf(header, request_) == texture_.desc()) return true;
    const gl::TextureDesc& before = texture_.desc();
    diagnostics.error(say::pictureOfOtherSize, {path}, pattern_->text, before.width, before.height,
                      header.width, header.height);
    return false;
  }

  ImageRequest request_;
  std::optional<SequencePattern> pattern_;
  std::vector<std::uint32_t> numbers_;
  std::string path_;                           // tried last
  std::shared_ptr<const ImageHeader> header_;  // of it: another object when the file is another
  gl::Texture texture_;
  std::uint64_t generation_ = 0;
  bool stale_ = true;
};

}  // namespace

std::unique_ptr<Import> makeImage() {
  return std::make_unique<ImportOf<ImageProvider>>();
}

}  // namespace weft::imports
