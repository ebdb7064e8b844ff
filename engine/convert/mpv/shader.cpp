#include "engine/convert/mpv/shader.h"

#include <fmt/format.h>

#include <array>

#include "engine/convert/text/glsl_text.h"
#include "engine/convert/text/legacy_glsl.h"

namespace weft::convert {

namespace {

constexpr std::array<std::string_view, 10> kEndings{"_texOff", "_tex", "_raw", "_pos", "_size",
                                                    "_pt",     "_map", "_off", "_rot", "_mul"};

// What mpv defines for a picture that a pass binds.
std::string bindText(const std::string& name) {
  return fmt::format(
      "\n#ifdef {1}\n"
      "uniform sampler2D {0}_raw;\n"
      "#define {0}_size vec2(textureSize({0}_raw, 0))\n"
      "#define {0}_pt (1.0 / {0}_size)\n"
      "#define {0}_mul 1.0\n"
      "#define {0}_rot mat2(1.0)\n"
      "#define {0}_off vec2(0.0)\n"
      "#define {0}_map(id) mpvPlace(vec2(id))\n"
      "#define {0}_pos mpv_place\n"
      "#define {0}_tex(pos) texture({0}_raw, pos)\n"
      "#define {0}_texOff(off) texture({0}_raw, {0}_pos + {0}_pt * vec2(off))\n"
      "#define {0}_gather(pos, c) textureGather({0}_raw, pos, c)\n"
      "#endif\n",
      name, presenceDefineOf(name + "_raw"));
}

}  // namespace

std::string translateMpvText(const MpvFile& file) {
  const bool many = file.hooks.size() > 1;
  std::string text;
  std::size_t next = 0;
  for (std::size_t line = 0; line < file.lines.size(); ++line) {
    if (many && next < file.hooks.size() && file.hooks[next].headerLine == line) {
      text += fmt::format("#{} PASS == {}  {}", next == 0 ? "if" : "elif", next, file.lines[line]);
      ++next;
    } else if (!file.data[line]) {
      text += file.lines[line];
    }
    text += '\n';
  }
  if (many) text += "#endif\n";
  GlslText glsl(text);
  static const std::array<std::string, 6> kTaken{"uv", "result", "mpv_place", "mpvPlace", "shift", "main"};
  renameTaken(glsl, kTaken);
  for (std::size_t i = 0; i < glsl.tokens().size(); ++i) {
    const std::string_view directive = glsl.directiveOf(i);
    if (glsl.tokens()[i].first && (directive == "version" || directive == "extension" || directive == "line"))
      glsl.blankDirective(i);
  }
  return glsl.changed();
}

std::set<std::string> namesMentioned(const std::string& text) {
  std::set<std::string> names;
  for (const glsl::Token& token : glsl::splitTokens(text)) {
    if (token.kind != glsl::TokenKind::word) continue;
    names.emplace(token.text);
    for (const std::string_view ending : {std::string_view("_gather")})
      if (token.text.ends_with(ending))
        names.emplace(token.text.substr(0, token.text.size() - ending.size()));
    for (const std::string_view ending : kEndings)
      if (token.text.ends_with(ending))
        names.emplace(token.text.substr(0, token.text.size() - ending.size()));
  }
  return names;
}

std::vector<ConvertedText> writeMpvShaders(const MpvFile& file, const MpvGraph& graph,
                                           const std::string& text, const std::set<std::string>& used,
                                           const std::string& name) {
  const std::string folder = "shaders/" + name + "/", own = name + ".hook.glsl";
  std::string prelude = fmt::format(
      "// What mpv gives every pass of {}. The slots are NAME_raw for each texture that a pass binds.\n",
      name);
  if (used.contains("frame") || used.contains("random"))
    prelude += "layout(std140) uniform View { uint frame; };\n";
  if (used.contains("random"))
    prelude +=
        "// From 0 to 1, another in each frame; by the frame's number, so that a frame is always the same.\n"
        "#define random (float((frame * 747796405u + 2891336453u) >> 8) / 16777216.0)\n";
  if (used.contains("frame")) prelude += "#define frame int(frame)\n";
  std::string members;
  for (const MpvParameter& parameter : file.parameters)
    if (used.contains(parameter.name)) members += fmt::format("  {} {};\n", parameter.type, parameter.name);
  for (const char* size : kMpvSizes)
    if (used.contains(size)) members += fmt::format("  vec2 {};\n", size);
  if (!members.empty()) prelude += "layout(std140) uniform Parameters {\n" + members + "};\n";
  if (used.contains("tex_offset")) prelude += "const vec2 tex_offset = vec2(0.0);\n";
  for (const std::string& bound : graph.bound) prelude += bindText(bound);
  for (const std::string& texture : graph.textures)
    prelude +=
        fmt::format("\n#ifdef {}\nuniform sampler2D {};\n#endif\n", presenceDefineOf(texture), texture);
  std::vector<ConvertedText> out;
  out.push_back({folder + "mpv.glsl", prelude});
  out.push_back({folder + own, text});
  if (graph.fragment)
    out.push_back({fmt::format("{}{}.frag.glsl", folder, name),
                   fmt::format("// A pass of {0}, by PASS. The lines of {1} are those of mpv's file.\n"
                               "in vec2 uv;\n"
                               "out vec4 result;\n"
                               "vec2 mpv_place = uv;\n"
                               "vec2 mpvPlace(vec2 id) {{ return (id + 0.5) * uv / gl_FragCoord.xy; }}\n"
                               "#include \"mpv.glsl\"\n"
                               "#include \"{1}\"\n"
                               "void main() {{ result = hook(); }}\n",
                               name, own)});
  if (graph.compute)
    out.push_back(
        {fmt::format("{}{}.comp.glsl", folder, name),
         fmt::format("// A pass of {0}, by PASS. The lines of {1} are those of mpv's file.\n"
                     "layout(local_size_x = THREADS_X, local_size_y = THREADS_Y) in;\n"
                     "layout(rgba16f) uniform writeonly image2D out_image;\n"
                     "vec2 mpvPlace(vec2 id) {{ return (id + 0.5) / vec2(imageSize(out_image)); }}\n"
                     "vec2 mpv_place = mpvPlace(vec2(gl_GlobalInvocationID.xy));\n"
                     "#include \"mpv.glsl\"\n"
                     "#include \"{1}\"\n"
                     "void main() {{ hook(); }}\n",
                     name, own)});
  out.push_back({folder + "turn.frag.glsl",
                 "// The picture with its first row at the top, as mpv counts rows. Slots: source?\n"
                 "#ifdef HAS_SOURCE\n"
                 "uniform sampler2D source;\n"
                 "#endif\n"
                 "in vec2 uv;\n"
                 "out vec4 result;\n"
                 "void main() {\n"
                 "#ifdef HAS_SOURCE\n"
                 "  result = texture(source, vec2(uv.x, 1.0 - uv.y));\n"
                 "#else\n"
                 "  result = vec4(0.0, 0.0, 0.0, 1.0);\n"
                 "#endif\n"
                 "}\n"});
  out.push_back({folder + "show.frag.glsl",
                 "// Turns the picture back, scales it to the screen and undoes what the passes shifted. "
                 "Slots: source\n"
                 "uniform sampler2D source;\n"
                 "layout(std140) uniform Parameters { vec2 shift; };\n"
                 "in vec2 uv;\n"
                 "out vec4 result;\n"
                 "void main() { result = texture(source, vec2(uv.x, 1.0 - uv.y) + shift); }\n"});
  return out;
}

}  // namespace weft::convert
