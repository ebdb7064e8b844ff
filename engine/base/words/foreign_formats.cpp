#include "engine/base/words/foreign_formats.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>

#include "engine/base/chars.h"

namespace weft::base {

namespace {

// "r16g16b16a16" and "rgba16" to channels and bits; nothing for anything else.
struct Channels {
  std::string letters, bits;  // "rgba", "16"; of several sizes those of all: "10 10 10 2"
};

std::optional<Channels> channelsIn(std::string_view text) {
  Channels found;
  std::string previous;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t first = at;
    while (at < text.size() && std::string_view("rgbadsxe").find(text[at]) != std::string_view::npos) ++at;
    if (at == first) return std::nullopt;
    found.letters += text.substr(first, at - first);
    const std::size_t digits = at;
    while (at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0) ++at;
    const std::string bits(text.substr(digits, at - digits));
    if (!previous.empty() && bits != previous) found.bits += " " + bits;
    if (previous.empty()) found.bits = bits;
    previous = bits;
    if (bits.empty()) return at == text.size() ? std::optional(found) : std::nullopt;
  }
  return found;
}

// What is said of the numbers behind the channels: "unorm", "float"; "" for nothing, nothing for another word.
std::optional<std::string> suffixFor(std::string_view words) {
  constexpr std::pair<std::string_view, std::string_view> kWords[] = {
      {"", ""},         {"unorm", ""},         {"f", "f"},       {"float", "f"},
      {"sfloat", "f"},  {"half", "f"},         {"ui", "ui"},     {"uint", "ui"},
      {"i", "i"},       {"sint", "i"},         {"int", "i"},     {"snorm", "_snorm"},
      {"srgb", "srgb"}, {"unormsrgb", "srgb"}, {"typeless", ""}, {"ufloat", "f"},
      {"plus", ""}};
  for (const auto& [theirs, ours] : kWords)
    if (words == theirs) return std::string(ours);
  return std::nullopt;
}

std::string colorFormat(std::string letters, const std::string& bits, const std::string& suffix, bool srgb) {
  std::ranges::replace(letters, 'x', 'a');
  if (letters == "bgra" || letters == "rgb" || letters == "bgr" || letters == "argb" || letters == "abgr")
    letters = "rgba";
  if (letters != "r" && letters != "rg" && letters != "rgba") return {};
  if (srgb) return bits == "8" ? "srgb8_a8" : "";
  if (bits == "32" && suffix.empty()) return letters + "32f";
  if (bits == "10 2") return "rgb10_a2";
  if (bits == "11 10") return "r11f_g11f_b10f";
  return bits == "8" || bits == "16" || bits == "32"
             ? letters + bits + (bits == "8" && suffix == "f" ? "" : suffix)
             : "";
}

}  // namespace

std::string formatMeantBy(std::string_view word) {
  std::string text = lowered(word);
  for (const std::string_view prefix :
       {"dxgi_format_", "vk_format_", "gl_", "mtlpixelformat", "pixelformat.", "format_", "pf_", "three."})
    if (text.starts_with(prefix)) text.erase(0, prefix.size());
  constexpr std::pair<std::string_view, std::string_view> kWhole[] = {
      {"d16", "depth16"},
      {"d24", "depth24"},
      {"d32", "depth32f"},
      {"depth", "depth32f"},
      {"depth32", "depth32f"},
      {"d32f", "depth32f"},
      {"d16_unorm", "depth16"},
      {"d32_float", "depth32f"},
      {"d32_sfloat", "depth32f"},
      {"depth24plus", "depth24"},
      {"depth32float", "depth32f"},
      {"depth_component", "depth32f"},
      {"depth_component16", "depth16"},
      {"depth_component24", "depth24"},
      {"depth_component32f", "depth32f"},
      {"d24s8", "depth24_stencil8"},
      {"d24_unorm_s8_uint", "depth24_stencil8"},
      {"depth24plus-stencil8", "depth24_stencil8"},
      {"depthstencil", "depth24_stencil8"},
      {"depth_stencil", "depth24_stencil8"},
      {"d32_float_s8x24_uint", "depth32f_stencil8"},
      {"d32_sfloat_s8_uint", "depth32f_stencil8"},
      {"float", "r32f"},
      {"half", "r16f"},
      {"float4", "rgba32f"},
      {"half4", "rgba16f"},
      {"float2", "rg32f"},
      {"half2", "rg16f"},
      {"vec4", "rgba32f"},
      {"rgba", "rgba8"},
      {"rgb", "rgba8"},
      {"rgbaformat", "rgba8"},
      {"rgbformat", "rgba8"},
      {"rgformat", "rg8"},
      {"redformat", "r8"},
      {"luminanceformat", "r8"},
      {"alphaformat", "r8"},
      {"depthformat", "depth32f"},
      {"depthstencilformat", "depth24_stencil8"},
      {"unsignedbytetype", "rgba8"},
      {"halffloattype", "rgba16f"},
      {"floattype", "rgba32f"},
      {"srgbcolorspace", "srgb8_a8"},
      {"f16", "r16f"},
      {"f32", "r32f"},
      {"argb32", "rgba8"},
      {"srgb", "srgb8_a8"},
      {"srgb8", "srgb8_a8"},
      {"srgba8", "srgb8_a8"},
      {"srgb8_alpha8", "srgb8_a8"},
      {"hdr", "rgba16f"},
      {"r11g11b10f", "r11f_g11f_b10f"},
      {"r11g11b10", "r11f_g11f_b10f"},
      {"b10g11r11_ufloat_pack32", "r11f_g11f_b10f"},
      {"rg11b10ufloat", "r11f_g11f_b10f"},
      {"rg11b10float", "r11f_g11f_b10f"},
      {"rgb10a2unorm", "rgb10_a2"},
      {"rgb10a2", "rgb10_a2"},
      {"a2b10g10r10_unorm_pack32", "rgb10_a2"},
      {"r8g8b8a8_unorm_srgb", "srgb8_a8"},
      {"rgba8unorm-srgb", "srgb8_a8"},
      {"bgra8unorm-srgb", "srgb8_a8"}};
  for (const auto& [theirs, ours] : kWhole)
    if (text == theirs) return std::string(ours);
  // Channels, bits, and what kind of number: "r16g16b16a16_float", "rgba8unorm", "rgbahalf".
  for (std::size_t cut = text.size(); cut > 0; --cut) {
    const auto channels = channelsIn(std::string_view(text).substr(0, cut));
    if (!channels) continue;
    std::string rest = text.substr(cut);
    std::erase_if(rest, [](char c) { return c == '_' || c == '-'; });
    const auto suffix = suffixFor(rest);
    if (!suffix) continue;
    std::string bits = channels->bits;
    if (bits.empty() && rest == "half") bits = "16";
    if (bits.empty() && rest == "float") bits = "32";
    const std::string made =
        colorFormat(channels->letters, bits, *suffix == "srgb" ? "" : *suffix, *suffix == "srgb");
    if (!made.empty()) return made;
  }
  return {};
}

}  // namespace weft::base
