#include "engine/glsl/roles.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "engine/glsl/source.h"
#include "engine/glsl/tokens.h"

namespace weft::glsl {

namespace {

using Statement = std::vector<std::string_view>;
using Macros = std::map<std::string_view, Statement>;  // with the words that they stand for

bool isName(const Token& token) {
  return token.kind == TokenKind::word;
}
bool isNameText(std::string_view text) {
  return !text.empty() && (std::isalpha(static_cast<unsigned char>(text[0])) != 0 || text[0] == '_');
}
bool isQualifier(std::string_view word) {
  constexpr std::array<std::string_view, 22> kRoleQualifiers{
      "uniform", "buffer",        "in",        "out",         "const",    "flat",
      "smooth",  "noperspective", "centroid",  "sample",      "highp",    "mediump",
      "lowp",    "readonly",      "writeonly", "coherent",    "volatile", "restrict",
      "precise", "invariant",     "row_major", "column_major"};
  return std::ranges::find(kRoleQualifiers, word) != kRoleQualifiers.end();
}
bool has(const Statement& statement, std::string_view word) {
  return std::ranges::find(statement, word) != statement.end();
}

// The statements of the file, of blocks and of functions, token by token.
class RoleScan {
 public:
  RoleScan(ShaderRoles& out, const Macros& macros) : out_(out), macros_(macros) {}

  void feed(const Token& token) {
    if (function_) return feedBody(token);
    if (initializer_ > 0) {
      initializer_ += token.is("{") ? 1 : token.is("}") ? -1 : 0;
      if (isName(token)) globals_.insert(token.text);
    } else if (token.is("{")) {
      open();
    } else if (token.is("}")) {
      if (!block_) out_.unsure = true;
      block_ = false;
      closed_ = true;
      statement_.clear();
    } else if (token.is(";")) {
      endStatement();
      statement_.clear();
    } else {
      statement_.push_back(token.text);
    }
  }

  void finish() {
    out_.unsure = out_.unsure || function_ || block_ || initializer_ > 0;
    std::vector<std::string_view> open{"main"};
    open.insert(open.end(), globals_.begin(), globals_.end());
    for (const std::string_view word : globals_) out_.reachable.emplace(word);
    std::set<std::string_view> seen;
    while (!open.empty()) {
      const std::string_view name = open.back();
      open.pop_back();
      const auto found = bodies_.find(name);
      if (found == bodies_.end() || !seen.insert(name).second) continue;
      for (const std::string_view word : found->second) {
        out_.reachable.emplace(word);
        open.push_back(word);
      }
    }
  }

 private:
  void add(std::string_view name, Role role) {
    out_.roles[std::string(name)] |= static_cast<std::uint16_t>(role);
  }

  // A macro may declare anything that it is given.
  bool isMadeByMacro() const {
    if (statement_.empty()) return false;
    const bool interface = has(statement_, "uniform") || has(statement_, "buffer") || has(statement_, "in") ||
                           has(statement_, "out") || block_;
    if (interface)
      return std::ranges::any_of(statement_, [&](std::string_view word) { return macros_.contains(word); });
    return macros_.contains(statement_[0]);
  }
  void takeMacro() {
    for (std::size_t i = 0; i < statement_.size(); ++i) {
      const auto macro = macros_.find(statement_[i]);
      if (macro == macros_.end()) continue;
      for (const std::string_view word : macro->second) add(word, Role::unsure);
      int nested = 0;
      for (std::size_t at = i + 1; at < statement_.size(); ++at) {
        nested += statement_[at] == "(" ? 1 : statement_[at] == ")" ? -1 : 0;
        if (nested == 0) break;
        if (isNameText(statement_[at])) add(statement_[at], Role::unsure);
      }
    }
  }

  void open() {
    if (isMadeByMacro()) takeMacro();
    if (!statement_.empty() && statement_.back() == ")") return openFunction();
    if (!statement_.empty() && statement_.back() == "=") {
      initializer_ = 1;
      return;
    }
    if (block_ || statement_.empty()) out_.unsure = true;
    block_ = true;
    const std::string_view name = statement_.empty() ? "" : statement_.back();
    if (has(statement_, "struct")) {
      blockRole_ = Role::structure;
      if (isNameText(name)) add(name, Role::structure);
    } else if (has(statement_, "uniform") || has(statement_, "buffer")) {
      const bool uniform = has(statement_, "uniform");
      blockRole_ = uniform && name == "Parameters" ? Role::parameter : Role::member;
      uniformBlock_ = uniform && blockRole_ == Role::member ? name : "";
      if (isNameText(name)) add(name, uniform ? Role::uniform_block : Role::storage_block);
    } else {
      blockRole_ = has(statement_, "out") ? Role::output : Role::input;
    }
    statement_.clear();
  }

  void openFunction() {
    std::size_t at = statement_.size();
    int nested = 0;
    while (at > 0) {
      --at;
      if (statement_[at] == ")") ++nested;
      if (statement_[at] == "(" && --nested == 0) break;
    }
    if (at > 0 && isNameText(statement_[at - 1])) {
      name_ = statement_[at - 1];
      add(name_, Role::function);
      for (std::size_t i = at + 2; i + 1 < statement_.size(); ++i)
        if (isNameText(statement_[i]) && isNameText(statement_[i - 1]) && !isQualifier(statement_[i]) &&
            (statement_[i + 1] == "," || statement_[i + 1] == ")" || statement_[i + 1] == "["))
          add(statement_[i], Role::variable);
    }
    function_ = true;
    depth_ = 1;
    last_ = {};
    statement_.clear();
    closed_ = false;
  }

  void feedBody(const Token& token) {
    if (token.is("{")) ++depth_;
    if (token.is("}") && --depth_ == 0) {
      function_ = false;
      return;
    }
    if (isName(token)) {
      bodies_[name_].insert(token.text);
      before_ = std::exchange(last_, token.text);
    } else {
      // "float gain =": a type and a name.
      const bool ends = token.is("=") || token.is(";") || token.is(",") || token.is("[");
      if (ends && !last_.empty() && !before_.empty() && before_ != "return" && before_ != "else")
        add(last_, Role::variable);
      last_ = before_ = {};
    }
  }

  void endStatement() {
    if (std::exchange(closed_, false)) {
      for (std::size_t i = 0; i < statement_.size(); ++i)
        if (isNameText(statement_[i]) && (i == 0 || statement_[i - 1] == ",")) {
          add(statement_[i], blockRole_ == Role::structure ? Role::variable : Role::instance);
          if (blockRole_ == Role::parameter) out_.parametersInstance = statement_[i];
        }
      return;
    }
    if (isMadeByMacro()) takeMacro();
    if (statement_.empty() || statement_[0] == "precision") return;
    if (block_) {
      if (blockRole_ != Role::structure) addDeclarators(blockRole_);
      return;
    }
    const Role role = globalRole();
    if (role == Role::variable || role == Role::constant)
      for (const std::string_view word : statement_)
        if (isNameText(word)) globals_.insert(word);
    addDeclarators(role);
  }

  // Of the words outside brackets.
  Role globalRole() const {
    int nested = 0;
    for (std::size_t i = 0; i < statement_.size(); ++i) {
      const std::string_view word = statement_[i];
      if (word == "(") {
        if (nested == 0 && i > 1 && statement_[i - 1] != "layout" && !has(statement_, "="))
          return Role::function;
        ++nested;
      }
      if (word == ")") --nested;
      if (nested > 0) continue;
      if (word == "uniform" || word == "buffer") return Role::opaque;
      if (word == "in") return Role::input;
      if (word == "out") return Role::output;
      if (word == "const") return Role::constant;
      if (word == "=") break;
    }
    return Role::variable;
  }

  void addDeclarators(Role role) {
    int nested = 0;
    std::string_view type;
    std::string behindType;  // "[4]" in "vec4[4] weights"
    bool value = false;      // behind a "="
    for (std::size_t i = 0; i < statement_.size(); ++i) {
      const std::string_view word = statement_[i];
      if (role == Role::function) {
        if (word == "(" && i > 0 && isNameText(statement_[i - 1])) add(statement_[i - 1], Role::function);
        if (word == "(") return;
        continue;
      }
      if (word == "(" || word == "[") ++nested;
      if (word == ")" || word == "]") --nested;
      if (nested > 0) continue;
      if (word == "=") value = true;
      if (word == ",") value = false;
      if (value || !isNameText(word) || isQualifier(word) || word == "layout") continue;
      if (type.empty() && i + 1 < statement_.size() && statement_[i + 1] != "," && statement_[i + 1] != "=") {
        type = word;
        behindType = dimensionsAt(i + 1);
        continue;
      }
      const bool last = i + 1 == statement_.size();
      if (!last && statement_[i + 1] != "," && statement_[i + 1] != "[" && statement_[i + 1] != "=") continue;
      add(word, role);
      if (role == Role::member && !uniformBlock_.empty())
        out_.blockOf.try_emplace(std::string(word), uniformBlock_);
      if (role == Role::parameter)
        out_.parameters.push_back({std::string(type) + dimensionsAt(i + 1) + behindType, std::string(word)});
      if (role == Role::opaque && type.find("image") != std::string_view::npos) addFormats(word);
    }
  }

  // "[4]" or "[2][3]", or "" where none stand.
  std::string dimensionsAt(std::size_t i) const {
    std::string text;
    for (int nested = 0; i < statement_.size() && (nested > 0 || statement_[i] == "["); ++i) {
      nested += statement_[i] == "[" ? 1 : statement_[i] == "]" ? -1 : 0;
      text += statement_[i];
    }
    return text;
  }

  void addFormats(std::string_view name) {
    const auto layout = std::ranges::find(statement_, "layout");
    std::vector<std::string>& formats = out_.imageFormats[std::string(name)];
    for (auto at = layout; at != statement_.end() && *at != ")"; ++at)
      if (at != layout && isNameText(*at)) formats.emplace_back(*at);
  }

  ShaderRoles& out_;
  const Macros& macros_;
  Statement statement_;
  std::map<std::string_view, std::set<std::string_view>> bodies_;  // words of functions, by name
  std::set<std::string_view> globals_;                             // words of the values of global variables
  std::string_view name_, last_, before_;  // of the open function; its last words, when nothing stood behind
  Role blockRole_ = Role::member;
  std::string uniformBlock_;  // that is open, under another name than Parameters
  bool function_ = false, block_ = false, closed_ = false;
  int depth_ = 0, initializer_ = 0;
};

}  // namespace

bool ShaderRoles::is(std::string_view name, Role role) const {
  const auto found = roles.find(name);
  return found != roles.end() && (found->second & static_cast<std::uint16_t>(role)) != 0;
}

std::vector<std::string> ShaderRoles::namesOf(Role role) const {
  std::vector<std::string> names;
  for (const auto& [name, all] : roles)
    if ((all & static_cast<std::uint16_t>(role)) != 0) names.push_back(name);
  return names;
}

ShaderRoles rolesIn(std::string_view text) {
  const std::vector<Token> tokens = splitTokens(text);
  ShaderRoles out;
  Macros macros;
  std::vector<const Token*> code;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (!tokens[i].first || !tokens[i].is("#")) {
      code.push_back(&tokens[i]);
      continue;
    }
    const std::size_t begin = ++i;
    while (i < tokens.size() && !tokens[i].first) ++i;
    const std::span directive = std::span(tokens).subspan(begin, i-- - begin);
    if (directive.size() < 2 || !directive[0].is("define")) continue;
    Statement& body = macros[directive[1].text];
    for (const Token& token : directive.subspan(2))
      if (isName(token)) body.push_back(token.text);
    // One that declares something makes a name of any word that it has.
    if (std::ranges::any_of(directive, [](const Token& t) {
          return t.is("uniform") || t.is("buffer") || t.is("in") || t.is("out");
        }))
      for (const Token& token : directive.subspan(2))
        if (isName(token)) out.roles[std::string(token.text)] |= static_cast<std::uint16_t>(Role::unsure);
  }
  RoleScan scan(out, macros);
  for (const Token* token : code) scan.feed(*token);
  scan.finish();
  return out;
}

ShaderRoles rolesIn(std::string_view text, std::span<const Define> defines) {
  constexpr std::uint64_t kMostTokens = 1'000'000;
  constexpr std::uint32_t kDeepest = 100;
  const TokenList list = expandTokens(text, defines, kMostTokens, kDeepest);
  ShaderRoles out;
  out.unsure = list.exceeded || list.uncertain;
  const Macros none;
  RoleScan scan(out, none);
  for (const Token& token : list.tokens) scan.feed(token);
  scan.finish();
  return out;
}

std::string_view nameOfRole(std::uint16_t roles) {
  constexpr std::pair<Role, std::string_view> kNames[] = {
      {Role::input, "an input"},
      {Role::output, "an output"},
      {Role::opaque, "a uniform"},
      {Role::uniform_block, "a uniform block"},
      {Role::storage_block, "a storage block"},
      {Role::parameter, "a member of the block Parameters"},
      {Role::member, "a member of another block"},
      {Role::instance, "the instance name of a block"},
      {Role::function, "a function"},
      {Role::constant, "a constant"},
      {Role::structure, "a struct"},
      {Role::variable, "a variable"},
  };
  for (const auto& [role, name] : kNames)
    if ((roles & static_cast<std::uint16_t>(role)) != 0) return name;
  return {};
}

}  // namespace weft::glsl
