// What the inspector reads of its copy: texels, statistics, whole pictures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "engine/runtime/inspection/inspector.h"

namespace weft::runtime {

namespace {

std::string numberText(double x) {
  if (std::isnan(x)) return "nan";
  return fmt::format("{}", static_cast<float>(x));
}

}  // namespace

std::string InspectTexel::text() const {
  std::string out;
  for (std::uint32_t c = 0; c < channels; ++c) {
    const bool whole = kind == gl::FormatClass::unsigned_integer || kind == gl::FormatClass::signed_integer;
    out += (c ? ", " : "") +
           (whole ? fmt::format("{}", static_cast<std::int64_t>(value[c])) : numberText(value[c]));
  }
  return out;
}

std::optional<InspectTexel> Inspector::texel(std::uint32_t x, std::uint32_t y) const {
  if (!hasPicture_ || x >= picture_.desc().width || y >= picture_.desc().height) return std::nullopt;
  InspectTexel out;
  out.kind = gl::classOf(picture_.desc().format);
  out.channels = channels_;
  const auto get = [&](GLenum format, GLenum type, GLsizei bytes, void* to) {
    glGetTextureSubImage(picture_.id(), 0, static_cast<GLint>(x), static_cast<GLint>(y), 0, 1, 1, 1, format,
                         type, bytes, to);
  };
  const auto keep = [&](const auto& values) {
    for (std::uint32_t c = 0; c < out.channels && c < 4; ++c) out.value[c] = static_cast<double>(values[c]);
  };
  if (out.kind == gl::FormatClass::depth || out.kind == gl::FormatClass::depth_stencil) {
    out.channels = 1;
    if (stencil_) {
      struct {
        float depth;
        std::uint32_t stencil;
      } both{};
      std::uint32_t packed = 0;
      const bool wide = picture_.desc().format == GL_DEPTH32F_STENCIL8;
      if (wide)
        get(GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV, sizeof both, &both);
      else
        get(GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8, sizeof packed, &packed);
      out.kind = gl::FormatClass::unsigned_integer;
      out.value[0] = (wide ? both.stencil : packed) & 0xff;
    } else {
      float depth = 0;
      get(GL_DEPTH_COMPONENT, GL_FLOAT, sizeof depth, &depth);
      out.value[0] = depth;
    }
  } else if (out.kind == gl::FormatClass::unsigned_integer) {
    std::uint32_t values[4] = {};
    get(GL_RGBA_INTEGER, GL_UNSIGNED_INT, sizeof values, values);
    keep(values);
  } else if (out.kind == gl::FormatClass::signed_integer) {
    std::int32_t values[4] = {};
    get(GL_RGBA_INTEGER, GL_INT, sizeof values, values);
    keep(values);
  } else {
    float values[4] = {};
    get(GL_RGBA, GL_FLOAT, sizeof values, values);
    keep(values);
  }
  return out;
}

std::optional<InspectStatistics> Inspector::measure() const {
  if (!hasPicture_ || stencil_) return std::nullopt;
  const std::vector<float> texels = gl::readFloats(picture_.ref());
  const std::size_t stride = gl::floatChannelsOf(picture_.desc().format),
                    channels = std::min<std::size_t>(stride, channels_);
  InspectStatistics out;
  out.low.fill(std::numeric_limits<double>::infinity());
  out.high.fill(-std::numeric_limits<double>::infinity());
  std::array<std::uint64_t, 4> finite{};
  for (std::size_t i = 0; i < texels.size(); i += stride) {
    bool nan = false, infinite = false;
    for (std::size_t c = 0; c < channels; ++c) {
      const double x = texels[i + c];
      nan |= std::isnan(x);
      infinite |= std::isinf(x);
      if (!std::isfinite(x)) continue;
      out.low[c] = std::min(out.low[c], x);
      out.high[c] = std::max(out.high[c], x);
      out.mean[c] += x;
      ++finite[c];
    }
    out.nan += nan;
    out.infinite += infinite;
    ++out.texels;
  }
  for (std::size_t c = 0; c < 4; ++c) {
    if (finite[c])
      out.mean[c] /= static_cast<double>(finite[c]);
    else
      out.low[c] = out.high[c] = 0;
  }
  return out;
}

InspectView Inspector::viewOf(const graph::FlatResource& resource) {
  // Values that are encoded already are not encoded again.
  return {.encode = graph::infoOf(resource.format).kind == graph::TexelKind::floating};
}

InspectView Inspector::fittedView() const {
  InspectView view = viewOf(execution_->plan().graph->resources[resource_]);
  const gl::FormatClass kind = gl::classOf(picture_.desc().format);
  if (!hasPicture_ || kind == gl::FormatClass::floating) return view;
  const auto image = values();
  if (!image) return view;
  float low = std::numeric_limits<float>::infinity(), high = -low;
  for (const float value : image->texels) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) return view;
  view.low = low;
  view.high = high > low ? high : low + 1;
  return view;
}

std::optional<assets::Image8> Inspector::drawWhole(const InspectView& view, base::Diagnostics& diagnostics) {
  if (!hasPicture_) return std::nullopt;
  InspectView whole = view;
  whole.x = whole.y = 0;
  whole.texelsPerPixel = 1;
  if (draw(whole, picture_.desc().width, picture_.desc().height, diagnostics) == 0) return std::nullopt;
  const std::vector<std::byte> pixels = gl::readTexture(canvas_.ref(), 0, 0, GL_RGBA, GL_UNSIGNED_BYTE);
  assets::Image8 image{
      static_cast<int>(canvas_.desc().width), static_cast<int>(canvas_.desc().height), 4, {}};
  image.texels.resize(pixels.size());
  const std::size_t row = std::size_t{canvas_.desc().width} * 4, rows = canvas_.desc().height;
  for (std::size_t y = 0; y < rows; ++y)
    std::memcpy(&image.texels[y * row], &pixels[(rows - 1 - y) * row], row);
  return image;
}

std::optional<assets::ImageF> Inspector::values() const {
  if (!hasPicture_) return std::nullopt;
  const gl::TextureDesc& desc = picture_.desc();
  const std::size_t width = desc.width, rows = desc.height;
  std::vector<float> texels;
  std::size_t stride = 1;
  if (stencil_) {
    const bool wide = desc.format == GL_DEPTH32F_STENCIL8;
    const std::vector<std::byte> packed =
        gl::readTexture(picture_.ref(), 0, 0, GL_DEPTH_STENCIL,
                        wide ? GL_FLOAT_32_UNSIGNED_INT_24_8_REV : GL_UNSIGNED_INT_24_8);
    const std::size_t bytes = wide ? 8 : 4, last = wide ? 4 : 0;
    for (std::size_t i = 0; i < width * rows; ++i) {
      std::uint32_t word = 0;
      std::memcpy(&word, &packed[i * bytes + last], sizeof word);
      texels.push_back(static_cast<float>(word & 0xff));
    }
  } else {
    texels = gl::readFloats(picture_.ref());
    stride = gl::floatChannelsOf(desc.format);
  }
  const std::size_t channels = stride == 1 ? 1 : channels_;
  assets::ImageF image{static_cast<int>(width), static_cast<int>(rows), static_cast<int>(channels), {}};
  image.texels.reserve(width * rows * channels);
  for (std::size_t y = rows; y-- > 0;)
    for (std::size_t x = 0; x < width; ++x)
      for (std::size_t c = 0; c < channels; ++c) image.texels.push_back(texels[(y * width + x) * stride + c]);
  return image;
}

std::vector<std::byte> Inspector::bytes(std::uint64_t offset, std::uint64_t count) const {
  if (!hasBuffer_ || offset >= buffer_.bytes()) return {};
  return gl::readBuffer(buffer_.id(), offset, std::min(count, buffer_.bytes() - offset));
}

}  // namespace weft::runtime
