#include "engine/glsl/source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <span>

#include "engine/base/chars.h"
#include "engine/base/files/file.h"
#include "engine/base/files/file_access.h"
#include "engine/base/files/file_overlay.h"
#include "engine/base/hash.h"
#include "engine/base/nearest.h"
#include "engine/glsl/bounds.h"
#include "engine/glsl/interface.h"

namespace weft::glsl {

namespace fs = std::filesystem;
using base::Code;
using base::Diagnostics;
using base::Place;

struct FileState {
  std::int64_t time = -1;  // -1: not there
  std::uint64_t bytes = ~0ull;
};

namespace {

constexpr std::size_t kMostText = std::size_t{16}
                                  << 20;  // of one stage; a guarded include may repeat its text

// When the file was written, and how long it is. Each unsaved text has a number of its own, which is no time of a file.
FileState stateOf(const std::string& path) {
  if (const auto unsaved = base::overlayOf(path))
    return {-1 - static_cast<std::int64_t>(unsaved->generation), unsaved->text->size()};
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return {};
  return {std::int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + status.st_mtim.tv_nsec,
          static_cast<std::uint64_t>(status.st_size)};
}

std::string folderOf(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

// Does what base::readFile() does, but does not read a file of more than `most` bytes: then `bytes` says how many it
// has, and nothing is reported.
std::optional<std::string> readWithin(const std::string& path, std::uint64_t most, std::uint64_t& bytes,
                                      Diagnostics& diagnostics, Code code, const Place& place) {
  return base::readFile(path, diagnostics, code, place, [&](std::uint64_t done, std::uint64_t total) {
    bytes = std::max(done, total);
    return bytes <= most;
  });
}

// A file that may be read, and is one of those that readFile() reads.
bool isReadable(const fs::path& path) {
  std::error_code ec;
  return base::mayRead(path.string()) && (base::overlayOf(path.string()) || fs::is_regular_file(path, ec));
}

// The first that may not be read, where nothing is said of whether it is there.
std::optional<std::string> outsideOf(std::span<const fs::path> candidates) {
  for (const fs::path& candidate : candidates)
    if (const std::string path = candidate.lexically_normal().string(); !base::mayRead(path)) return path;
  return std::nullopt;
}

bool isLineSpace(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isLineSpace(text.front())) text.remove_prefix(1);
  while (!text.empty() && isLineSpace(text.back())) text.remove_suffix(1);
  return text;
}

struct Directive {
  std::string_view name;     // "include", or "" when the line is none
  std::string_view rest;     // what follows, trimmed, without comments
  std::uint32_t column = 0;  // of the '#', from 1
};

// Walks the lines of a text. A directive inside a comment is none. Views live until next().
class LineScanner {
 public:
  explicit LineScanner(std::string_view text) : rest_(text) {}
  bool next();
  std::string_view line() const { return line_; }   // without its newline
  std::uint32_t number() const { return number_; }  // from 1
  const Directive& directive() const { return directive_; }
  // Of #if around the line. The guard of a whole file, #ifndef X with #define X next, does not count: what it leaves out is there
  // already.
  int depth() const { return depth_ - guard_; }

 private:
  void strip();
  std::string_view rest_, line_;
  std::string code_;  // the line, comments as spaces, columns kept
  std::uint32_t number_ = 0;
  int depth_ = 0;
  int guard_ = 0;       // 1 within it
  std::string guards_;  // the X of a first directive #ifndef X, until the next directive
  int directives_ = 0;
  bool inComment_ = false;
  Directive directive_;
};

bool LineScanner::next() {
  if (rest_.empty()) return false;
  if (directive_.name == "if" || directive_.name == "ifdef" || directive_.name == "ifndef") ++depth_;
  const std::size_t end = rest_.find('\n');
  line_ = rest_.substr(0, end);
  rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
  ++number_;
  strip();
  directive_ = {};
  const std::string_view code = trimmed(code_);
  if (!code.starts_with('#')) return true;
  std::string_view body = trimmed(code.substr(1));
  std::size_t length = 0;
  while (length < body.size() && base::isIdentChar(body[length])) ++length;
  directive_ = {body.substr(0, length), trimmed(body.substr(length)),
                static_cast<std::uint32_t>(code_.find('#') + 1)};
  const std::string_view name = directive_.name;
  if (name == "endif") depth_ = std::max(0, depth_ - 1);
  if (name == "define" && directives_ == 1 && !guards_.empty() && directive_.rest == guards_) guard_ = 1;
  if (depth_ == 0 || (depth_ == 1 && name.starts_with("el"))) guard_ = 0;
  guards_ = directives_++ == 0 && name == "ifndef" ? std::string(directive_.rest) : std::string();
  return true;
}

void LineScanner::strip() {
  code_.assign(line_);
  bool quoted = false;
  for (std::size_t i = 0; i < code_.size(); ++i) {
    const std::string_view two = std::string_view(code_).substr(i, 2);
    if (inComment_) {
      if (two == "*/") {
        code_[i++] = ' ';
        inComment_ = false;
      }
      code_[i] = ' ';
    } else if (code_[i] == '"') {
      quoted = !quoted;
    } else if (!quoted && two == "/*") {
      code_[i++] = ' ';
      code_[i] = ' ';
      inComment_ = true;
    } else if (!quoted && two == "//") {
      code_.resize(i);
    }
  }
}

}  // namespace

// One expansion: the text built so far, the files met, and the chain of includes that leads to the current
// one.
class IncludeExpander {
 public:
  IncludeExpander(const std::vector<std::string>& roots, ShaderNames& names, Diagnostics& diagnostics)
      : roots_(roots), names_(names), diagnostics_(diagnostics) {}

  // `folder` is where includes are searched first; "" for text without a file.
  void expandRoot(const std::string& path, const std::string& folder, std::string_view text) {
    const std::size_t number = addFile(path);
    source_->file = source_->files[number];
    expandFile(number, folder, text, 0);
  }

  std::shared_ptr<ShaderSource> finish() {
    source_->hash = base::hashBytes(source_->text);
    return source_;
  }

  const std::vector<std::string>& paths() const { return paths_; }
  // The state of each of these but the first before it was read: what changes meanwhile is read again next time.
  const std::vector<FileState>& states() const { return states_; }
  // Where includes that were not found would have been.
  const std::vector<std::string>& missing() const { return missing_; }

 private:
  std::size_t addFile(const std::string& path, FileState state = {}) {
    source_->files.push_back(std::make_shared<const std::string>(path));
    paths_.push_back(path);
    states_.push_back(state);
    unconditional_.push_back(false);
    return source_->files.size() - 1;
  }

  // `depth`: how many #if surround the whole file.
  void expandFile(std::size_t number, const std::string& folder, std::string_view text, int depth) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos)
      reportZero(number, text, zero);
    stack_.push_back(number);
    LineScanner scanner(text);
    while (scanner.next()) {
      const Directive directive = scanner.directive();
      const Place place{source_->files[number], scanner.number(), directive.column};
      if (directive.name == "include") {
        include(directive, place, folder, depth + scanner.depth());
        continue;
      }
      if (directive.name == "version")
        diagnostics_.error(Code::versionInShader, place, "a shader file has no #version").hint =
            "remove the line; the engine writes '#version 450 core'";
      if (directive.name == "version" || (directive.name == "pragma" && directive.rest == "once")) continue;
      emit(scanner.line(), number, scanner.number());
    }
    stack_.pop_back();
  }

  // One line of the text, which stands at `line` of a file.
  void emit(std::string_view code, std::size_t file, std::uint32_t line) {
    ++textLine_;
    std::vector<ShaderSource::Run>& runs = source_->runs;
    const bool follows = !runs.empty() && runs.back().file == file &&
                         line - runs.back().line == textLine_ - runs.back().textLine;
    if (!follows) runs.push_back({textLine_, static_cast<std::uint32_t>(file), line});
    source_->text.append(code).append("\n");
  }

  void include(const Directive& directive, const Place& place, const std::string& folder, int depth) {
    std::string_view rest = directive.rest;
    if (rest.size() < 3 || rest.front() != '"' || rest.find('"', 1) != rest.size() - 1) {
      base::Diagnostic& error =
          diagnostics_.error(Code::malformedInclude, place, "#include needs a file name in double quotes");
      error.expected = "#include \"common/view.glsl\"";
      error.found = fmt::format("#include {}", rest);
      return;
    }
    const std::string name(rest.substr(1, rest.size() - 2));
    const std::optional<std::string> path = resolve(name, folder);
    if (!path) {
      for (const fs::path& candidate : candidatesOf(name, folder))
        missing_.push_back(candidate.lexically_normal().string());
      if (const auto outside = outsideOf(candidatesOf(name, folder)))
        return base::reportOutside(*outside, diagnostics_, place);
      std::vector<std::string> folders = roots_;
      if (!folder.empty()) folders.push_back(folder);
      if (const auto other = resolveOther(name, folder)) {
        base::readFile(*other, diagnostics_, Code::missingShaderInclude, place);
        return;
      }
      base::Diagnostic& error = diagnostics_.error(Code::missingShaderInclude, place,
                                                   fmt::format("included file '{}' not found", name));
      error.expected = fmt::format("a file beside the including one or below {}", fmt::join(roots_, ", "));
      error.hint = hintForInclude(name, names_.below(folders));
      return;
    }
    const auto position = std::find(paths_.begin(), paths_.end(), *path);
    const bool known = position != paths_.end();
    std::size_t number = static_cast<std::size_t>(position - paths_.begin());
    if (known) {
      if (const auto at = std::find(stack_.begin(), stack_.end(), number); at != stack_.end())
        return reportCycle(at, place);
      if (unconditional_[number]) return;
    }
    const std::uint64_t room = kMostText - std::min(source_->text.size(), kMostText);
    const FileState state = stateOf(*path);
    std::uint64_t bytes = 0;
    const std::optional<std::string> text =
        readWithin(*path, room, bytes, diagnostics_, Code::missingShaderInclude, place);
    if (!text) missing_.push_back(*path);
    if (bytes > room) {
      base::Diagnostic& error = diagnostics_.error(
          Code::malformedInclude, place, fmt::format("includes expand to more than {} MiB", kMostText >> 20));
      error.found = fmt::format("'{}' of {} bytes", *path, bytes);
      error.hint = "include the file once, outside #if";
      return;
    }
    if (!text) return;
    if (!known) number = addFile(*path, state);
    unconditional_[number] = depth == 0;
    // A text inside an #if may not be taken, so it sets a guard instead of making later ones superfluous; the
    // first text outside every #if asks for that guard and makes all later ones superfluous.
    const std::size_t by = stack_.back();
    if (known || depth > 0) emit(fmt::format("#ifndef WEFT_INCLUDED_{}", number), by, place.line);
    if (depth > 0) emit(fmt::format("#define WEFT_INCLUDED_{}", number), by, place.line);
    expandFile(number, folderOf(*path), *text, depth);
    if (known || depth > 0) emit("#endif", by, place.line);
  }

  // Drivers take the text up to it and say nothing.
  void reportZero(std::size_t number, std::string_view text, std::size_t at) {
    const auto line = static_cast<std::uint32_t>(1 + std::ranges::count(text.substr(0, at), '\n'));
    const std::size_t before = text.rfind('\n', at);
    const std::size_t column = before == std::string_view::npos ? at + 1 : at - before;
    diagnostics_
        .error(Code::shaderDoesNotCompile, {source_->files[number], line, static_cast<std::uint32_t>(column)},
               "a zero byte stands in the shader")
        .hint = "remove it, or save the file as plain text (UTF-8, not UTF-16)";
  }

  void reportCycle(std::vector<std::size_t>::const_iterator first, const Place& place) {
    std::string chain;
    for (auto it = first; it != stack_.end(); ++it) chain += *source_->files[*it] + " -> ";
    chain += *source_->files[*first];
    diagnostics_
        .error(Code::shaderIncludeCycle, place,
               fmt::format("shaders include each other in a cycle: {}", chain))
        .hint = "move what both need into a third file";
  }

  std::vector<fs::path> candidatesOf(const std::string& name, const std::string& folder) const {
    std::vector<fs::path> candidates;
    if (!folder.empty()) candidates.push_back(fs::path(folder) / name);
    for (const std::string& root : roots_) candidates.push_back(fs::path(root) / name);
    return candidates;
  }

  std::optional<std::string> resolve(const std::string& name, const std::string& folder) const {
    for (const fs::path& candidate : candidatesOf(name, folder))
      if (const fs::path normal = candidate.lexically_normal(); isReadable(normal)) return normal.string();
    return std::nullopt;
  }

  // What is there and is no regular file: readFile() says what it is.
  std::optional<std::string> resolveOther(const std::string& name, const std::string& folder) const {
    std::error_code ec;
    for (const fs::path& candidate : candidatesOf(name, folder))
      if (const fs::path normal = candidate.lexically_normal(); fs::exists(normal, ec))
        return normal.string();
    return std::nullopt;
  }

  const std::vector<std::string>& roots_;
  ShaderNames& names_;
  Diagnostics& diagnostics_;
  std::shared_ptr<ShaderSource> source_ = std::make_shared<ShaderSource>();
  std::vector<std::string> paths_;  // by file number
  std::vector<FileState> states_;   // likewise
  std::vector<std::string> missing_;
  std::vector<bool> unconditional_;  // by file number: stands in the text outside every #if
  std::vector<std::size_t> stack_;   // file numbers, from the stage's own to the current one
  std::uint32_t textLine_ = 0;
};

void SourceLoader::touch(std::span<const std::string> read, std::span<const std::string> missing) {
  touched_.insert(read.begin(), read.end());
  touched_.insert(missing.begin(), missing.end());
}

std::shared_ptr<const ShaderSource> SourceLoader::answer(const std::string& key) {
  const auto found = cache_.find(key);
  if (found == cache_.end()) return nullptr;
  const auto same = [](const Stamp& s) {
    const FileState now = stateOf(s.path);
    return now.time == s.time && now.bytes == s.bytes;
  };
  if (!std::all_of(found->second.stamps.begin(), found->second.stamps.end(), same)) return nullptr;
  for (const Stamp& stamp : found->second.stamps) touched_.insert(stamp.path);
  return found->second.source;
}

namespace {

// Those that differ in stage and ending only, else those of nearly that name.
std::string hintForShader(const std::string& path, const std::vector<std::string>& known) {
  if (path.find_first_of("{;\n") != std::string::npos)
    return "a shader is a file: write the text into one below shaders/, and its path here";
  for (const std::string& each : known)
    if (path.ends_with("/" + each))
      return fmt::format("write '{}': paths begin in the folder of shaders", each);
  const std::string stem = path.substr(0, path.find('.', path.rfind('/') + 1)) + ".";
  std::string same;
  for (const std::string& each : known)
    if (each.starts_with(stem)) same += fmt::format("{}'{}'", same.empty() ? "" : " or ", each);
  return same.empty() ? base::nearestHint(path, known) : fmt::format("did you mean {}?", same);
}

}  // namespace

std::vector<fs::path> SourceLoader::candidatesOf(const std::string& path) const {
  std::vector<fs::path> candidates;
  if (!fs::path(path).is_absolute())
    for (const std::string& root : roots_) candidates.push_back(fs::path(root) / path);
  candidates.emplace_back(path);
  return candidates;
}

std::optional<std::string> SourceLoader::locate(const std::string& path) const {
  for (const fs::path& candidate : candidatesOf(path)) {
    std::error_code ec;
    const std::string normal = candidate.lexically_normal().string();
    if (base::mayRead(normal) && (base::overlayOf(normal) || fs::exists(normal, ec))) return normal;
  }
  return std::nullopt;
}

std::shared_ptr<const ShaderSource> SourceLoader::load(const std::string& path, Diagnostics& diagnostics,
                                                       const Place& place) {
  const std::optional<std::string> where = locate(path);
  if (!where) {
    if (fs::path(path).is_absolute() || roots_.empty())
      touched_.insert(path);
    else
      for (const std::string& root : roots_)
        touched_.insert((fs::path(root) / path).lexically_normal().string());
    std::vector<fs::path> candidates = candidatesOf(path);
    // The last candidate is the path seen from the current folder, where nobody looks for shaders on purpose.
    if (candidates.size() > 1) candidates.pop_back();
    if (const auto outside = outsideOf(candidates)) {
      base::reportOutside(*outside, diagnostics, place);
      return nullptr;
    }
    base::Diagnostic& error =
        diagnostics.error(Code::unreadableShader, place, fmt::format("shader '{}' not found", path));
    error.expected =
        roots_.empty() ? "an existing file" : fmt::format("a file below {}", fmt::join(roots_, ", "));
    error.hint = hintForShader(path, names_.below(roots_));
    return nullptr;
  }
  if (auto source = answer(*where)) return source;
  // The stamps are taken before reading: a file that changes meanwhile is read again next time.
  const FileState state = stateOf(*where);
  const Stamp own{*where, state.time, state.bytes};
  const std::uint64_t most = std::max<std::uint64_t>(kMostText, base::raised(kMostShaderBytes));
  std::uint64_t bytes = 0;
  const std::optional<std::string> text =
      readWithin(*where, most, bytes, diagnostics, Code::unreadableShader, place);
  touched_.insert(*where);
  if (bytes > most)
    reportShaderBytes(bytes, {std::make_shared<const std::string>(*where), 0, 0}, diagnostics);
  if (!text) return nullptr;
  ++expansions_;
  Diagnostics found;
  IncludeExpander expander(roots_, names_, found);
  expander.expandRoot(*where, folderOf(*where), *text);
  touch(expander.paths(), expander.missing());
  if (text->find_first_not_of(" \t\r\n") == std::string::npos)
    found
        .error(Code::shaderDoesNotCompile, {std::make_shared<const std::string>(*where), 1, 1},
               fmt::format("shader '{}' is empty", path))
        .hint = "the least a shader can hold is 'void main() {}'";
  diagnostics.append(found);
  if (found.hasErrors()) return nullptr;
  Entry entry{expander.finish(), {own}};
  for (std::size_t i = 1; i < expander.paths().size(); ++i)
    entry.stamps.push_back({expander.paths()[i], expander.states()[i].time, expander.states()[i].bytes});
  return (cache_[*where] = std::move(entry)).source;
}

std::shared_ptr<const ShaderSource> SourceLoader::loadText(std::string_view text, const std::string& name,
                                                           Diagnostics& diagnostics) {
  const std::string key = fmt::format("<text>{}:{:016x}", name, base::hashBytes(text));
  if (auto source = answer(key)) return source;
  ++expansions_;
  Diagnostics found;
  IncludeExpander expander(roots_, names_, found);
  expander.expandRoot(name, "", text);
  touch(std::span(expander.paths()).subspan(1), expander.missing());
  diagnostics.append(found);
  if (found.hasErrors()) return nullptr;
  Entry entry{expander.finish(), {}};
  for (std::size_t i = 1; i < expander.paths().size(); ++i)
    entry.stamps.push_back({expander.paths()[i], expander.states()[i].time, expander.states()[i].bytes});
  return (cache_[key] = std::move(entry)).source;
}

base::Place ShaderSource::placeOf(std::uint32_t textLine, std::uint32_t column) const {
  const auto after = std::upper_bound(runs.begin(), runs.end(), textLine,
                                      [](std::uint32_t line, const Run& run) { return line < run.textLine; });
  if (after == runs.begin()) return {file, 0, 0};
  const Run& run = *std::prev(after);
  return {files[run.file], run.line + (textLine - run.textLine), column};
}

const Interface& ShaderSource::interfaceWith(std::span<const Define> defines) const {
  constexpr std::size_t kMostKnown =
      256;  // of one text, in a long session that changes a define again and again
  std::string key;
  for (const Define& define : defines) key += fmt::format("{}={}|", define.name, define.value);
  if (known_.size() >= kMostKnown && !known_.contains(key)) known_.clear();
  std::shared_ptr<const Interface>& known = known_[key];
  if (!known) known = std::make_shared<const Interface>(readInterface(text, defines));
  return *known;
}

const Interface& ShaderSource::ofAllBranches() const {
  if (!allBranches_) allBranches_ = std::make_shared<const Interface>(readAllBranches(text));
  return *allBranches_;
}

std::string assembleSource(const ShaderSource& source, std::span<const Define> defines) {
  std::string text = "#version 450 core\n";
  for (const Define& define : defines) text += fmt::format("#define {} {}\n", define.name, define.value);
  text += fmt::format("#line {}\n", kTextLine);
  return text + source.text;
}

}  // namespace weft::glsl
