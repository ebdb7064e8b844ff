#include "app/lsp/files/workspace.h"

#include <algorithm>
#include <filesystem>
#include <functional>

#include "app/session/session.h"
#include "engine/graph/compile/compile.h"
#include "engine/graph/expand/expand.h"
#include "engine/graph/read/read.h"
#include "engine/runtime/frame/renderer.h"
#include "engine/runtime/imports/registry.h"
#include "engine/runtime/prepare/program_check.h"
#include "engine/runtime/prepare/program_request.h"
#include "engine/text/files/file.h"

namespace weft::app::lsp {

namespace fs = std::filesystem;

namespace {

constexpr int kMaxFiles = 20000;  // looked at in a folder

// Graphs are checked even when the scene cannot be read, so its messages are left out.
runtime::WorldFacts factsOf(const Options& options) {
  text::Diagnostics ignored;
  const auto world = loadWorld(options, ignored);
  return world ? world->facts() : factsWithoutWorld();
}

void listFiles(const std::string& folder, std::set<std::string>& out) {
  std::error_code ec;
  int looked = 0;
  for (auto entry =
           fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied, ec);
       !ec && entry != fs::recursive_directory_iterator() && ++looked < kMaxFiles; entry.increment(ec)) {
    const std::string name = entry->path().filename().string();
    if (entry->is_directory(ec) &&
        (name.starts_with('.') || name == "build" || name == "out" || name == "node_modules"))
      entry.disable_recursion_pending();
    else if (name.ends_with(".json") && entry->is_regular_file(ec))
      out.insert(pathKey(entry->path().string()));
  }
}

// Calls f(pass, prefix) for the passes and includes of a graph and of all that it includes.
void eachPass(const graph::GraphDesc& desc, const std::string& prefix,
              const std::function<void(const graph::PassDesc&, const std::string&)>& f) {
  for (const graph::PassDesc& pass : desc.passes) {
    f(pass, prefix);
    if (pass.include && pass.include->graph) eachPass(*pass.include->graph, prefix + pass.name + ".", f);
  }
}

std::vector<ShaderKey> keysOf(const graph::PassDesc& pass) {
  std::vector<ShaderKey> keys;
  const auto add = [&](ShaderKey::Kind kind, std::string name, text::Place place) {
    ++place.column;  // behind the quote
    keys.push_back({kind, std::move(name), std::move(place)});
  };
  using enum ShaderKey::Kind;
  for (const graph::SlotDesc& each : pass.slots) add(slot, each.name, each.place);
  for (const graph::PassParameterDesc& each : pass.parameters) add(parameter, each.name, each.place);
  for (const graph::NamedExpr& each : pass.defines) add(define, each.name, each.place);
  for (const graph::NamedExpr& each : pass.state)
    if (each.name.starts_with("blend.")) add(slot, each.name.substr(6), each.place);
  return keys;
}

// Where an offset of one text is in another, by what both begin and end with.
std::optional<std::size_t> moved(std::string_view from, std::string_view to, std::size_t offset) {
  const auto begin = static_cast<std::size_t>(std::ranges::mismatch(from, to).in1 - from.begin());
  if (offset < begin) return offset;
  std::size_t end = 0;
  const std::size_t most = std::min(from.size(), to.size()) - begin;
  while (end < most && from[from.size() - 1 - end] == to[to.size() - 1 - end]) ++end;
  if (offset + end < from.size()) return std::nullopt;
  return offset + to.size() - from.size();
}

}  // namespace

std::vector<std::string> shadersOf(const std::string& shader, const std::string& vertexShader) {
  if (shader.empty()) return {};
  if (!vertexShader.empty()) return {vertexShader, shader};
  if (shader.ends_with(".glsl")) return {shader};
  return {shader + ".vert.glsl", shader + ".frag.glsl"};
}

Workspace::Workspace(const Options& options, const Texts& texts)
    : options_(options), texts_(texts), registry_(runtime::makeRegistry({}, factsOf(options))) {}

bool Workspace::isInFolders(const std::string& path) const {
  return std::ranges::any_of(folders_,
                             [&](const std::string& folder) { return path.starts_with(folder + "/"); });
}

// ---- which files are graphs ----

// A file with a key that only graphs, overlays and presets have, or one that was a graph and has a mistake that hides that now,
// such as an open comment or quote before the first key.
bool Workspace::isGraph(const std::string& path) const {
  const auto text = path.ends_with(".json") && text::mayRead(path) ? texts_.of(path) : nullptr;
  if (!text) return false;
  for (const JsonMember& member : text->json().root.members) {
    for (const char* key : {"passes", "resources", "parameters", "let", "extends", "present", "outputs"})
      if (member.key == key) return true;
    if ((member.key == "set" && member.value.is(JsonValue::Type::object)) ||
        (member.key == "$schema" && member.value.text.ends_with("graph.schema.json")))
      return true;
  }
  text::Diagnostics said;
  return graphs_.contains(path) && !text::parseJson(text->bytes(), nullptr, said);
}

// Whether the file sets values and shows no picture, and so does what it extends: the graph below it is missing.
bool Workspace::isPreset(const std::string& path) const {
  std::set<std::string> seen;
  for (std::string at = path; seen.insert(at).second;) {
    const auto text = texts_.of(at);
    if (!text) return false;
    const JsonValue& root = text->json().root;
    const JsonValue* below = root.find("extends");
    if (!below) return root.find("set") && !root.find("present");
    if (!below->items.empty()) below = &below->items.front();
    at = pathKey((fs::path(at).parent_path() / below->text).string());
  }
  return false;
}

// ---- reading ----

void Workspace::read(const std::string& path, Graph& graph) {
  const auto isSame = [&](const auto& known) { return texts_.of(known.first) == known.second; };
  if (!graph.readTexts.empty() && std::ranges::all_of(graph.readTexts, isSame)) return;
  graph.readSaid.clear();
  graph.read = graph::readGraph(path, graph.readSaid);
  graph.readTexts = {{path, texts_.of(path)}};
  if (graph.read)
    for (const std::string& file : graph.read->files)
      graph.readTexts[pathKey(file)] = texts_.of(pathKey(file));
  else if (graph.desc)
    for (const auto& [file, text] : graph.texts) graph.readTexts[file] = texts_.of(file);
  if (!graph.read || (graph.desc && graph.readSaid.contains(text::Code::notJson))) return;
  graph.desc = graph.read;
  graph.texts = graph.readTexts;
  graph.uses = graph::findNameUses(*graph.desc, registry_);
  graph.shaderFolders = runtime::shaderRootsOf(graph.desc->files, dataFolder());
}

void Workspace::readAll() {
  std::set<std::string> files;
  for (const std::string& folder : folders_) listFiles(folder, files);
  for (const auto& [path, version] : texts_.opened()) files.insert(path);
  std::erase_if(files, [&](const std::string& path) { return !isGraph(path); });
  std::erase_if(graphs_, [&](const auto& known) { return !files.contains(known.first); });
  for (const std::string& path : files) read(path, graphs_[path]);
  std::set<std::string> included;
  for (const auto& [path, graph] : graphs_)
    if (graph.desc)
      eachPass(*graph.desc, "", [&](const graph::PassDesc& pass, const std::string&) {
        if (pass.include && pass.include->graph) included.insert(pathKey(pass.include->graph->path));
      });
  roots_.clear();
  for (const bool checked : {true, false})
    for (const auto& [path, graph] : graphs_)
      if (graph.desc && graph.checked == checked && (checked || !included.contains(path)))
        roots_.push_back(&graph);
}

std::optional<Location> Workspace::locate(const Graph& graph, const text::Place& place,
                                          std::string_view name) const {
  if (!place.file || place.line == 0) return std::nullopt;
  const std::string path = pathKey(*place.file);
  const auto then = graph.texts.find(path);
  const auto now = texts_.of(path);
  if (then == graph.texts.end() || !then->second || !now) return std::nullopt;
  const std::size_t offset = text::offsetOf(then->second->bytes(), place);
  const auto at = then->second == now ? offset : moved(then->second->bytes(), now->bytes(), offset);
  if (!at || now->bytes().compare(*at, name.size(), name) != 0) return std::nullopt;
  return Location{path, {*at, *at + name.size()}};
}

text::Place Workspace::placeIn(const Graph& graph, const Text& text, std::size_t offset) const {
  const auto then = graph.texts.find(text.path());
  if (then == graph.texts.end() || !then->second) return {};
  const std::string& bytes = then->second->bytes();
  const auto at = then->second.get() == &text ? offset : moved(text.bytes(), bytes, offset);
  if (!at) return {};
  std::string_view before = std::string_view(bytes).substr(0, *at);
  if (before.starts_with(text::kByteOrderMark)) before.remove_prefix(text::kByteOrderMark.size());
  return {std::make_shared<const std::string>(text.path()),
          static_cast<std::uint32_t>(std::ranges::count(before, '\n') + 1),
          static_cast<std::uint32_t>(before.size() - (before.rfind('\n') + 1) + 1)};
}

// ---- checking ----

std::set<std::string> Workspace::refresh(const std::set<std::string>& changed) {
  std::set<std::string> touched = changed;
  const auto touch = [&](const Graph& graph) { touched.insert(graph.files.begin(), graph.files.end()); };
  // The open graphs that no other open graph includes or extends, and all that include each other in a circle.
  std::map<std::string, Graph*> open;
  for (const auto& [path, version] : texts_.opened())
    if (isGraph(path)) read(path, *(open[path] = &graphs_[path]));
  std::set<std::string> wanted;
  for (const auto& [path, graph] : open)
    if (std::ranges::none_of(open, [&](const auto& other) {
          return other.second->readTexts.contains(path) && !graph->readTexts.contains(other.first);
        }))
      wanted.insert(path);
  for (auto& [path, graph] : graphs_) {
    const bool was = std::exchange(graph.checked, wanted.contains(path));
    if (was && !graph.checked) {
      touch(graph);
      graph.said.clear();
      graph.plan = nullptr;
    }
    if (!graph.checked) continue;
    const bool sameFolders =
        !graph.read || graph.shaderFolders == runtime::shaderRootsOf(graph.read->files, dataFolder());
    if (was && sameFolders &&
        std::ranges::none_of(changed, [&](const std::string& each) { return graph.files.contains(each); }))
      continue;
    touch(graph);
    check(path, graph);
    touch(graph);
  }
  std::erase_if(graphs_,
                [&](const auto& known) { return texts_.isOpen(known.first) && !open.contains(known.first); });
  return touched;
}

void Workspace::check(const std::string& path, Graph& graph) {
  graph.said.clear();
  graph.current = false;
  graph.files.clear();
  for (const auto& [file, text] : graph.readTexts) graph.files.insert(file);
  if (isPreset(path)) {
    text::parseJson(texts_.of(path)->bytes(), std::make_shared<const std::string>(path), graph.said);
    return;
  }
  graph.said.append(graph.readSaid);
  if (!graph.read) return;
  graph.shaderFolders = runtime::shaderRootsOf(graph.read->files, dataFolder());
  glsl::SourceLoader& loader = sources(graph.shaderFolders);
  loader.forgetTouched();
  const auto flat = graph::expandGraph(*graph.read, registry_, settingsOf(options_, true), graph.said);
  if (flat && !graph.said.hasErrors()) {
    auto plan = std::make_shared<const graph::Plan>(graph::compile(flat));
    graph.current = graph::checkMemory(*plan, graph.said);
    checkShaders(graph, *plan);
    graph.plan = std::move(plan);
  } else {
    checkFiles(graph, *graph.read);
  }
  for (const std::string& each : loader.touched()) graph.files.insert(pathKey(each));
  graph.said.sortByPlace();
}

// Checks the shaders by what they declare.
void Workspace::checkShaders(Graph& graph, const graph::Plan& plan) {
  const graph::FlatGraph& flat = *plan.graph;
  std::set<std::string> failed;
  for (const graph::Step& step : plan.steps) {
    const graph::PassSpec& spec = flat.specs[step.pass];
    const auto type = std::ranges::find(registry_.passTypes, spec.type, &graph::PassType::name);
    if (type == registry_.passTypes.end() || type->shader == graph::ShaderShape::none) continue;
    const gl::ProgramRequest request = runtime::programRequestOf(flat, plan, step.pass, *type);
    std::vector<gl::StageSource> stages;
    bool whole = true;
    for (const gl::ProgramRequest::Stage& stage : request.stages) {
      if (!stage.text.empty()) continue;
      std::shared_ptr<const glsl::ShaderSource> source;
      if (!failed.contains(stage.file))
        source = sources(graph.shaderFolders).load(stage.file, graph.said, spec.shaderPlace);
      if (!source) failed.insert(stage.file);
      whole = whole && source;
      stages.push_back({stage.stage, std::move(source)});
    }
    if (whole) runtime::checkProgram(plan, step.pass, stages, request.defines, nullptr, graph.said);
  }
}

// Reports which shaders of a graph without a plan are missing.
void Workspace::checkFiles(Graph& graph, const graph::GraphDesc& desc) {
  std::set<std::string> seen;
  eachPass(desc, "", [&](const graph::PassDesc& pass, const std::string&) {
    const auto type = std::ranges::find(registry_.passTypes, pass.type, &graph::PassType::name);
    if (type == registry_.passTypes.end()) return;
    const bool stem = type->shader == graph::ShaderShape::draw && pass.vertexShader.empty();
    if (pass.shader.empty() || (stem && pass.shader.ends_with(".glsl")))
      return;  // W067 says what a draw needs
    const bool one = !stem && pass.vertexShader.empty();
    for (const std::string& each : one ? std::vector{pass.shader} : shadersOf(pass.shader, pass.vertexShader))
      if (seen.insert(each).second) sources(graph.shaderFolders).load(each, graph.said, pass.shaderPlace);
  });
}

std::vector<text::Diagnostic> Workspace::diagnosticsOf(const std::string& path) const {
  std::vector<text::Diagnostic> found;
  for (const auto& [root, graph] : graphs_)
    for (const text::Diagnostic& each : graph.said.items()) {
      if ((each.place.file && each.place.line > 0 ? pathKey(*each.place.file) : root) != path) continue;
      const bool known = std::ranges::any_of(found, [&](const text::Diagnostic& other) {
        return other.code == each.code && other.message == each.message &&
               other.place.line == each.place.line && other.place.column == each.place.column;
      });
      if (!known) found.push_back(each);
    }
  return found;
}

// ---- shaders ----

std::vector<std::string> Workspace::shaderFolders(const Text& text) const {
  if (text.isJson())
    for (const Graph* graph : roots_)
      if (graph->texts.contains(text.path())) return graph->shaderFolders;
  const std::vector<std::string> files{text.path()};
  std::vector<std::string> folders = runtime::shaderRootsOf(files, dataFolder());
  for (fs::path at = fs::path(text.path()).parent_path(); at.has_relative_path(); at = at.parent_path())
    if (at.filename() == "shaders") {
      folders.insert(folders.begin(), at.string());
      break;
    }
  return folders;
}

glsl::SourceLoader& Workspace::sources(const std::vector<std::string>& folders) const {
  std::unique_ptr<glsl::SourceLoader>& loader = sources_[folders];
  if (!loader) loader = std::make_unique<glsl::SourceLoader>(folders);
  return *loader;
}

std::vector<std::string> Workspace::shaderFiles(const std::string& shader,
                                                const std::vector<std::string>& folders) const {
  text::Diagnostics ignored;
  std::vector<std::string> files;
  if (!shader.empty())
    if (const auto source = sources(folders).load(shader, ignored))
      for (const auto& file : source->files) files.push_back(pathKey(*file));
  return files;
}

std::vector<Program> Workspace::passesOf(const Graph& graph) const {
  std::vector<Program> passes;
  eachPass(*graph.desc, "", [&](const graph::PassDesc& pass, const std::string& prefix) {
    if (!pass.include) passes.push_back({&graph, &pass, prefix + pass.name, keysOf(pass)});
  });
  return passes;
}

std::vector<std::string> Workspace::filesOf(const Program& program) const {
  std::vector<std::string> files;
  for (const std::string& shader : shadersOf(program.pass->shader, program.pass->vertexShader))
    for (std::string& file : shaderFiles(shader, program.graph->shaderFolders))
      files.push_back(std::move(file));
  return files;
}

std::vector<Program> Workspace::programs() const {
  std::vector<Program> found;
  for (const Graph* graph : roots_)
    for (Program& program : passesOf(*graph)) {
      program.files = filesOf(program);
      found.push_back(std::move(program));
    }
  return found;
}

std::optional<Location> Workspace::findInShaders(const std::vector<std::string>& files,
                                                 std::string_view name) const {
  for (const bool declared : {true, false})
    for (const std::string& path : files) {
      const auto text = texts_.of(path);
      if (!text) continue;
      const GlslName* const found = text->glsl().find(name);
      if (declared && found && found->role) return Location{path, found->range};
      if (!declared)
        for (const GlslWord& word : text->glsl().words)
          if (word.text == name && !word.member) return Location{path, word.range};
    }
  return std::nullopt;
}

}  // namespace weft::app::lsp
