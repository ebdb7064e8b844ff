// What the operators of expressions do to numbers. Private to engine/graph/language. Does not: know lists,
// names or diagnostics.
#pragma once

#include "engine/graph/language/expr_node.h"

namespace weft::graph {

// The result of an arithmetic operator or function for one component; `b` is ignored where there is one
// operand. NaN marks a domain error.
double combine(ExprOp op, double a, double b);

}  // namespace weft::graph
