#include "app/lsp/files/project.h"

#include <algorithm>
#include <filesystem>
#include <functional>

#include "app/session/session.h"
#include "engine/base/files/file_access.h"
#include "engine/graph/read/overlay.h"
#include "engine/runtime/frame/renderer.h"

namespace weft::app::lsp {

namespace fs = std::filesystem;

namespace {

using Kind = Mention::Kind;

constexpr int kMostSteps = 256;    // from one file to the next, in the look-up of one name
constexpr int kMostFiles = 20000;  // looked at in a folder

using Names = std::map<std::string, Range, std::less<>>;

const Names& namesOf(const FileIndex& index, Kind kind) {
  return kind == Kind::pass ? index.passes : kind == Kind::variable ? index.variables : index.resources;
}

// Paths, each once, in the order in which they were found; at most as many as a graph may include.
class FileList {
 public:
  explicit FileList(const std::string& first) : all_{first}, known_{first} {}
  void add(const std::string& path) {
    if (isFull() || !known_.insert(path).second) return;
    all_.push_back(path);
  }
  bool isFull() const { return all_.size() >= graph::kMostIncludes; }
  const std::vector<std::string>& all() const { return all_; }

 private:
  std::vector<std::string> all_;
  std::set<std::string> known_;
};

void listGraphs(const std::string& folder, std::set<std::string>& out) {
  std::error_code ec;
  int looked = 0;
  for (auto entry =
           fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied, ec);
       !ec && entry != fs::recursive_directory_iterator() && ++looked < kMostFiles; entry.increment(ec)) {
    const std::string name = entry->path().filename().string();
    if (entry->is_directory(ec) &&
        (name.starts_with('.') || name == "build" || name == "out" || name == "node_modules"))
      entry.disable_recursion_pending();
    else if (name.ends_with(".json") && entry->is_regular_file(ec) && base::mayRead(entry->path().string()))
      out.insert(pathKey(entry->path().string()));
  }
}

}  // namespace

bool Project::isInFolders(const std::string& path) const {
  return std::ranges::any_of(folders_,
                             [&](const std::string& folder) { return path.starts_with(folder + "/"); });
}

std::shared_ptr<const FileIndex> Project::index(const std::string& path) const {
  if (!path.ends_with(".json") || !base::mayRead(path)) return nullptr;
  std::shared_ptr<const Text> text = texts_.of(path);
  if (!text) return nullptr;
  std::shared_ptr<const FileIndex>& known = indices_[path];
  if (!known || known->text != text) known = indexOf(std::move(text));
  return known;
}

std::vector<std::string> Project::closure(const std::string& path) const {
  FileList found(path);
  for (std::size_t i = 0; i < found.all().size() && !found.isFull(); ++i) {
    const auto file = index(found.all()[i]);
    if (!file) continue;
    for (const std::string& below : file->extends) found.add(below);
    for (const auto& [prefix, included] : file->includes) found.add(included);
  }
  return found.all();
}

void Project::forget() {
  graphFiles_.reset();
  includers_.reset();
  shaderFolders_.clear();
}

const std::vector<std::string>& Project::graphFiles() const {
  if (graphFiles_) return *graphFiles_;
  std::set<std::string> found;
  for (const std::string& folder : folders_) listGraphs(folder, found);
  for (const auto& [path, opened] : texts_.opened())
    for (std::string& each : closure(path)) found.insert(std::move(each));
  graphFiles_.emplace();
  for (const std::string& path : found)
    if (const auto file = index(path); file && file->isGraph) graphFiles_->push_back(path);
  return *graphFiles_;
}

const std::vector<std::string>& Project::includersOf(const std::string& path) const {
  static const std::vector<std::string> none;
  if (!includers_) {
    includers_.emplace();
    for (const std::string& each : graphFiles()) {
      const auto file = index(each);
      if (!file) continue;
      std::set<std::string> below(file->extends.begin(), file->extends.end());
      for (const auto& [prefix, included] : file->includes) below.insert(included);
      for (const std::string& one : below) (*includers_)[one].push_back(each);
    }
  }
  const auto found = includers_->find(path);
  return found == includers_->end() ? none : found->second;
}

std::optional<std::string> Project::prefixIn(const std::string& root, const std::string& path) const {
  std::vector<std::pair<std::string, std::string>> work{{root, ""}};
  std::set<std::string> seen;
  for (std::size_t i = 0; i < work.size(); ++i) {
    const auto [at, prefix] = work[i];
    if (at == path) return prefix;
    if (!seen.insert(at).second) continue;
    const auto file = index(at);
    if (!file) continue;
    for (const std::string& below : file->extends) work.emplace_back(below, prefix);
    for (const auto& [name, included] : file->includes) work.emplace_back(included, prefix + name + ".");
  }
  return std::nullopt;
}

bool Project::isPreset(const std::string& path) const {
  std::set<std::string> seen;
  std::shared_ptr<const FileIndex> file = index(path);
  while (file && !file->extends.empty() && seen.insert(file->text->path()).second)
    file = index(file->extends.front());
  return file && file->isPreset;
}

// ---- names ----

std::vector<std::string> Project::listedBefore(const FileIndex& from) const {
  std::vector<std::string> found, work{from.text->path()};
  std::set<std::string> seen(work.begin(), work.end());
  for (std::size_t i = 0; i < work.size(); ++i)
    for (const std::string& includer : includersOf(work[i])) {
      const auto file = index(includer);
      if (!file || !file->doesExtend(work[i])) continue;
      for (const std::string& each : file->extends) {
        if (each == work[i]) break;
        if (std::ranges::find(found, each) == found.end()) found.push_back(each);
      }
      if (seen.insert(includer).second) work.push_back(includer);
    }
  return found;
}

std::vector<Project::File> Project::layersBelow(const FileIndex& from, int depth) const {
  std::vector<std::string> paths = from.extends;
  if (depth == 0)
    for (std::string& each : listedBefore(from))
      if (!from.doesExtend(each)) paths.push_back(std::move(each));
  std::vector<File> found;
  for (const std::string& path : paths)
    if (File file = index(path)) found.push_back(std::move(file));
  return found;
}

std::optional<Definition> Project::findInside(const FileIndex& from, const std::string& name,
                                              Kind kind) const {
  const std::string leaf = name.substr(name.rfind('.') + 1);
  std::vector<std::string> paths = closure(from.text->path());
  for (const std::string& each : listedBefore(from))
    for (std::string& path : closure(each))
      if (std::ranges::find(paths, path) == paths.end()) paths.push_back(std::move(path));
  std::vector<Definition> found;
  for (const std::string& path : paths) {
    const auto file = index(path);
    if (!file) continue;
    for (const std::string& wanted : {name, leaf})
      if (const auto at = namesOf(*file, kind).find(wanted); at != namesOf(*file, kind).end()) {
        found.push_back({kind, path, at->second, at->first});
        break;
      }
  }
  return found.size() == 1 ? std::optional(found[0]) : std::nullopt;
}

bool Project::isNew(Seen& seen, const FileIndex& from, const std::string& name, bool up, int depth) {
  return depth <= kMostSteps && seen.emplace(from.text->path(), name, up).second;
}

std::optional<Definition> Project::findResource(const FileIndex& from, const std::string& name, bool import,
                                                Seen& seen, int depth) const {
  if (!isNew(seen, from, name, import, depth)) return std::nullopt;
  const std::vector<File> below = layersBelow(from, depth);
  for (const File& file : below)  // what an overlay changes is declared below
    if (auto found = findResource(*file, name, import, seen, depth + 1)) return found;
  if (const auto own = from.resources.find(name); own != from.resources.end())
    if (below.empty() || own->first.find('.') == std::string::npos)
      return Definition{Kind::resource, from.text->path(), own->second, name};
  const std::size_t dot = name.find('.');
  if (dot != std::string::npos)
    if (const auto include = from.includes.find(name.substr(0, dot)); include != from.includes.end())
      if (const auto file = index(include->second))
        return findResource(*file, name.substr(dot + 1), import, seen, depth + 1);
  if (import)
    for (const std::string& includer : includersOf(from.text->path()))
      if (const auto file = index(includer); file && !file->doesExtend(from.text->path()))
        if (auto found = findResource(*file, name, true, seen, depth + 1)) return found;
  return below.empty() ? std::nullopt : findInside(from, name, Kind::resource);
}

std::optional<Definition> Project::findVariable(const FileIndex& from, const std::string& name, bool up,
                                                Seen& seen, int depth) const {
  if (!isNew(seen, from, name, up, depth)) return std::nullopt;
  for (const File& file : layersBelow(from, depth))
    if (auto found = findVariable(*file, name, false, seen, depth + 1)) return found;
  if (const auto own = from.variables.find(name); own != from.variables.end())
    return Definition{Kind::variable, from.text->path(), own->second, name};
  const std::size_t dot = name.find('.');
  if (dot != std::string::npos)
    if (const auto include = from.includes.find(name.substr(0, dot)); include != from.includes.end())
      if (const auto file = index(include->second))
        if (auto found = findVariable(*file, name.substr(dot + 1), false, seen, depth + 1)) return found;
  if (up)
    for (const std::string& includer : includersOf(from.text->path()))
      if (const auto file = index(includer); file && !file->doesExtend(from.text->path()))
        if (auto found = findVariable(*file, name, true, seen, depth + 1)) return found;
  return depth == 0 ? findInside(from, name, Kind::variable) : std::nullopt;
}

std::optional<Definition> Project::findPass(const FileIndex& from, const std::string& name, Seen& seen,
                                            int depth) const {
  if (!isNew(seen, from, name, false, depth)) return std::nullopt;
  if (const auto own = from.passes.find(name); own != from.passes.end())
    return Definition{Kind::pass, from.text->path(), own->second, name};
  for (const File& file : layersBelow(from, depth))
    if (auto found = findPass(*file, name, seen, depth + 1)) return found;
  const std::size_t dot = name.find('.');
  if (dot != std::string::npos)
    if (const auto include = from.includes.find(name.substr(0, dot)); include != from.includes.end())
      if (const auto file = index(include->second))
        return findPass(*file, name.substr(dot + 1), seen, depth + 1);
  if (depth > 0) return std::nullopt;
  if (auto found = findInside(from, name, Kind::pass)) return found;
  const auto own = from.untyped.find(name);
  return own == from.untyped.end()
             ? std::nullopt
             : std::optional(Definition{Kind::pass, from.text->path(), own->second, name});
}

std::optional<Definition> Project::resolve(const FileIndex& from, const Mention& mention) const {
  Seen seen;
  switch (mention.kind) {
    case Kind::resource:
    case Kind::import:
      if (auto found = findResource(from, mention.name, mention.kind == Kind::import, seen)) return found;
      seen.clear();
      return mention.mayBePass ? findPass(from, mention.name, seen) : std::nullopt;
    case Kind::variable:
      return findVariable(from, mention.name, true, seen);
    case Kind::pass:
      return findPass(from, mention.name, seen);
    case Kind::slot:
    case Kind::parameter:
    case Kind::define: {
      const auto graph = index(from.text->path());
      if (!graph || !mention.pass) return std::nullopt;
      // The node may belong to an older outline of the same text.
      const JsonValue* const name = nameOf(*mention.pass);
      const JsonValue* const stanza = name ? graph->stanza(name->text) : nullptr;
      return stanza ? findInShaders(programOf(graph, *stanza), mention.name) : std::nullopt;
    }
    case Kind::file: {
      const std::string path = pathKey((fs::path(from.text->path()).parent_path() / mention.name).string());
      return texts_.of(path) ? std::optional(Definition{Kind::file, path, {}, mention.name}) : std::nullopt;
    }
    case Kind::shader: {
      std::optional<std::string> path = locateShader(from.text->path(), mention.name);
      if (!path) path = locateShader(from.text->path(), mention.name + ".frag.glsl");
      return path ? std::optional(Definition{Kind::shader, *path, {}, mention.name}) : std::nullopt;
    }
  }
  return std::nullopt;
}

// ---- shaders ----

const std::vector<std::string>& Project::shaderFolders(const std::string& path) const {
  const auto [known, fresh] = shaderFolders_.try_emplace(path);
  std::vector<std::string>& folders = known->second;
  if (!fresh) return folders;
  const auto add = [&](std::string folder) {
    if (std::ranges::find(folders, folder) == folders.end()) folders.push_back(std::move(folder));
  };
  std::vector<std::string> around{path};
  if (!path.ends_with(".json")) {
    // For a shader: the nearest folder "shaders" around it, then the folders of all open graphs.
    around.clear();
    for (fs::path at = fs::path(path).parent_path(); at.has_relative_path(); at = at.parent_path())
      if (at.filename() == "shaders") {
        add(at.string());
        break;
      }
    for (const auto& [open, opened] : texts_.opened())
      if (open.ends_with(".json")) around.push_back(open);
  }
  // The files that include it, directly or not, say where the shaders lie; the outermost come first.
  for (std::size_t i = 0; i < around.size(); ++i)
    for (const std::string& includer : includersOf(around[i]))
      if (std::ranges::find(around, includer) == around.end()) around.push_back(includer);
  std::ranges::reverse(around);
  const auto addOf = [&](const std::string& graph) {
    for (const std::string& each : runtime::shaderRootsOf(closure(graph), dataFolder())) add(pathKey(each));
  };
  const auto isOpen = [&](const std::string& each) { return texts_.isOpen(each); };
  std::ranges::stable_partition(around, isOpen);
  for (const std::string& each : around) addOf(each);
  // Weft's own folder comes last, wherever it was found.
  const std::string own = pathKey(dataFolder() + "/shaders");
  std::ranges::stable_partition(folders, [&](const std::string& each) { return each != own; });
  return folders;
}

std::optional<std::string> Project::locateShader(const std::string& graph, const std::string& shader) const {
  if (shader.empty()) return std::nullopt;
  for (const std::string& folder : shaderFolders(graph)) {
    const std::string path = pathKey(folder + "/" + shader);
    if (base::mayRead(path) && texts_.of(path)) return path;
  }
  return std::nullopt;
}

std::optional<std::string> Project::locateInclude(const std::string& from, std::string_view path,
                                                  const std::vector<std::string>& folders) const {
  const std::string beside = pathKey((fs::path(from).parent_path() / path).string());
  if (base::mayRead(beside) && texts_.of(beside)) return beside;
  for (const std::string& folder : folders) {
    const std::string found = pathKey((fs::path(folder) / path).string());
    if (base::mayRead(found) && texts_.of(found)) return found;
  }
  return std::nullopt;
}

std::vector<std::string> Project::shaderClosure(const std::string& path,
                                                const std::vector<std::string>& folders) const {
  FileList found(path);
  for (std::size_t i = 0; i < found.all().size() && !found.isFull(); ++i)
    if (const auto text = texts_.of(found.all()[i]))
      for (const GlslInclude& include : text->glsl().includes())
        if (const auto located = locateInclude(found.all()[i], include.path, folders)) found.add(*located);
  return found.all();
}

Project::Program Project::programOf(const std::shared_ptr<const FileIndex>& graph,
                                    const JsonValue& stanza) const {
  Program program{graph, &stanza, {}};
  const std::vector<std::string> folders = shaderFolders(graph->text->path());
  for (const std::string& shader : shadersOf(*graph, stanza))
    if (const auto path = locateShader(graph->text->path(), shader))
      for (std::string& each : shaderClosure(*path, folders))
        if (std::ranges::find(program.files, each) == program.files.end())
          program.files.push_back(std::move(each));
  return program;
}

std::vector<Project::Program> Project::programsWith(const std::set<std::string>& files) const {
  std::vector<Program> found;
  for (const std::string& path : graphFiles()) {
    const auto graph = index(path);
    for (const JsonValue* stanza : graph->stanzas) {
      Program program = programOf(graph, *stanza);
      if (std::ranges::any_of(program.files, [&](const std::string& each) { return files.contains(each); }))
        found.push_back(std::move(program));
    }
  }
  return found;
}

std::optional<Definition> Project::findInShaders(const Program& program, std::string_view name) const {
  for (const bool declared : {true, false})
    for (const std::string& path : program.files) {
      const auto text = texts_.of(path);
      if (!text) continue;
      if (const GlslName* found = text->glsl().find(name);
          declared && found && found->kind != GlslName::Kind::define)
        return Definition{Kind::slot, path, found->range, std::string(name)};
      if (!declared)
        for (const GlslWord& word : text->glsl().words())
          if (word.text == name && !word.member)
            return Definition{Kind::slot, path, word.range, std::string(name)};
    }
  return std::nullopt;
}

}  // namespace weft::app::lsp
