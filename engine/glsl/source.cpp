#include "engine/glsl/source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "engine/glsl/interface.h"
#include "engine/text/chars.h"
#include "engine/text/files/file.h"
#include "engine/text/hash.h"
#include "engine/text/limits.h"
#include "engine/text/nearest.h"
#include "glsl_sentences.h"

namespace weft::glsl {

namespace fs = std::filesystem;
using text::Code;
using text::Diagnostics;
using text::FileStamp;
using text::Place;

namespace {

// Of one stage; a guarded include may repeat its text.
constexpr std::size_t kMaxText = std::size_t{16} << 20;

std::string folderOf(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

// The first that may be read and is there, a folder only where nothing else is; `before` gets those that were looked for in vain.
std::optional<std::string> firstThere(std::span<const std::string> candidates,
                                      std::set<std::string>* before) {
  std::optional<std::string> folder;
  for (const std::string& path : candidates) {
    if (text::mayRead(path) && (text::overlayOf(path) || text::isThere(path))) {
      if (std::error_code ignored; !fs::is_directory(path, ignored)) return path;
      if (!folder) folder = path;
    }
    if (before) before->insert(path);
  }
  return folder;
}

// The first that may not be read, where nothing is said of whether it is there.
std::optional<std::string> outsideOf(std::span<const std::string> candidates) {
  const auto outside =
      std::ranges::find_if(candidates, [](const std::string& path) { return !text::mayRead(path); });
  return outside == candidates.end() ? std::nullopt : std::optional(*outside);
}

// `name` below each of the folders, in their order.
std::vector<std::string> below(std::span<const std::string> folders, const std::string& name) {
  std::vector<std::string> paths;
  for (const std::string& folder : folders)
    paths.push_back((fs::path(folder) / name).lexically_normal().string());
  return paths;
}

// For a file that is not there: one of the same name in another folder or of another stage, else one of nearly the same stem.
std::string hintForFile(const std::string& name, std::span<const std::string> roots) {
  const std::vector<std::string> names = shadersBelow(roots);
  const std::string stem = name.substr(0, name.find('.', name.rfind('/') + 1)) + ".";
  for (const std::string& each : names)
    if (each.ends_with("/" + name) || name.ends_with("/" + each) || each.starts_with(stem))
      return "did you mean '" + each + "'?";
  const std::string near = text::nearestName(name, names);
  const bool isNear = !near.empty() && text::editDistance(name, near, name.size()) <= stem.size() / 3;
  return isNear ? "did you mean '" + near + "'?" : "";
}

// The file name of `#include "name"`, from what follows the word, or nullopt.
std::optional<std::string> quotedFile(std::string_view rest) {
  const std::size_t begin = rest.find_first_not_of(" \t");
  if (begin == std::string_view::npos || rest[begin] != '"') return std::nullopt;
  const std::size_t end = rest.find('"', begin + 1);
  if (end == std::string_view::npos || end == begin + 1) return std::nullopt;
  const std::string_view behind =
      rest.substr(std::min(rest.size(), rest.find_first_not_of(" \t\r", end + 1)));
  if (!behind.empty() && !behind.starts_with("//") && !behind.starts_with("/*")) return std::nullopt;
  return std::string(rest.substr(begin + 1, end - begin - 1));
}

}  // namespace

std::vector<std::string> shadersBelow(std::span<const std::string> folders) {
  constexpr int kMaxOfFolder = 10'000;
  std::set<std::string> names;
  for (const std::string& folder : folders) {
    if (!text::mayRead(folder)) continue;
    std::error_code ec;
    fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied, ec);
    for (int seen = 0; !ec && it != fs::recursive_directory_iterator() && seen < kMaxOfFolder;
         it.increment(ec), ++seen)
      if (it->path().extension() == ".glsl")
        names.insert(it->path().lexically_relative(folder).generic_string());
  }
  return {names.begin(), names.end()};
}

// One expansion: the text built so far, the files met, and the chain of includes that leads to the current one.
class IncludeExpander {
 public:
  IncludeExpander(SourceLoader& loader, Diagnostics& diagnostics)
      : loader_(loader), diagnostics_(diagnostics) {}

  // `folder` is where includes are searched first; "" for text without a file.
  std::shared_ptr<ShaderSource> run(const FileStamp& own, const std::string& folder, std::string_view text) {
    addFile(own);
    source_->file = source_->files[0];
    expandFile(0, folder, text, 0);
    source_->hash = text::hashBytes(source_->text);
    return source_;
  }

  // The state of each file before it was read: what changes meanwhile is read again next time.
  const std::vector<FileStamp>& files() const { return files_; }
  // Where includes were looked for in vain: those that were not found, and those that a later place has.
  const std::set<std::string>& missing() const { return missing_; }

 private:
  std::size_t addFile(const FileStamp& file) {
    source_->files.push_back(file.path);
    files_.push_back(file);
    unconditional_.push_back(false);
    return files_.size() - 1;
  }

  // `depth`: how many #if surround the whole file.
  void expandFile(std::size_t number, const std::string& folder, std::string_view text, int depth) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    bool hasZero = false;  // drivers take the text up to it and say nothing
    stack_.push_back(number);
    const std::vector<Token> tokens = splitTokens(text);
    int level = 0;  // of #if around the line
    // The guard of a whole file, #ifndef X with #define X next, does not count: what it leaves out is there already.
    int guards = 0, directives = 0;
    std::string_view guard;  // the X of a first directive #ifndef X, until the next directive
    std::size_t at = 0;
    for (std::uint32_t line = 1; !text.empty(); ++line) {
      const std::string_view code = text::takeLine(text);
      if (const std::size_t zero = code.find('\0'); zero != code.npos && !std::exchange(hasZero, true))
        diagnostics_.error(say::zeroByte,
                           {source_->files[number], line, static_cast<std::uint32_t>(zero + 1)});
      while (at < tokens.size() && tokens[at].line < line) ++at;
      const auto wordAt = [&](std::size_t i) {
        return i < tokens.size() && tokens[i].line == line ? tokens[i].text : std::string_view();
      };
      if (wordAt(at) != "#" || !tokens[at].first) {
        emit(code, number, line);
        continue;
      }
      const std::string_view name = wordAt(at + 1), word = wordAt(at + 2);
      const Place place{source_->files[number], line, tokens[at].column};
      if (name == "endif") level = std::max(0, level - 1);
      if (name == "define" && directives == 1 && !guard.empty() && word == guard) guards = 1;
      if (level == 0 || (level == 1 && name.starts_with("el"))) guards = 0;
      guard = directives++ == 0 && name == "ifndef" ? word : std::string_view();
      if (name == "include")
        include(code.substr(tokens[at + 1].column - 1 + name.size()), place, folder, depth + level - guards);
      else if (name == "version")
        diagnostics_.error(say::versionInShader, place);
      else if (name != "pragma" || word != "once")
        emit(code, number, line);
      if (name == "if" || name == "ifdef" || name == "ifndef") ++level;
    }
    stack_.pop_back();
  }

  // One line of the text, which is `line` of a file.
  void emit(std::string_view code, std::size_t file, std::uint32_t line) {
    ++textLine_;
    std::vector<ShaderSource::Run>& runs = source_->runs;
    const bool follows = !runs.empty() && runs.back().file == file &&
                         line - runs.back().line == textLine_ - runs.back().textLine;
    if (!follows) runs.push_back({textLine_, static_cast<std::uint32_t>(file), line});
    source_->text.append(code).append("\n");
  }

  // `rest`: what follows the word include.
  void include(std::string_view rest, const Place& place, const std::string& folder, int depth) {
    const std::optional<std::string> name = quotedFile(rest);
    if (!name) {
      diagnostics_.error(say::malformedInclude, place, rest);
      return;
    }
    const std::optional<std::string> path = find(*name, place, folder);
    if (!path) return;
    const auto position = std::ranges::find(files_, *path, &FileStamp::path);
    const bool known = position != files_.end();
    auto number = static_cast<std::size_t>(position - files_.begin());
    if (known) {
      if (const auto at = std::ranges::find(stack_, number); at != stack_.end())
        return reportCycle(at, place);
      if (unconditional_[number]) return;
    }
    const std::uint64_t room = kMaxText - std::min(source_->text.size(), kMaxText);
    const FileStamp stamp = text::stampOf(*path);
    std::uint64_t bytes = 0;
    const std::optional<std::string> text =
        text::readWithin(*path, room, bytes, diagnostics_, Code::missingShaderInclude, place);
    if (!text) missing_.insert(*path);
    if (bytes > room) {
      diagnostics_.error(say::includesTooLarge, place, kMaxText >> 20, *path, bytes);
      return;
    }
    if (!text) return;
    if (!known) number = addFile(stamp);
    unconditional_[number] = depth == 0;
    // A text inside an #if may not be taken, so it sets a guard instead of making later ones superfluous; the
    // first text outside every #if asks for that guard and makes all later ones superfluous.
    const std::size_t by = stack_.back();
    if (known || depth > 0) emit(fmt::format("#ifndef WEFT_INCLUDED_{}", number), by, place.line);
    if (depth > 0) emit(fmt::format("#define WEFT_INCLUDED_{}", number), by, place.line);
    expandFile(number, folderOf(*path), *text, depth);
    if (known || depth > 0) emit("#endif", by, place.line);
  }

  // Where the included file is: beside who includes it, or below a root. Nothing after an error.
  std::optional<std::string> find(const std::string& name, const Place& place, const std::string& folder) {
    std::vector<std::string> folders = loader_.roots_;
    if (!folder.empty()) folders.insert(folders.begin(), folder);
    std::vector<std::string> candidates = below(folders, name);
    // A file that stands in for one of another root finds what lies beside that one.
    for (const std::string& root : loader_.roots_)
      if (const fs::path inRoot = fs::path(folder).lexically_relative(root);
          !inRoot.empty() && *inRoot.begin() != "..")
        std::ranges::move(below(loader_.roots_, (inRoot / name).string()), std::back_inserter(candidates));
    if (const auto there = firstThere(candidates, &missing_)) return there;
    if (const auto outside = outsideOf(candidates)) {
      text::reportOutside(*outside, diagnostics_, place);
      return std::nullopt;
    }
    diagnostics_.error(say::includeNotFound, place, name, fmt::join(loader_.roots_, ", "),
                       hintForFile(name, loader_.roots_));
    return std::nullopt;
  }

  void reportCycle(std::vector<std::size_t>::const_iterator first, const Place& place) {
    std::string chain;
    for (auto it = first; it != stack_.end(); ++it) chain += files_[*it].path + " -> ";
    chain += files_[*first].path;
    diagnostics_.error(say::includeCycle, place, chain);
  }

  SourceLoader& loader_;
  Diagnostics& diagnostics_;
  std::shared_ptr<ShaderSource> source_ = std::make_shared<ShaderSource>();
  std::vector<FileStamp> files_;  // by file number
  std::set<std::string> missing_;
  std::vector<bool> unconditional_;  // by file number: is in the text outside every #if
  std::vector<std::size_t> stack_;   // file numbers, from the stage's own to the current one
  std::uint32_t textLine_ = 0;
};

std::shared_ptr<const ShaderSource> SourceLoader::answer(const std::string& key) {
  const text::FileCache::Entry* kept = files_.find(key, typeid(ShaderSource));
  return kept ? std::static_pointer_cast<const ShaderSource>(kept->made) : nullptr;
}

// `own`: the file, whose path is the key; else the name of a text in memory.
std::shared_ptr<const ShaderSource> SourceLoader::expand(const std::string& key, const FileStamp& own,
                                                         std::string_view text, Diagnostics& diagnostics) {
  const bool isFile = own.path == key;
  Diagnostics found;
  IncludeExpander expander(*this, found);
  auto source = expander.run(own, isFile ? folderOf(own.path) : "", text);
  const auto taken = std::span(expander.files()).subspan(isFile ? 0 : 1);
  std::vector<FileStamp> stamps(taken.begin(), taken.end());
  for (const std::string& path : expander.missing()) stamps.push_back({path});
  for (const FileStamp& file : stamps) files_.touch(file.path);
  diagnostics.append(found);
  if (found.hasErrors()) return nullptr;
  files_.keep(key, typeid(ShaderSource), {std::move(stamps), source});
  return source;
}

std::optional<std::string> SourceLoader::locate(const std::string& path,
                                                std::set<std::string>* before) const {
  std::vector<std::string> candidates;
  if (!fs::path(path).is_absolute()) candidates = below(roots_, path);
  candidates.push_back(fs::path(path).lexically_normal().string());
  return firstThere(candidates, before);
}

// Nobody looks for shaders in the current folder on purpose, so it is not mentioned where there are roots.
void SourceLoader::reportMissing(const std::string& path, Diagnostics& diagnostics, const Place& place) {
  const bool asItIs = fs::path(path).is_absolute() || roots_.empty();
  const std::vector<std::string> candidates = asItIs ? std::vector<std::string>{path} : below(roots_, path);
  for (const std::string& each : candidates) files_.touch(each);
  if (const auto outside = outsideOf(candidates)) return text::reportOutside(*outside, diagnostics, place);
  diagnostics.error(
      say::shaderNotFound, place, path,
      roots_.empty() ? "an existing file" : fmt::format("a file below {}", fmt::join(roots_, ", ")),
      hintForFile(path, roots_));
}

std::shared_ptr<const ShaderSource> SourceLoader::load(const std::string& path, Diagnostics& diagnostics,
                                                       const Place& place) {
  std::set<std::string> before;
  const std::optional<std::string> where = locate(path, &before);
  if (!where) {
    reportMissing(path, diagnostics, place);
    return nullptr;
  }
  for (const std::string& each : before) files_.touch(each);
  if (auto source = answer(*where)) return source;
  const FileStamp own = text::stampOf(*where);
  const std::uint64_t most = std::max<std::uint64_t>(kMaxText, text::raised(kMaxShaderBytes));
  std::uint64_t bytes = 0;
  const std::optional<std::string> text =
      text::readWithin(*where, most, bytes, diagnostics, Code::unreadableShader, place);
  files_.touch(*where);
  if (bytes > most) {
    ShaderSource large;
    large.file = *where;
    checkShaderSize({.bytes = bytes}, large, diagnostics);
  }
  if (!text) return nullptr;
  if (text->find_first_not_of(" \t\r\n") == std::string::npos) {
    diagnostics.error(say::emptyShader, {*where, 1, 1}, path);
    return nullptr;
  }
  return expand(*where, own, *text, diagnostics);
}

std::shared_ptr<const ShaderSource> SourceLoader::loadText(std::string_view text, const std::string& name,
                                                           Diagnostics& diagnostics) {
  const std::string key = fmt::format("<text>{}:{:016x}", name, text::hashBytes(text));
  if (auto source = answer(key)) return source;
  return expand(key, {name}, text, diagnostics);
}

text::Place ShaderSource::placeOfMain() const {
  const std::size_t at = text.find("void main");
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(at == std::string::npos ? 0 : at);
  return placeOf(static_cast<std::uint32_t>(std::count(text.begin(), end, '\n')) + 1);
}

text::Place ShaderSource::placeOf(std::uint32_t textLine, std::uint32_t column) const {
  const auto after = std::ranges::upper_bound(runs, textLine, {}, &Run::textLine);
  if (after == runs.begin()) return {file, 0, 0};
  const Run& run = *std::prev(after);
  return {files[run.file], run.line + (textLine - run.textLine), column};
}

const Interface& ShaderSource::interfaceWith(std::span<const Define> defines) const {
  constexpr std::size_t kMaxKnown = 256;  // in a long session that changes a define again and again
  std::string key;
  for (const Define& define : defines) key += fmt::format("{}={}|", define.name, define.value);
  if (known_.size() >= kMaxKnown && !known_.contains(key)) known_.clear();
  std::shared_ptr<const Interface>& known = known_[key];
  if (!known) known = std::make_shared<const Interface>(readInterface(text, defines));
  return *known;
}

const Interface& ShaderSource::ofAllBranches() const {
  if (!allBranches_) allBranches_ = std::make_shared<const Interface>(readInterface(text, {}, Branches::all));
  return *allBranches_;
}

const Conditions& ShaderSource::conditions() const {
  if (!conditions_) conditions_ = std::make_shared<const Conditions>(conditionsOf(text));
  return *conditions_;
}

std::string assembleSource(const ShaderSource& source, std::span<const Define> defines) {
  std::string text = "#version 450 core\n";
  for (const Define& define : defines) text += fmt::format("#define {} {}\n", define.name, define.value);
  text += fmt::format("#line {}\n", kTextLine);
  return text + source.text;
}

}  // namespace weft::glsl
