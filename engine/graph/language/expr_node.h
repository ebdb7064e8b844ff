// The tree behind Expr, shared by the parser, the evaluator and the printer. Private to engine/graph/language. Nodes are
// immutable once built; `height` bounds every recursion over them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/graph/language/expr.h"
#include "engine/text/diagnostic.h"

namespace weft::graph {

enum class ExprOp : std::uint8_t {
  constant,
  list,        // children: 1..4 items
  variable,    // name: "bloom", "composite.fog"
  identifier,  // name: a repeat index, else a symbol
  builtin,     // name: "screen", "device.software", "device.window"
  // name: the resource, with its @ if written; fact; children: the level of size(x.mip[level]). Of Fact::value also its name, in
  // `value`, and children: the row.
  fact,
  age_key,        // key: a folded age()
  parameter_key,  // key: a live parameter, folded
  component,      // children: the list; key: 0..3
  negate,
  logical_not,
  add,
  subtract,
  multiply,
  divide,
  modulo,
  equal,
  not_equal,
  less,
  less_equal,
  greater,
  greater_equal,
  logical_and,
  logical_or,
  conditional,  // children: condition, then, else
  minimum,
  maximum,
  ceil,
  floor,
  log2ceil,
  pow2ceil,
  abs,
  round,
  pow2,
  log2,
};
constexpr ExprOp kLastOp = ExprOp::log2;

struct ExprNode {
  ExprOp op = ExprOp::constant;
  Fact fact = Fact::size;
  std::uint8_t height = 1;          // 1 for leaves; never above kMaxExprHeight
  bool dynamic = false;             // contains age()
  bool live = false;                // contains a live parameter, or a value of an import, folded
  bool watched = false;             // contains a value of an import, not folded
  std::uint8_t part = kWholeValue;  // of a value of an import: as ImportValue
  bool folded = false;              // nothing in it is left to fold
  std::uint32_t key = 0;            // of a parsed fact: bytes from `place` to the resource, without its @
  std::uint32_t terms = 1;          // nodes from here down; one that stands in several places counts in each
  text::Place place;                // of the token to blame: the operator, the name, the function
  Value value{};
  std::string name{};
  std::vector<std::shared_ptr<const ExprNode>> children{};
};

using ExprPtr = std::shared_ptr<const ExprNode>;

constexpr int kMaxExprHeight = 200;
// The most terms of an expression that is evaluated in every frame or with every move of a slider. A `let` counts with
// all its terms wherever it is used, because the expression is evaluated as a tree.
constexpr std::uint32_t kMaxFoldedTerms = 10'000;

// Spelling and precedence of operators, from `component` on; of functions how many operands they take. `apply` is what arithmetic
// and comparisons yield for numbers: NaN outside of their domain; the second is ignored where there is one operand.
struct OpInfo {
  const char* spelling;
  std::uint8_t precedence;  // 0: no operator; larger binds tighter
  std::uint8_t least = 0, most = 0;
  double (*apply)(double, double) = nullptr;
};
OpInfo infoOf(ExprOp op);
// The operator or function among [first, last] with that spelling; `constant` when there is none.
ExprOp findOp(std::string_view spelling, ExprOp first, ExprOp last);

// A hint for a word that stands where a number or a condition belongs: it was probably a parameter without its $, or a
// misspelt `screen`. "" when the value is no word, or nothing is near.
std::string hintForWord(EvalScope& scope, const Value& value);

// "size", "mips", "count", "has", "age", "format"; "" for a value of an import.
const char* nameOf(Fact fact);

// Calls f for the node and everything below it.
template <class F>
void visitNodes(const ExprNode& node, const F& f) {
  f(node);
  for (const ExprPtr& child : node.children) visitNodes(*child, f);
}

// A node over `children`, with height and dynamic filled in. The caller has checked the height.
ExprPtr makeNode(ExprOp op, text::Place place, std::vector<ExprPtr> children);
ExprPtr makeConstant(Value value, text::Place place);
// 1 + the greatest height among `children`, and 1 + all their terms.
int heightOver(const std::vector<ExprPtr>& children);
std::uint32_t termsOver(const std::vector<ExprPtr>& children);
// Sets what a node's children decide: height (which the caller has checked), dynamic, live, terms.
void setChildren(ExprNode& node, std::vector<ExprPtr> children);

// The trees of Expr::parse; null after an error.
ExprPtr parseExprTree(std::string_view text, const text::Place& place, text::Diagnostics& diagnostics);

}  // namespace weft::graph
