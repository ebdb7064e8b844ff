#include "engine/convert/mpv/convert_mpv.h"

#include <memory>

#include "engine/base/chars.h"
#include "engine/convert/mpv/blocks.h"
#include "engine/convert/mpv/graph.h"
#include "engine/convert/mpv/shader.h"
#include "engine/convert/mpv/texture_data.h"

namespace weft::convert {

bool looksLikeMpv(std::string_view text) {
  for (std::size_t at = text.find("//!"); at != text.npos; at = text.find("//!", at + 3)) {
    std::size_t begin = at;
    while (begin > 0 && (text[begin - 1] == ' ' || text[begin - 1] == '\t')) --begin;
    const std::string_view word = text.substr(at + 3, 7);
    const bool header = word.starts_with("HOOK") || word.starts_with("TEXTURE") ||
                        word.starts_with("PARAM") || word.starts_with("DESC") || word.starts_with("BIND");
    if (header && (begin == 0 || text[begin - 1] == '\n')) return true;
  }
  return false;
}

std::optional<Converted> convertMpv(std::string_view text, const std::string& file,
                                    const ConvertOptions& options, base::Diagnostics& diagnostics) {
  const auto parsed = readMpvFile(text, std::make_shared<const std::string>(file), diagnostics);
  if (!parsed) return std::nullopt;
  static const std::string kPicture[] = {"picture"};
  if (!checkImageNames(options, kPicture, diagnostics)) return std::nullopt;
  const std::string translated = translateMpvText(*parsed);
  const std::set<std::string> used = namesMentioned(translated);
  const auto graph = writeMpvGraph(*parsed, used, options.name, options, diagnostics);
  if (!graph) return std::nullopt;
  Converted out{.graph = options.name + ".json"};
  out.texts.push_back({out.graph, graph->text});
  for (ConvertedText& each : writeMpvShaders(*parsed, *graph, translated, used, options.name))
    out.texts.push_back(std::move(each));
  for (const MpvTexture& texture : parsed->textures)
    out.images.push_back(imageOf(texture, "images/" + options.name));
  return out;
}

}  // namespace weft::convert
