// What the inspector reads of its copy: texels, statistics, whole pictures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "engine/runtime/inspection/inspector.h"

namespace weft::runtime {

std::string InspectTexel::text() const {
  std::string out;
  for (std::uint32_t c = 0; c < channels; ++c) {
    const double x = value[c];
    const bool whole = std::trunc(x) == x && std::abs(x) < 1e10;
    out += (c ? ", " : "") + (std::isnan(x) ? "nan"
                              : whole       ? fmt::format("{}", static_cast<std::int64_t>(x))
                                            : fmt::format("{}", static_cast<float>(x)));
  }
  return out;
}

std::uint32_t Inspector::numbers() const {
  return stencil_ ? 1 : std::min(channels_, gl::floatChannelsOf(picture_.desc().format));
}

std::vector<double> Inspector::read(std::uint32_t x, std::uint32_t y, std::uint32_t width,
                                    std::uint32_t height) const {
  const std::size_t texels = std::size_t{width} * height, count = numbers();
  std::vector<double> out;
  out.reserve(texels * count);
  // `mask`: of the bits of a number that count; `first`: of the numbers of a texel.
  const auto take = [&]<class T>(T mask, GLenum format, GLenum type, std::size_t stride, std::size_t first) {
    std::vector<T> data(texels * stride);
    glGetTextureSubImage(picture_.id(), 0, static_cast<GLint>(x), static_cast<GLint>(y), 0,
                         static_cast<GLsizei>(width), static_cast<GLsizei>(height), 1, format, type,
                         static_cast<GLsizei>(data.size() * sizeof(T)), data.data());
    for (std::size_t i = 0; i < texels; ++i)
      for (std::size_t c = first; c < first + count; ++c) {
        T number = data[i * stride + c];
        if constexpr (std::is_integral_v<T>) number &= mask;
        out.push_back(static_cast<double>(number));
      }
  };
  const gl::FormatClass kind = gl::classOf(picture_.desc().format);
  if (stencil_ && picture_.desc().format == GL_DEPTH32F_STENCIL8)
    take(std::uint32_t{0xff}, GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV, 2, 1);
  else if (stencil_)
    take(std::uint32_t{0xff}, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8, 1, 0);
  else if (kind == gl::FormatClass::depth || kind == gl::FormatClass::depth_stencil)
    take(0.0f, GL_DEPTH_COMPONENT, GL_FLOAT, 1, 0);
  else if (kind == gl::FormatClass::unsigned_integer)
    take(~std::uint32_t{0}, GL_RGBA_INTEGER, GL_UNSIGNED_INT, 4, 0);
  else if (kind == gl::FormatClass::signed_integer)
    take(std::int32_t{-1}, GL_RGBA_INTEGER, GL_INT, 4, 0);
  else
    take(0.0f, GL_RGBA, GL_FLOAT, 4, 0);
  return out;
}

std::optional<InspectTexel> Inspector::texel(std::uint32_t x, std::uint32_t y) const {
  if (!hasPicture_ || x >= picture_.desc().width || y >= picture_.desc().height) return std::nullopt;
  InspectTexel out{.channels = numbers()};
  std::ranges::copy(read(x, y, 1, 1), out.value.begin());
  return out;
}

std::optional<InspectStatistics> Inspector::measure() const {
  if (!hasPicture_ || stencil_) return std::nullopt;
  const std::vector<double> texels = read(0, 0, picture_.desc().width, picture_.desc().height);
  const std::size_t channels = numbers();
  InspectStatistics out;
  out.low.fill(std::numeric_limits<double>::infinity());
  out.high.fill(-std::numeric_limits<double>::infinity());
  std::array<std::uint64_t, 4> finite{};
  for (std::size_t i = 0; i < texels.size(); i += channels) {
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
  const std::uint32_t width = picture_.desc().width, rows = picture_.desc().height;
  const std::vector<double> texels = read(0, 0, width, rows);
  const std::size_t row = std::size_t{width} * numbers();
  assets::ImageF image{static_cast<int>(width), static_cast<int>(rows), static_cast<int>(numbers()), {}};
  image.texels.reserve(texels.size());
  for (std::size_t y = rows; y-- > 0;)
    for (std::size_t i = 0; i < row; ++i) image.texels.push_back(static_cast<float>(texels[y * row + i]));
  return image;
}

std::vector<std::byte> Inspector::bytes(std::uint64_t offset, std::uint64_t count) const {
  if (!hasBuffer_ || offset >= buffer_.bytes()) return {};
  return gl::readBuffer(buffer_.id(), offset, std::min(count, buffer_.bytes() - offset));
}

}  // namespace weft::runtime
