#include "app/trials/report_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/assets/images/image.h"
#include "engine/text/printable.h"
#include "report_head.h"

namespace weft::app {

namespace {

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

std::string figure(const std::string& content, std::string_view caption, bool flips = false) {
  return fmt::format("<figure{}>{}<figcaption>{}</figcaption></figure>\n",
                     flips ? R"( class="flip" tabindex="0")" : "", content, caption);
}

std::string section(const TestCase& test, const CaseResult& result) {
  std::string text = fmt::format("<h2 id=\"{0}\">{0}</h2>\n<p>{1}</p>\n", escapeHtml(test.name),
                                 escapeHtml(test.options.graph));
  if (result.first)
    text += fmt::format("<p class=\"first\">first that differs: {}</p>\n", escapeHtml(result.first->text()));
  for (const std::string& line : result.lines) text += fmt::format("<p>{}</p>\n", escapeHtml(line));
  for (const CaseResult::Pair& pair : result.pairs) {
    const std::string picture = imageTag(pair.picture, "picture"), golden = imageTag(pair.expected, "golden");
    text += "<div class=\"row\">\n" + figure(picture, fmt::format("picture, frame {}", pair.frame)) +
            figure(golden, "golden: " + escapeHtml(pair.golden));
    if (!pair.map.errors.empty())
      text +=
          figure(imageTag(assets::colorFlip(pair.map), "FLIP"), "FLIP: 0 <span class=\"scale\"></span> 1") +
          figure(picture + golden, "the picture; with the pointer over it the golden", true);
    text += "</div>\n";
  }
  return text;
}

}  // namespace

std::string pageHead(std::string_view title) {
  return kReportHead + fmt::format("<title>{}</title></head><body>\n", escapeHtml(title));
}

std::string imageTag(const assets::Image8& image, std::string_view alt) {
  if (image.texels.empty()) return fmt::format("<p>no {}</p>", alt);
  // Pictures are shown as a screen shows them, without alpha.
  assets::Image8 opaque{image.width, image.height, 3, {}};
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < image.texels.size(); i += channels)
    opaque.texels.insert(opaque.texels.end(), &image.texels[i], &image.texels[i] + 3);
  return fmt::format(R"(<img alt="{}" src="data:image/png;base64,{}">)", alt,
                     encodeBase64(assets::encodePng8(opaque.width, opaque.height, 3, opaque.texels)));
}

std::string escapeHtml(std::string_view text) {
  std::string out;
  for (const char c : text)
    out += c == '&'   ? "&amp;"
           : c == '<' ? "&lt;"
           : c == '>' ? "&gt;"
           : c == '"' ? "&quot;"
                      : std::string(1, c);
  return out;
}

std::string reportPage(const std::vector<std::pair<TestCase, CaseResult>>& results) {
  const auto failed = std::ranges::count_if(results, [](const auto& entry) {
    return entry.second.state == CaseResult::State::different ||
           entry.second.state == CaseResult::State::broken;
  });
  std::string page = pageHead("weft test") + fmt::format("<h1>weft test: {} of {} failed</h1>\n", failed,
                                                         text::counted(results.size(), "case"));
  for (const auto& [test, result] : results)
    if (result.state == CaseResult::State::different) page += section(test, result);
  for (const auto& [test, result] : results)
    if (result.state == CaseResult::State::broken)
      page += fmt::format("<h2>{}</h2>\n<p>it could not be compared; the messages of the run say why</p>\n",
                          escapeHtml(test.name));
  return page + "</body></html>\n";
}

}  // namespace weft::app
