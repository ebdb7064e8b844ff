#include "engine/graph/language/expr_math.h"

#include <cmath>

namespace weft::graph {

namespace {

// Smallest k >= 0 with 2^k >= x, for x > 0. Exact.
double log2ceil(double x) {
  if (x <= 1) return 0;
  if (std::isinf(x)) return x;
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);  // x = mantissa * 2^exponent, mantissa in [0.5, 1)
  return mantissa == 0.5 ? exponent - 1 : exponent;
}

}  // namespace

double combine(ExprOp op, double a, double b) {
  switch (op) {
    case ExprOp::add:
      return a + b;
    case ExprOp::subtract:
      return a - b;
    case ExprOp::multiply:
      return a * b;
    case ExprOp::divide:
      return b == 0 ? NAN : a / b;
    case ExprOp::modulo:
      return b == 0 ? NAN : a - b * std::floor(a / b);
    case ExprOp::minimum:
      return b < a ? b : a;
    case ExprOp::maximum:
      return b > a ? b : a;
    case ExprOp::negate:
      return -a;
    case ExprOp::ceil:
      return std::ceil(a);
    case ExprOp::floor:
      return std::floor(a);
    case ExprOp::log2ceil:
      return a > 0 ? log2ceil(a) : NAN;
    case ExprOp::pow2ceil:
      return a <= 1 ? 1 : std::exp2(log2ceil(a));
    case ExprOp::abs:
      return std::fabs(a);
    default:
      return NAN;
  }
}

}  // namespace weft::graph
