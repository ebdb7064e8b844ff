#include "engine/glsl/interface.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "engine/text/limits.h"
#include "glsl_sentences.h"

namespace weft::glsl {

namespace {

using Words = std::span<const Token>;

constexpr std::uint64_t kMaxWork = std::uint64_t{1} << 40;

// a + b · n, or kMaxWork.
std::uint64_t addTimes(std::uint64_t a, std::uint64_t b, std::uint64_t n) {
  if (n != 0 && b > kMaxWork / n) return kMaxWork;
  return std::min(kMaxWork, a + b * n);
}

bool isWord(const Token& token) {
  return token.kind == TokenKind::word;
}

bool has(Words words, std::string_view what) {
  return std::ranges::any_of(words, [&](const Token& token) { return token.is(what); });
}

bool isOpaque(std::string_view type, std::string_view kind) {
  return type.starts_with(kind) || (type.size() > 1 && type.substr(1).starts_with(kind));
}

// Past the bracket that closes the one at `at`, or the end.
std::size_t behindBracket(Words words, std::size_t at) {
  int open = 0;
  for (; at < words.size(); ++at) {
    const Token& token = words[at];
    if (token.is("(") || token.is("[") || token.is("{")) ++open;
    if ((token.is(")") || token.is("]") || token.is("}")) && --open <= 0) return at + 1;
  }
  return at;
}

struct Function {
  std::string_view name;
  std::uint64_t tokens = 0, inlined = 0;
  std::set<std::string_view> words;
  std::map<std::string_view, std::uint64_t> calls;  // words with a bracket behind them, and how often
};

// Which functions call which: what main() reaches, and what each of them costs.
class CallTree {
 public:
  std::vector<Function> functions;
  std::set<std::string_view> globals;  // words of the values of global variables

  void finish(Interface& out) {
    for (std::size_t i = 0; i < functions.size(); ++i) byName_[functions[i].name].push_back(i);
    reach(out);
    // Functions mostly stand behind those that they call, so one round finds all sums. Where some still grow after a few, as
    // they do in a circle, the driver may have to work long.
    bool grows = true;
    for (int round = 0; grows && round < 4; ++round) grows = inlineCalls();
    // Mesa does it in every function, not in main() alone: a chain of calls costs the square of its length.
    for (const Function& function : functions)
      out.size.inlined = addTimes(out.size.inlined, function.inlined, 1);
    if (grows) out.size.inlined = kMaxWork;
  }

 private:
  void reach(Interface& out) const {
    std::vector<std::string_view> open{"main"};
    open.insert(open.end(), globals.begin(), globals.end());
    out.live = globals;
    std::set<std::string_view> seen;
    while (!open.empty()) {
      const auto found = byName_.find(open.back());
      open.pop_back();
      if (found == byName_.end() || !seen.insert(found->first).second) continue;
      for (const std::size_t index : found->second)
        for (const std::string_view word : functions[index].words)
          if (out.live.insert(word).second || byName_.contains(word)) open.push_back(word);
    }
  }

  // Adds to each function what it calls, as far as that is known. True when one has grown.
  bool inlineCalls() {
    bool grown = false;
    for (std::size_t i = 0; i < functions.size(); ++i) {
      std::uint64_t inlined = functions[i].tokens;
      for (const auto& [name, count] : functions[i].calls) {
        const auto callees = byName_.find(name);
        if (callees == byName_.end()) continue;
        std::uint64_t largest = 0;
        // Overloads call each other more often than functions themselves.
        for (const std::size_t callee : callees->second)
          if (callee != i || callees->second.size() == 1)
            largest = std::max(largest, functions[callee].inlined);
        inlined = addTimes(inlined, largest, count);
      }
      grown |= std::exchange(functions[i].inlined, inlined) < inlined;
    }
    return grown;
  }

  std::map<std::string_view, std::vector<std::size_t>> byName_;
};

// The statements of the file, of its blocks and of its functions.
class InterfaceReader {
 public:
  InterfaceReader(Words tokens, Interface& out) : tokens_(tokens), out_(out) {}

  void run() {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      const Token& token = tokens_[i];
      if (token.is(";")) {
        take(tokens_.subspan(begin, i - begin), token);
        begin = i + 1;
      } else if (token.is("{")) {
        const std::size_t behind = behindBracket(tokens_, i);
        if (!tokens_[behind - 1].is("}")) break;  // brackets do not pair
        const Words before = tokens_.subspan(begin, i - begin),
                    inside = tokens_.subspan(i + 1, behind - i - 2);
        i = behind - 1;
        if (before.empty()) break;
        if (!before.back().is(")") && !isWord(before.back())) continue;  // values, which go on to their ';'
        if (before.back().is(")")) {
          takeFunction(before, inside);
        } else {
          while (i < tokens_.size() && !tokens_[i].is(";")) ++i;
          takeBlock(before, inside, tokens_.subspan(behind, std::max(i, behind) - behind), token);
        }
        begin = i + 1;
      } else if (token.is("}")) {
        break;
      }
    }
    const auto count = [&](std::string_view brace) {
      return std::ranges::count_if(tokens_, [&](const Token& token) { return token.is(brace); });
    };
    out_.unsure = begin < tokens_.size() || count("{") != count("}");
    calls_.finish(out_);
  }

 private:
  static bool isMember(Words words, std::size_t i) { return i > 0 && words[i - 1].is("."); }

  std::optional<std::int64_t> valueOf(Words words) const {
    constexpr std::uint32_t kDeepest = 64;
    return evaluateTokens(
        words,
        [&](std::string_view name) -> std::optional<std::int64_t> {
          const auto found = constants_.find(name);
          return found == constants_.end() ? std::nullopt : std::optional(found->second);
        },
        kDeepest);
  }

  // "[4][n]" from `at` on, which is moved behind it: the product, or 0 where it is not known.
  std::uint64_t elementsAt(Words words, std::size_t& at) const {
    std::uint64_t product = 1;
    while (at < words.size() && words[at].is("[")) {
      const std::size_t end = behindBracket(words, at);
      const auto size = valueOf(words.subspan(at + 1, std::max(end, at + 2) - at - 2));
      product = size && *size > 0 ? addTimes(0, product, static_cast<std::uint64_t>(*size)) : 0;
      at = end;
    }
    return product;
  }

  void note(std::uint64_t elements) { out_.size.elements = std::max(out_.size.elements, elements); }

  static std::string textOf(Words words) {
    std::string text;
    for (const Token& word : words) text += word.text;
    return text;
  }

  // What a statement is besides its names.
  struct Kind {
    std::optional<Role> role;  // of members and fields
    std::string_view owner, instance;
    std::uint32_t times = 1;  // elements of the block
  };

  static Role roleOf(Words before, std::string_view type) {
    if (has(before, "uniform") || has(before, "buffer"))
      return isOpaque(type, "sampler") ? Role::sampler
             : isOpaque(type, "image") ? Role::image
                                       : Role::uniform;
    if (has(before, "in")) return Role::input;
    if (has(before, "out")) return Role::output;
    return has(before, "const") ? Role::constant : Role::variable;
  }

  void take(Words words, const Token& end) {
    if (!words.empty() && !words[0].is("precision") && !words[0].is("invariant")) takeNames(words, end, {});
  }

  // "layout(rgba8) uniform image2D a, b[2]", "float x = 1.0", "vec3 f(vec3 x)".
  void takeNames(Words words, const Token& end, const Kind& kind) {
    Declaration made{
        .owner = kind.owner, .instance = kind.instance, .layout = {}, .begin = words[0], .end = end};
    const Token* type = nullptr;
    std::string arrayOfType;
    std::uint64_t elementsOfType = 1;
    for (std::size_t at = 0; at < words.size() && isWord(words[at]);) {
      const std::size_t first = at;
      const Token& word = words[at++];
      const bool bracket = at < words.size() && words[at].is("(");
      if (bracket && word.is("layout")) {
        const std::size_t behind = behindBracket(words, at);
        for (; at < behind; ++at)
          if (isWord(words[at])) made.layout.push_back(words[at].text);
        continue;
      }
      if (bracket) {  // a function without its body
        if (type) add(made, Role::function, word, type->text);
        return;
      }
      const std::size_t dimensions = at;
      const std::uint64_t elements = elementsAt(words, at);
      const std::string array = textOf(words.subspan(dimensions, at - dimensions));
      if (at < words.size() && !words[at].is(",") && !words[at].is("=")) {  // it is not the name yet
        type = &word;
        arrayOfType = array;
        elementsOfType = elements;
        continue;
      }
      if (!type) return;  // "layout(…) in;"
      made.reads = !has(words.first(first), "writeonly");
      made.writes = !has(words.first(first), "readonly");
      shared_ = has(words.first(first), "shared");
      const Role role = kind.role ? *kind.role : roleOf(words.first(first), type->text);
      for (at = dimensions; at <= words.size(); at += 2) {  // behind the name, then behind the next
        const std::size_t begin = at;
        const std::uint64_t own = elementsAt(words, at);
        takeName(words, made, role, words[begin - 1], type->text,
                 textOf(words.subspan(begin, at - begin)) + arrayOfType,
                 addTimes(0, own * elementsOfType, kind.times), at);
        if (at >= words.size() || !words[at].is(",")) return;
      }
      return;
    }
  }

  // One name; `at`: what stands behind it, a value is passed over.
  void takeName(Words words, Declaration& made, Role role, const Token& name, std::string_view type,
                std::string array, std::uint64_t elements, std::size_t& at) {
    const bool value = at < words.size() && words[at].is("=");
    const std::size_t begin = at + 1;
    if (value)
      while (at < words.size() && !words[at].is(","))
        at = words[at].is("(") || words[at].is("[") || words[at].is("{") ? behindBracket(words, at) : at + 1;
    if (value && (role == Role::variable || role == Role::constant)) {
      const Words values = words.subspan(begin, at - begin);
      for (std::size_t i = 0; i < values.size(); ++i)
        if (isWord(values[i]) && !isMember(values, i)) calls_.globals.insert(values[i].text);
      if (role == Role::constant)
        if (const auto known = valueOf(values)) constants_[name.text] = *known;
    }
    made.array = std::move(array);
    made.elements = static_cast<std::uint32_t>(std::min<std::uint64_t>(elements, 0xffffffff));
    if ((role == Role::constant || role == Role::variable) && !shared_) note(elements);
    add(made, role, name, type);
  }

  void add(Declaration& made, Role role, const Token& name, std::string_view type) {
    made.role = role;
    made.name = name.text;
    made.type = type;
    made.at = name;
    out_.declarations.push_back(made);
  }

  // A structure or a block; `behind`: its instance.
  void takeBlock(Words before, Words inside, Words behind, const Token& brace) {
    const Token& name = before.back();
    Kind kind{.role = Role::field, .owner = name.text};
    Declaration made{.layout = {}, .begin = before[0], .end = brace};
    if (has(before, "struct")) {
      add(made, Role::structure, name, {});
      for (const Token& each : behind)
        if (isWord(each)) add(made, Role::variable, each, name.text);
    } else {
      std::size_t at = 1;
      if (!behind.empty()) made.instance = kind.instance = behind[0].text;
      if (!behind.empty())
        made.elements =
            static_cast<std::uint32_t>(std::min<std::uint64_t>(elementsAt(behind, at), 0xffffffff));
      made.reads = !has(before, "writeonly");
      made.writes = !has(before, "readonly");
      const bool uniform = has(before, "uniform"), storage = has(before, "buffer");
      kind.role = uniform || storage ? Role::member : has(before, "out") ? Role::output : Role::input;
      if (uniform || storage)
        add(made, uniform ? Role::uniform_block : Role::storage_block, name, {});
      else
        kind.times = std::max(1u, made.elements);
    }
    for (std::size_t begin = 0, i = 0; i < inside.size(); ++i) {
      if (!inside[i].is(";")) continue;
      if (i > begin) takeNames(inside.subspan(begin, i - begin), inside[i], kind);
      begin = i + 1;
    }
  }

  void takeFunction(Words before, Words inside) {
    std::size_t open = before.size();
    for (int nested = 0; open > 0;) {
      --open;
      nested += before[open].is(")") ? 1 : before[open].is("(") ? -1 : 0;
      if (nested == 0) break;
    }
    if (open == 0 || !isWord(before[open - 1])) return;
    const Token& name = before[open - 1];
    Declaration made{.layout = {}, .begin = before[0], .end = before.back()};
    add(made, Role::function, name, open > 1 ? before[open - 2].text : std::string_view());
    calls_.functions.push_back({.name = name.text, .tokens = inside.size(), .words = {}, .calls = {}});
    Function& function = calls_.functions.back();
    takeBody(before.subspan(open), nullptr);
    takeBody(inside, &function);
  }

  // The words of a function, and the variables that it declares: "float gain =" is a type and a name.
  void takeBody(Words words, Function* function) {
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (!isWord(words[i]) || isMember(words, i)) continue;
      const Token& word = words[i];
      const Token* next = i + 1 < words.size() ? &words[i + 1] : nullptr;
      if (function) {
        function->words.insert(word.text);
        if (next && next->is("(")) ++function->calls[word.text];
      }
      if (next && next->is("[")) {
        std::size_t at = i + 1;
        note(elementsAt(words, at));
      }
      const Token* type = i > 0 ? &words[i - 1] : nullptr;
      const bool ends =
          !next || next->is("=") || next->is(";") || next->is(",") || next->is("[") || next->is(")");
      if (!ends || !type || !isWord(*type) || type->is("return") || type->is("else")) continue;
      Declaration made{.layout = {}, .begin = *type, .end = word};
      add(made, Role::variable, word, type->text);
    }
  }

  const Words tokens_;
  Interface& out_;
  CallTree calls_;
  std::map<std::string_view, std::int64_t> constants_;
  bool shared_ = false;  // the statement declares what a work group shares, which is bounded elsewhere
};

bool isControl(const Token& token) {
  return isWord(token) && (token.is("if") || token.is("else") || token.is("for") || token.is("while") ||
                           token.is("do") || token.is("switch"));
}

// How deeply brackets, blocks and operators are nested.
void measure(Words tokens, ShaderSize& size) {
  struct Level {
    std::uint32_t operators = 0;  // of the expression under way
    std::uint32_t controls = 0;   // if, else, for … around the statement under way
  };
  std::vector<Level> levels(1);
  std::uint64_t depth = 0;
  std::size_t statement = 0;
  const auto endStatement = [&](std::size_t at) {
    Level& level = levels.back();
    depth -= std::exchange(level.operators, 0);
    if (at + 1 == tokens.size() || !tokens[at + 1].is("else")) depth -= std::exchange(level.controls, 0);
    statement = at + 1;
  };
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const Token& token = tokens[i];
    if (isControl(token)) {
      ++levels.back().controls;
      ++depth;
      if (token.is("else") || token.is("do")) statement = i + 1;
    } else if (token.is("(") || token.is("[") || token.is("{")) {
      levels.emplace_back();
      ++depth;
      if (token.is("{") && (i == 0 || !tokens[i - 1].is("="))) statement = i + 1;
    } else if (token.is(")") || token.is("]") || token.is("}")) {
      if (levels.size() == 1) continue;
      depth -= 1 + levels.back().operators + levels.back().controls;
      levels.pop_back();
      if (token.is("}")) endStatement(i);
    } else if (token.is(";")) {
      endStatement(i);
    } else if (token.is(",")) {
      depth -= std::exchange(levels.back().operators, 0);
    } else if (token.kind == TokenKind::sign && !token.is(".") && !token.is(":")) {
      ++levels.back().operators;
      ++depth;
    }
    if (depth <= size.depth) continue;
    const Token& from = tokens[std::min(statement, i)];
    size.depth = depth;
    size.line = from.line;
    size.column = from.column;
  }
}

}  // namespace

bool checkShaderSize(const ShaderSize& size, const ShaderSource& source, text::Diagnostics& diagnostics) {
  using Measure = text::SentenceFor<std::uint64_t, std::uint64_t, std::string>;
  const auto check = [&](Measure what, std::uint64_t bound, std::uint64_t count, const text::Place& place) {
    const std::uint64_t most = text::raised(bound);
    const std::string raise = text::hintToRaise(bound), hint = raise.empty() ? "" : "; or " + raise;
    if (count > most)
      diagnostics.add(text::Severity::error,
                      text::diagnosticOf(what.sentence, fmt::make_format_args(most, count, hint)), place);
    return count <= most;
  };
  return check(say::shaderTooLarge, kMaxShaderBytes, size.bytes, {source.file, 0, 0}) &&
         check(say::shaderTooDeep, kMaxShaderDepth, size.depth, source.placeOf(size.line, size.column));
}

bool isUnusual(const Interface& interface) {
  constexpr std::uint64_t kTokens = 25'000, kInlined = 32'000, kDepth = 60, kElements = 128;
  const ShaderSize& size = interface.size;
  return interface.unsure || size.tokens > kTokens || size.inlined > kInlined || size.depth > kDepth ||
         size.elements > kElements;
}

const char* nameOf(Role role) {
  constexpr const char* kNames[] = {"a sampler",
                                    "an image",
                                    "a uniform outside a block",
                                    "a uniform block",
                                    "a storage block",
                                    "an input",
                                    "an output",
                                    "a member of a block",
                                    "a structure",
                                    "a member of a structure",
                                    "a function",
                                    "a constant",
                                    "a variable"};
  return kNames[static_cast<std::size_t>(role)];
}

const Declaration* Interface::find(std::string_view name, Role role) const {
  const auto found = std::ranges::find_if(
      declarations, [&](const Declaration& each) { return each.role == role && each.name == name; });
  return found == declarations.end() ? nullptr : &*found;
}

const Declaration* Interface::find(std::string_view name) const {
  const Declaration* best = nullptr;
  for (const Declaration& each : declarations)
    if (each.name == name && (!best || each.role < best->role)) best = &each;
  return best;
}

bool Interface::isLive(const Declaration& declared) const {
  if (!declared.instance.empty()) return isLive(declared.instance);
  if (declared.role != Role::uniform_block && declared.role != Role::storage_block)
    return isLive(declared.name);
  return unsure || std::ranges::any_of(declarations, [&](const Declaration& each) {
           return each.role == Role::member && each.owner == declared.name && isLive(each.name);
         });
}

Interface readInterface(std::string_view text, std::span<const Define> defines, Branches branches) {
  const auto deepest =
      static_cast<std::uint32_t>(std::min<std::uint64_t>(text::raised(kMaxShaderDepth), 5000));
  Interface out;
  out.size.bytes = text.size();
  out.unsure = text.size() > text::raised(kMaxShaderBytes);
  if (out.unsure) return out;
  TokenList list = expandTokens(text, defines, deepest + 1, branches);
  InterfaceReader(list.tokens, out).run();
  out.unsure = out.unsure || list.uncertain;
  out.pasted = std::move(list.pasted);
  out.size.tokens = list.tokens.size();
  measure(list.tokens, out.size);
  return out;
}

}  // namespace weft::glsl
