// The shaders of a user shader of mpv: its text, and what mpv gives every pass. Declared in mpv.h.
#include <fmt/format.h>

#include <array>

#include "app/import/mpv.h"
#include "app/import/text.h"
#include "import_glsl.h"

namespace weft::convert {

namespace {

constexpr std::array<std::string_view, 11> kEndings{"_texOff", "_tex", "_raw", "_pos", "_size",  "_pt",
                                                    "_map",    "_off", "_rot", "_mul", "_gather"};

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
  static constexpr std::array<std::string_view, 6> kTaken{"uv",       "result", "mpv_place",
                                                          "mpvPlace", "shift",  "main"};
  glsl.renameTaken(kTaken);
  glsl.blankVersions();
  return glsl.changed();
}

std::set<std::string> namesMentioned(const std::string& text) {
  std::set<std::string> names;
  for (const Token& token : splitTokens(text)) {
    if (!token.word) continue;
    names.emplace(token.text);
    for (const std::string_view ending : kEndings)
      if (token.text.ends_with(ending))
        names.emplace(token.text.substr(0, token.text.size() - ending.size()));
  }
  return names;
}

std::vector<ConvertedText> writeMpvShaders(const MpvFile& file, const MpvNeeds& needs,
                                           const std::string& text, const std::set<std::string>& used,
                                           const std::string& name) {
  std::string members;
  for (const MpvParameter& parameter : file.parameters)
    if (used.contains(parameter.name)) members += fmt::format("  {} {};\n", parameter.type, parameter.name);
  for (const char* size : kMpvSizes)
    if (used.contains(size)) members += fmt::format("  vec2 {};\n", size);
  if (!members.empty()) members = "layout(std140) uniform Parameters {\n" + members + "};\n";
  std::string slots;
  for (const std::string& bound : needs.bound)
    slots +=
        fillTemplate(glsl::mpv_slot, {{"@NAME@", bound}, {"@PRESENT@", presenceDefineOf(bound + "_raw")}});
  for (const std::string& texture : needs.textures)
    slots += fmt::format("\n#ifdef {}\nuniform sampler2D {};\n#endif\n", presenceDefineOf(texture), texture);
  std::vector<ConvertedText> out;
  const auto add = [&](const std::string& file_name, std::string content) {
    out.push_back({fmt::format("shaders/{}/{}", name, file_name), std::move(content)});
  };
  add("mpv.glsl",
      fillTemplate(glsl::mpv, {{"@NAME@", name}, {"@PARAMETERS@\n", members}, {"@SLOTS@\n", slots}}));
  add(name + ".hook.glsl", text);
  if (needs.fragment) add(name + ".frag.glsl", fillTemplate(glsl::mpv_fragment, {{"@NAME@", name}}));
  if (needs.compute) add(name + ".comp.glsl", fillTemplate(glsl::mpv_compute, {{"@NAME@", name}}));
  add("turn.frag.glsl", glsl::mpv_turn);
  add("show.frag.glsl", glsl::mpv_show);
  return out;
}

}  // namespace weft::convert
