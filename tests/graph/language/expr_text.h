// Canonical text of an expression, fit to be parsed again; folded keys are "$#1" and "age(#1)".
#pragma once

#include <fmt/format.h>

#include <string>

#include "engine/graph/language/expr_node.h"

namespace weft::graph {

// Parentheses only where the grammar needs them. `outer` is the precedence of the surroundings.
inline void printNode(const ExprNode& node, int outer, std::string& out) {
  const OpInfo info = infoOf(node.op);
  const bool parens = info.precedence > 0 && info.precedence < outer;
  const auto list = [&](const char* open, char close) {
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      out += i > 0 ? ", " : open;
      printNode(*node.children[i], 0, out);
    }
    out += close;
  };
  if (parens) out += '(';
  switch (node.op) {
    case ExprOp::constant: {
      // "-1" binds like a unary minus, and "1.x" is no number.
      const bool wrap = node.value.type == Value::Type::number && outer > 7;
      out += wrap ? "(" + toText(node.value) + ")" : toText(node.value);
      break;
    }
    case ExprOp::list:
      list("[", ']');
      break;
    case ExprOp::variable:
    case ExprOp::identifier:
    case ExprOp::builtin:
      out += (node.op == ExprOp::variable ? "$" : "") + node.name;
      break;
    case ExprOp::fact:
      if (node.fact == Fact::value) {
        out += node.name;
        if (!node.children.empty()) list("[", ']');
        out += "." + node.value.symbol;
        break;
      }
      out += fmt::format("{}({}", nameOf(node.fact), node.name);
      if (!node.children.empty()) list(".mip[", ']');
      out += ')';
      break;
    case ExprOp::age_key:
    case ExprOp::parameter_key:
      out += fmt::format(fmt::runtime(node.op == ExprOp::age_key ? "age(#{})" : "$#{}"), node.key);
      break;
    case ExprOp::component:
      printNode(*node.children[0], info.precedence, out);
      out += '.';
      out += "xyzw"[node.key];
      break;
    case ExprOp::negate:
    case ExprOp::logical_not:
      out += info.spelling;
      printNode(*node.children[0], info.precedence, out);
      break;
    case ExprOp::conditional:
      printNode(*node.children[0], 2, out);
      out += " ? ";
      printNode(*node.children[1], 0, out);
      out += " : ";
      printNode(*node.children[2], 1, out);
      break;
    default:
      if (info.precedence == 0) {
        out += info.spelling;
        list("(", ')');
        break;
      }
      // Comparisons do not chain, so both their sides need a tighter operator.
      printNode(*node.children[0], info.precedence + (info.precedence == 4 ? 1 : 0), out);
      out += fmt::format(" {} ", info.spelling);
      printNode(*node.children[1], info.precedence + 1, out);
  }
  if (parens) out += ')';
}

inline std::string textOf(const Expr& expr) {
  std::string out;
  if (expr.root()) printNode(*expr.root(), 0, out);
  return out;
}

}  // namespace weft::graph
