#include "app/commands/shader_stanza.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <utility>

#include "app/session/session.h"
#include "engine/glsl/interface.h"
#include "engine/glsl/tokens.h"
#include "engine/runtime/prepare/program_request.h"

namespace weft::app {

namespace {

namespace fs = std::filesystem;
using glsl::Declaration;
using glsl::Role;
using Json = nlohmann::ordered_json;

// The folder that a graph calls `shaders`, or that of the file, and the file as seen from there.
std::pair<fs::path, std::string> rootOf(const std::string& path) {
  const fs::path file = fs::path(path).lexically_normal();
  fs::path root = file.parent_path();
  for (fs::path folder = root; folder.has_filename(); folder = folder.parent_path())
    if (folder.filename() == "shaders") root = folder;
  return {root.empty() ? "." : root, file.lexically_relative(root).generic_string()};
}

bool isNeeded(const glsl::Interface& shader, const Declaration& declared) {
  const bool block = declared.role == Role::uniform_block || declared.role == Role::storage_block;
  return declared.role == Role::output || shader.isLive(declared) ||
         (block && std::ranges::any_of(shader.declarations, [&](const Declaration& each) {
            return each.role == Role::member && each.owner == declared.name && shader.isLive(each.name);
          }));
}

// Zeros for a member of that type.
Json zeroOf(const Declaration& member) {
  if (member.type == "bool") return false;
  const std::size_t vec = member.type.find("vec");
  if (vec == std::string_view::npos || vec > 1 || !member.array.empty()) return 0;
  return Json(std::vector<int>(static_cast<std::size_t>(member.type.back() - '0'), 0));
}

class StanzaMaker {
 public:
  StanzaMaker(ShaderStanza& made, bool compute) : made_(made), compute_(compute) {}

  // `last`: what the shader puts out is written to textures.
  void add(const glsl::ShaderSource& source, bool last) {
    const glsl::Interface& shader = source.ofAllBranches();
    for (const Declaration& declared : shader.declarations)
      if (isNeeded(shader, declared)) add(declared, last, !source.interfaceWith({}).find(declared.name));
    const glsl::Conditions conditions = glsl::conditionsOf(source.text);
    // `compiled`: nothing compiles without.
    const auto define = [&](std::string_view word, int value, bool compiled) {
      const bool own = conditions.made.contains(word) || word.starts_with("HAS_") ||
                       word.starts_with("GL_") || word.starts_with("__");
      if (!own && made_.pass["defines"].emplace(word, value).second && compiled)
        made_.request.defines.push_back({std::string(word), std::to_string(value)});
    };
    const std::set used(conditions.used.begin(), conditions.used.end());
    for (const std::string_view word : used)  // that are written as macros are: LAMP_TILE
      if (word.size() > 1 && std::isupper(static_cast<unsigned char>(word[0])) && !shader.find(word) &&
          std::ranges::none_of(word, [](unsigned char c) { return std::islower(c); }))
        define(word, 4, true);  // often a count
    for (const auto* words : {&conditions.valued, &conditions.tested})
      for (const glsl::Token& word : *words) define(word.text, 1, shader.live.contains(word.text));
  }

 private:
  void add(const Declaration& declared, bool last, bool optional) {
    const std::string name(declared.name);
    const char* const access = !declared.writes ? "read" : declared.reads ? "modify" : "write";
    // Both stages may declare it.
    const auto slot = [&](const char* key, const char* kind = "") {
      Json& slots = made_.pass[key];
      const Json text = name + kind + (optional ? " ?" : "");
      if (std::find(slots.begin(), slots.end(), text) != slots.end()) return;
      slots.push_back(text);
      made_.request.defines.push_back({glsl::presenceDefineOf(name), "1"});
    };
    switch (declared.role) {
      case Role::sampler:
        return slot("read");
      case Role::image:
        return slot(access, compute_ && declared.writes ? "" : " as image");
      case Role::storage_block:
        return slot(access);
      case Role::uniform_block:
        if (name != "Parameters" && name != "View" && name != "Slice") slot("read", " as uniform");
        return;
      case Role::output:
        if (!last || compute_) return;
        made_.request.outputs.push_back(name);
        return slot("write");
      case Role::member:
        if (declared.owner == "Parameters" && made_.pass["parameters"].emplace(name, zeroOf(declared)).second)
          made_.request.defines.push_back({glsl::presenceDefineOf(name), "1"});
        return;
      default:
        return;
    }
  }

  ShaderStanza& made_;
  bool compute_;
};

}  // namespace

std::optional<ShaderStanza> stanzaFor(const std::string& path, glsl::SourceLoader& sources,
                                      text::Diagnostics& diagnostics) {
  const auto [root, file] = rootOf(path);
  const bool compute = file.ends_with(".comp.glsl"), vertex = file.ends_with(".vert.glsl");
  if (!compute && !vertex && !file.ends_with(".frag.glsl")) {
    text::Diagnostic& d = diagnostics.error(text::Code::unreadableShader, {path, 1, 1},
                                            fmt::format("'{}' is no stage of a shader", path));
    d.expected = "a name that ends in .frag.glsl, .vert.glsl or .comp.glsl";
    d.hint = "a file that others include is checked with a shader that includes it";
    return std::nullopt;
  }
  ShaderStanza made;
  std::vector<std::string> roots = runtime::shaderRootsOf({}, dataFolder());
  roots.insert(roots.begin(), root.string());
  sources.setRoots(std::move(roots));
  const std::string stem = file.substr(0, file.size() - std::string_view(".frag.glsl").size());
  const std::string name = fs::path(stem).filename().string();
  const bool pair = vertex || (!compute && sources.locate(stem + ".vert.glsl"));
  made.pass = {{"name", name},
               {"type", compute ? "compute"
                        : pair  ? "draw"
                                : "fullscreen"},
               {"shader", pair ? stem : file}};
  made.request.label = name;
  auto& stages = made.request.stages;
  if (pair) stages.push_back({GL_VERTEX_SHADER, stem + ".vert.glsl", ""});
  const GLenum last = compute ? GL_COMPUTE_SHADER : GL_FRAGMENT_SHADER;
  stages.push_back({last, vertex ? stem + ".frag.glsl" : file, ""});
  bool uvAlone = true;  // what the vertex shader of a fullscreen pass puts out
  for (const auto& stage : stages) {
    const auto source = sources.load(stage.file, diagnostics, {path, 1, 1});
    if (!source) return std::nullopt;
    StanzaMaker(made, compute).add(*source, &stage == &stages.back());
    for (const Declaration& each : source->ofAllBranches().declarations)
      uvAlone = uvAlone && (each.role != Role::input || each.name == "uv");
  }
  if (!compute && !pair && uvAlone) {
    stages.insert(stages.begin(), {GL_VERTEX_SHADER, "fullscreen.vert.glsl", runtime::kFullscreenVertex});
  } else if (!compute && !pair) {
    made.pass["type"] = "draw";
    made.pass["shader"] = {{"vertex", stem + ".vert.glsl"}, {"fragment", file}};
  }
  return made;
}

}  // namespace weft::app
