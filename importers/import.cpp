#include "importers/import.h"

#include <filesystem>

#include "engine/text/files/file.h"
#include "importers/text.h"

namespace weft::importing {

std::string vertexFileOf(const std::string& path) {
  return std::filesystem::path(path).replace_extension(".vs").string();
}

std::optional<Converted> convertFile(const std::string& path, ConvertOptions options,
                                     text::Diagnostics& diagnostics) {
  const auto text = text::readTextFile(path, diagnostics);
  if (!text) return std::nullopt;
  if (options.name.empty())
    options.name = identifierOf(std::filesystem::path(path).stem().string()).substr(0, 60);
  if (text->starts_with("//!") || text->find("\n//!") != std::string::npos)
    return convertMpv(*text, path, options, diagnostics);
  if (std::filesystem::path(path).extension() == ".fs") {
    IsfSource source{.fragment = *text, .fragmentFile = path, .vertexFile = vertexFileOf(path)};
    std::error_code ec;
    const bool has = std::filesystem::exists(source.vertexFile, ec);
    const auto vertex = has ? text::readTextFile(source.vertexFile, diagnostics) : std::nullopt;
    if (has && !vertex) return std::nullopt;
    if (vertex) source.vertex = *vertex;
    return convertIsf(source, options, diagnostics);
  }
  refuse(diagnostics, text::Code::unknownPipeline, {path, 1, 1},
         "the file is of no kind that can be imported",
         "an ISF file ends in .fs, a user shader of mpv has lines //!HOOK: see docs/importing.md");
  return std::nullopt;
}

}  // namespace weft::importing
