#include "app/output/page.h"

#include <utility>
#include <vector>

#include "engine/text/files/file.h"

namespace weft::app {

namespace {

// Nothing of it ends an element.
std::string escaped(std::string_view text, std::string_view forLess) {
  std::string out;
  for (const char c : text) out += c == '<' ? std::string(forLess) : std::string(1, c);
  return out;
}

}  // namespace

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
  auto page = text::readTextFile(folder + "html", diagnostics);
  const auto style = text::readTextFile(folder + "css", diagnostics),
             script = text::readTextFile(folder + "js", diagnostics);
  if (!page || !style || !script) return std::nullopt;
  using Json = nlohmann::ordered_json;
  const std::string data = report.dump(-1, ' ', false, Json::error_handler_t::replace);
  for (const auto& [mark, value] :
       std::initializer_list<std::pair<std::string, std::string>>{{"{title}", escaped(title, "&lt;")},
                                                                  {"{style}", *style},
                                                                  {"{script}", *script},
                                                                  {"{report}", escaped(data, "\\u003c")}})
    page->replace(page->find(mark), mark.size(), value);
  return page;
}

}  // namespace weft::app
