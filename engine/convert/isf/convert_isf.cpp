#include "engine/convert/isf/convert_isf.h"

#include <fmt/format.h>

#include "engine/convert/isf/graph.h"
#include "engine/convert/isf/header.h"
#include "engine/convert/isf/names.h"
#include "engine/convert/isf/shader.h"

namespace weft::convert {

std::optional<Converted> convertIsf(const IsfSource& source, const ConvertOptions& options,
                                    base::Diagnostics& diagnostics) {
  const auto file = std::make_shared<const std::string>(source.fragmentFile);
  const auto header = readIsfHeader(source.fragment, file, diagnostics);
  if (!header) return std::nullopt;
  std::vector<std::string> images;
  for (const IsfInput& input : header->inputs)
    if (input.type == IsfInput::Type::image) images.push_back(input.name);
  if (!checkImageNames(options, images, diagnostics)) return std::nullopt;
  IsfNames names(*header);
  auto shader = translateIsfShader(source, options, *header, names, diagnostics);
  if (!shader) return std::nullopt;
  const auto graph = writeIsfGraph(*header, names, *shader, options, {file, 1, 1}, diagnostics);
  if (!graph) return std::nullopt;
  Converted out{.graph = options.name + ".json"};
  out.texts.push_back({out.graph, *graph});
  for (ConvertedText& text : shader->texts) out.texts.push_back(std::move(text));
  if (graph->find("/show.frag.glsl\"") != graph->npos)
    out.texts.push_back({fmt::format("shaders/{}/show.frag.glsl", options.name),
                         "// Shows the last target as the picture. Slots: source\n"
                         "uniform sampler2D source;\n"
                         "in vec2 uv;\n"
                         "out vec4 result;\n"
                         "void main() { result = texture(source, uv); }\n"});
  return out;
}

}  // namespace weft::convert
