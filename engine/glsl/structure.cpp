#include "engine/glsl/structure.h"

#include <algorithm>
#include <array>
#include <unordered_set>
#include <utility>

#include "engine/glsl/calls.h"
#include "engine/glsl/declarations.h"

namespace weft::glsl {

namespace {

// Signs that are no operators of an expression.
constexpr std::array<std::string_view, 9> kSeparators{"(", ")", "[", "]", "{", "}", ";", ",", ":"};

constexpr std::uint64_t kMatrixTokens = 100;  // for each use of one, its columns aside

bool isControl(const Token& token) {
  constexpr std::array<std::string_view, 6> kWords{"if", "else", "for", "while", "do", "switch"};
  return token.kind == TokenKind::word && std::find(kWords.begin(), kWords.end(), token.text) != kWords.end();
}

class StructureScan {
 public:
  StructureScan(std::span<const Token> tokens, ShaderSize& size)
      : tokens_(tokens), size_(size), declarations_(size) {}

  void run() {
    levels_.emplace_back();
    for (at_ = 0; at_ < tokens_.size(); ++at_) {
      const Token& token = tokens_[at_];
      if (functions_.open()) functions_.addTokens(1);
      if (token.kind == TokenKind::sign)
        takeSign(token);
      else if (token.kind == TokenKind::word)
        takeWord(token);
      else
        levels_.back().empty = false;
    }
    functions_.finish(size_);
  }

 private:
  struct Level {  // an open bracket, or the file
    char bracket = 0;
    std::uint32_t operators = 0;  // of the expression under way
    std::uint32_t controls = 0;   // if, else, for … around the statement under way
    std::uint32_t commas = 0;
    bool empty = true;     // nothing stands in it yet
    bool control = false;  // the brackets behind an if, a for, …
    bool header = false;   // that is a switch
    bool table = false;    // the elements of an array
    bool switched = false;
    std::uint64_t cases = 0;
    Token begin;
    std::string_view call;  // the name before it, or empty
    std::uint32_t depth() const { return (bracket != 0 ? 1 : 0) + operators + controls; }
  };

  const Token* before(std::size_t back = 1) const { return at_ >= back ? &tokens_[at_ - back] : nullptr; }
  const Token* next() const { return at_ + 1 < tokens_.size() ? &tokens_[at_ + 1] : nullptr; }
  bool isBefore(std::string_view text) const { return at_ > 0 && tokens_[at_ - 1].is(text); }

  void deepen(std::uint32_t by) {
    depth_ += by;
    if (depth_ <= size_.depth.count) return;
    const Token& from = statement_ < tokens_.size() ? tokens_[statement_] : tokens_[at_];
    size_.depth = {.count = depth_, .line = from.line, .column = from.column, .name = {}};
  }

  void addOperator() {
    ++levels_.back().operators;
    deepen(1);
  }

  void dropExpression() { depth_ -= std::exchange(levels_.back().operators, 0); }

  void endStatement() {
    dropExpression();
    if (!next() || !next()->is("else")) depth_ -= std::exchange(levels_.back().controls, 0);
    statement_ = at_ + 1;
  }

  // A product of matrices is one sign and a hundred operations. A column, `m[0]`, is a vector; an element of an array of matrices is not.
  void weighMatrix(const Token& token) {
    const Token* last = before();
    const bool named = last && (last->text.starts_with("mat") || last->text.starts_with("dmat"));
    const bool indexed = next() && next()->is("[");
    if (named && last->kind == TokenKind::word) {
      matrices_.insert(token.text);
      if (indexed) matrixArrays_.insert(token.text);
    } else if (functions_.open() && matrices_.contains(token.text) &&
               (!indexed || matrixArrays_.contains(token.text))) {
      functions_.addTokens(kMatrixTokens);
    }
  }

  void takeWord(const Token& token) {
    weighMatrix(token);
    levels_.back().empty = false;
    if (isControl(token)) {
      ++levels_.back().controls;
      deepen(1);
      if (token.is("else") || token.is("do")) statement_ = at_ + 1;
    } else if (token.is("case") || token.is("default")) {
      for (auto level = levels_.rbegin(); level != levels_.rend(); ++level)
        if (level->switched) {
          countCase(*level);
          break;
        }
    }
  }

  void countCase(Level& level) {
    ++size_.allCases;
    if (++level.cases > size_.cases.count)
      size_.cases = {
          .count = level.cases, .line = level.begin.line, .column = level.begin.column, .name = {}};
  }

  void takeSign(const Token& token) {
    if (token.is("(") || token.is("[") || token.is("{")) return open(token);
    if (token.is(")") || token.is("]") || token.is("}")) return close(token);
    levels_.back().empty = false;
    if (token.is(";")) {
      if (levels_.back().bracket != '[' && statement_ < at_)
        declarations_.add(tokens_.subspan(statement_, at_ - statement_));
      endStatement();
    } else if (token.is(",")) {
      ++levels_.back().commas;
      dropExpression();
    } else if (token.is(":")) {
      if (levels_.back().switched) endStatement();
    } else {
      addOperator();
    }
  }

  void open(const Token& token) {
    const Token* last = before();
    Level level{.bracket = token.text[0], .begin = token};
    if (token.is("(")) {
      level.control = last && isControl(*last);
      level.header = level.control && last->is("switch");
      if (level.control && last->is("for")) statement_ = at_ + 1;
      const bool called = last && last->kind == TokenKind::word && !level.control;
      level.table = last && last->is("]");
      if (called) level.call = last->text;
    } else if (token.is("[")) {
      addOperator();
    } else if (last && (last->is("=") || (levels_.back().table && (last->is("{") || last->is(","))))) {
      level.table = true;
    } else if (levels_.size() == 1) {
      openGlobal(last);
    } else {
      level.switched = std::exchange(switchHeader_, false);
    }
    levels_.back().empty = false;
    levels_.push_back(level);
    deepen(1);
    if (token.is("{") && !level.table) statement_ = at_ + 1;
  }

  // The body of a function, a struct or a block.
  void openGlobal(const Token* last) {
    if (last && last->is(")")) {
      functions_.begin(lastCall_, lastArguments_, lastCallAt_);
    } else {
      declarations_.openBody(tokens_.subspan(statement_, at_ - statement_));
    }
  }

  void close(const Token& token) {
    if (levels_.size() == 1) return;
    const Level level = levels_.back();
    depth_ -= level.depth();
    levels_.pop_back();
    if (token.is(")")) {
      const std::uint32_t arguments = level.empty || isBefore("void") ? 0 : level.commas + 1;
      if (level.table) declarations_.noteTable(level.commas + 1, level.begin);
      if (!level.call.empty()) {
        if (functions_.open()) functions_.addCall(level.call, arguments);
        lastCall_ = level.call;
        lastArguments_ = arguments;
        lastCallAt_ = level.begin;
      }
      if (level.control) {
        statement_ = at_ + 1;
        switchHeader_ = level.header;
      }
    } else if (token.is("}")) {
      if (level.table) {
        declarations_.noteTable(level.commas + 1, level.begin);
        return;
      }
      if (levels_.size() == 1) {
        if (functions_.open())
          functions_.end();
        else
          declarations_.closeBody();
      }
      endStatement();
    }
  }

  const std::span<const Token> tokens_;
  ShaderSize& size_;
  DeclarationCount declarations_;
  CallCount functions_;
  std::vector<Level> levels_;
  std::unordered_set<std::string_view> matrices_;  // names declared as such
  std::unordered_set<std::string_view> matrixArrays_;
  std::size_t at_ = 0, statement_ = 0;
  std::uint32_t depth_ = 0;
  bool switchHeader_ = false;
  std::string_view lastCall_;
  std::uint32_t lastArguments_ = 0;
  Token lastCallAt_;
};

}  // namespace

void measureStructure(std::span<const Token> tokens, ShaderSize& size) {
  StructureScan(tokens, size).run();
}

}  // namespace weft::glsl
