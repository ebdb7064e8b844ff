// weft new pass: a graph with one pass more, and the shader of that pass, both commented.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

#include "app/commands/commands.h"
#include "app/output/output_files.h"
#include "app/output/standard_streams.h"
#include "app/session/session.h"
#include "engine/graph/language/names.h"
#include "engine/graph/read/read.h"
#include "engine/text/files/file.h"
#include "engine/text/json/edit.h"
#include "engine/text/printable.h"

namespace weft::app {

namespace {

constexpr std::size_t kLongestName = 64;

// Where the new pass goes: behind the last stanza, and the texture that is shown.
struct Anchor {
  std::string after, texture;
};

std::optional<Anchor> findAnchor(const std::string& graphFile, const std::string& name,
                                 text::Diagnostics& diagnostics) {
  const auto desc = graph::readGraph(graphFile, diagnostics);
  if (!desc || diagnostics.hasErrors()) return std::nullopt;
  const text::Place place = {std::make_shared<const std::string>(graphFile), 1, 1};
  for (const graph::PassDesc& pass : desc->passes)
    if (pass.name == name) {
      diagnostics
          .error(text::Code::duplicateName, pass.namePlace, fmt::format("the graph has a pass '{}'", name))
          .hint = fmt::format("give the new pass another name, such as 'my_{}'", name);
      return std::nullopt;
    }
  const auto& present = desc->present;
  const bool whole =
      present && !present->mip && !present->layer && !present->face && !present->element && !present->import;
  if (whole && !desc->passes.empty()) return Anchor{desc->passes.back().name, present->name};
  text::Diagnostic& d =
      diagnostics.error(text::Code::presentsNothing, present ? present->place : place,
                        "the graph presents no whole texture of its own that a pass could change");
  d.expected = "\"present\": \"<texture>\" and a pass";
  if (present) d.found = present->text;
  return std::nullopt;
}

// `base` as JSON.
std::string stanzaText(const std::string& name, const std::string& base, const Anchor& anchor) {
  return fmt::format(R"({{
  // An overlay: the graph below with one pass more. Run it with: weft view {0}.json
  "extends": {1},
  "passes": [
    {{ "name": "{0}", "after": "{2}", "type": "fullscreen",
      // Looked for in the folder "shaders" beside this file.
      "shader": "{0}/{0}.frag.glsl",
      // Slots: the name in the shader, then the texture. Reading and writing one texture makes its next version, so that the pass
      // may be moved or disabled. More textures: "depth": "depth", "mask": "@image", a half-size one: declare it in "resources".
      "read": {{ "source": "{3}" }},
      "write": {{ "result": "{3}" }},
      // Each becomes a uniform of the block Parameters, an option --set {0}.strength=0.5, and a slider in the viewer.
      "parameters": {{
        "strength": {{ "type": "float", "default": 1, "min": 0, "max": 1, "label": "Strength of {0}" }}
      }} }}
  ]
}}
)",
                     name, base, anchor.after, anchor.texture);
}

std::string shaderText(const std::string& name) {
  return fmt::format(R"(// {0}: darkens the picture towards its edges. Replace this by what the pass shall do.
// read    source    the picture before this pass
// write   result    the picture after it
// params  strength  0: nothing changes, 1: the corners are black
uniform sampler2D source;
layout(std140) uniform Parameters {{ float strength; }};
in vec2 uv;  // (0,0) at the lower left, (1,1) at the upper right
out vec4 result;

void main() {{
  vec4 color = texelFetch(source, ivec2(gl_FragCoord.xy), 0);
  vec2 from_center = uv - 0.5;
  result = vec4(color.rgb * (1.0 - strength * 2.0 * dot(from_center, from_center)), color.a);
}}
)",
                     name);
}

struct NewOptions {
  std::string what, name, graph, folder;
};

int runNew(NewOptions& options) {
  namespace fs = std::filesystem;
  text::Diagnostics diagnostics;
  if (options.graph.empty()) options.graph = dataFolder() + "/graphs/glow.json";
  const std::string& name = options.name;
  if (!graph::isIdent(name) || name[0] == '_' || name.size() > kLongestName || graph::isReservedWord(name)) {
    diagnostics
        .error(text::Code::notAName, text::placeOfOption("new pass " + name),
               fmt::format("\"{}\" cannot name a pass", name))
        .expected =
        fmt::format("a letter, then letters, digits and '_', {} at most, and none of the words {}",
                    kLongestName, fmt::join(graph::kReservedWords, ", "));
    return report(diagnostics);
  }
  const auto anchor = findAnchor(options.graph, name, diagnostics);
  if (!anchor) return report(diagnostics);
  const fs::path folder = options.folder.empty() ? "." : options.folder;
  std::error_code failed;
  const fs::path beside = fs::relative(options.graph, folder, failed);
  const std::string graphFile = (folder / (name + ".json")).lexically_normal().string();
  const std::string shaderFile =
      (folder / "shaders" / name / (name + ".frag.glsl")).lexically_normal().string();
  const std::string extended =
      failed || beside.empty() ? fs::absolute(options.graph).string() : beside.string();
  const std::string files[] = {graphFile, shaderFile};
  if (checkFree(files, diagnostics) && makeFolderOf(shaderFile, diagnostics) &&
      text::writeFile(graphFile, stanzaText(name, text::quoteJson(extended), *anchor), diagnostics) &&
      text::writeFile(shaderFile, shaderText(name), diagnostics)) {
    const std::string graph = text::printable(graphFile);
    print(fmt::format("{}\n{}\nweft render {} -o {}.png\n", graph, text::printable(shaderFile), graph, name));
  }
  return report(diagnostics);
}

}  // namespace

void addNew(CommandLine& line) {
  const auto [command, options] = line.add(
      "new", "write a graph with a new pass behind an existing graph, and its shader, commented", runNew);
  addChoice(command, "what", options.what, "what to write: pass", {"pass"})->required();
  command.add_option("name", options.name, "name of the pass: letters, digits and _")->required();
  addPath(command, "--graph", options.graph, "the graph to extend (default: the bundled graphs/glow.json)");
  addPath(command, "-o,--output", options.folder, "folder to write into (default: here)", "FOLDER");
  command.footer("Example: weft new pass tint -o out/tint");
}

}  // namespace weft::app
