#include "engine/convert/convert.h"

#include <filesystem>

#include "engine/base/files/file_access.h"
#include "engine/base/files/text_file.h"
#include "engine/convert/isf/convert_isf.h"
#include "engine/convert/isf/header.h"
#include "engine/convert/mpv/convert_mpv.h"
#include "engine/convert/text/glsl_text.h"

namespace weft::convert {

namespace fs = std::filesystem;

std::string nameForFile(const std::string& path) {
  return identifierOf(fs::path(path).stem().string()).substr(0, 60);
}

std::string vertexFileOf(const std::string& path) {
  return fs::path(path).replace_extension(".vs").string();
}

std::optional<Converted> convertFile(const std::string& path, ConvertOptions options,
                                     base::Diagnostics& diagnostics) {
  const auto text = base::readTextFile(path, diagnostics);
  if (!text) return std::nullopt;
  if (options.name.empty()) options.name = nameForFile(path);
  const std::string extension = fs::path(path).extension().string();
  if (looksLikeMpv(*text)) return convertMpv(*text, path, options, diagnostics);
  if (looksLikeIsf(*text) || extension == ".fs") {
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
  auto& d = diagnostics.error(base::Code::unknownPipeline, {std::make_shared<const std::string>(path), 1, 1},
                              "the file is of no kind that can be imported");
  d.expected = "an ISF file, which begins with /*{ … }*/, or a user shader of mpv with //!HOOK";
  d.hint = "docs/importing.md says what each looks like";
  return std::nullopt;
}

}  // namespace weft::convert
