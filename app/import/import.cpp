#include "app/import/import.h"

#include <filesystem>

#include "app/import/isf.h"
#include "app/import/text.h"
#include "engine/base/files/text_file.h"

namespace weft::convert {

namespace fs = std::filesystem;

namespace {

// Whether a line begins with a header of mpv.
bool looksLikeMpv(std::string_view text) {
  for (std::size_t at = text.find("//!"); at != text.npos; at = text.find("//!", at + 3)) {
    std::size_t begin = at;
    while (begin > 0 && (text[begin - 1] == ' ' || text[begin - 1] == '\t')) --begin;
    if (begin > 0 && text[begin - 1] != '\n') continue;
    for (const std::string_view word : {"HOOK", "TEXTURE", "PARAM", "DESC", "BIND"})
      if (text.substr(at + 3).starts_with(word)) return true;
  }
  return false;
}

}  // namespace

std::string vertexFileOf(const std::string& path) {
  return fs::path(path).replace_extension(".vs").string();
}

std::optional<Converted> convertFile(const std::string& path, ConvertOptions options,
                                     base::Diagnostics& diagnostics) {
  const auto text = base::readTextFile(path, diagnostics);
  if (!text) return std::nullopt;
  if (options.name.empty()) options.name = identifierOf(fs::path(path).stem().string()).substr(0, 60);
  if (looksLikeMpv(*text)) return convertMpv(*text, path, options, diagnostics);
  if (looksLikeIsf(*text) || fs::path(path).extension() == ".fs") {
    IsfSource source{.fragment = *text, .fragmentFile = path, .vertexFile = vertexFileOf(path)};
    std::optional<std::string> vertex;
    std::error_code ec;
    if (fs::exists(source.vertexFile, ec)) {  // reading says so where it may not be read
      vertex = base::readTextFile(source.vertexFile, diagnostics);
      if (!vertex) return std::nullopt;
      source.vertex = *vertex;
      source.hasVertex = true;
    }
    return convertIsf(source, options, diagnostics);
  }
  refuse(diagnostics, base::Code::unknownPipeline, {std::make_shared<const std::string>(path), 1, 1},
         "the file is of no kind that can be imported",
         "an ISF file begins with /*{ … }*/, a user shader of mpv has lines //!HOOK: see docs/importing.md");
  return std::nullopt;
}

}  // namespace weft::convert
