#include "engine/glsl/calls.h"

#include <algorithm>
#include <string>

namespace weft::glsl {

namespace {

constexpr std::uint64_t kMost = std::uint64_t{1} << 62;

// What functions of the language become, in tokens of usual code that cost the driver as much
// (docs/limits.md).
std::uint64_t weightOf(std::string_view name) {
  constexpr std::pair<std::string_view, std::uint64_t> kWeights[] = {
      {"inverse", 500},   {"determinant", 150}, {"sin", 80},    {"cos", 80},         {"tan", 160},
      {"asin", 150},      {"acos", 150},        {"atan", 190},  {"sinh", 150},       {"cosh", 150},
      {"tanh", 150},      {"asinh", 150},       {"acosh", 150}, {"atanh", 150},      {"exp", 70},
      {"log", 70},        {"exp2", 60},         {"log2", 60},   {"pow", 150},        {"mod", 20},
      {"smoothstep", 20}, {"normalize", 20},    {"fract", 10},  {"sign", 10},        {"length", 20},
      {"distance", 20},   {"reflect", 20},      {"cross", 10},  {"refract", 30},     {"sqrt", 10},
      {"floor", 5},       {"round", 10},        {"mix", 5},     {"outerProduct", 50}};
  for (const auto& [each, weight] : kWeights)
    if (each == name) return weight;
  if (name.starts_with("textureGather")) return 250;
  return name.starts_with("texture") ? 100 : name.starts_with("texelFetch") ? 40 : 0;
}

// a + b · n, or kMost.
std::uint64_t addTimes(std::uint64_t a, std::uint64_t b, std::uint64_t n) {
  if (n != 0 && b > (kMost - a) / n) return kMost;
  return a + b * n;
}

}  // namespace

void CallCount::begin(std::string_view name, std::uint32_t arguments, const Token& at) {
  bySignature_[{name, arguments}].push_back(static_cast<std::uint32_t>(functions_.size()));
  functions_.push_back({.signature = {name, arguments}, .at = at, .calls = {}, .callees = {}});
  open_ = true;
}

// A call may mean any function of its name and number of arguments; the one that it stands in only where
// there is no other, as overloads call each other more often than functions themselves.
void CallCount::resolve(std::uint32_t index) {
  Function& function = functions_[index];
  for (const auto& [signature, count] : function.calls) {
    const auto found = bySignature_.find(signature);
    if (found == bySignature_.end()) {
      function.tokens = addTimes(function.tokens, weightOf(signature.first), count);
      continue;
    }
    for (const std::uint32_t callee : found->second)
      if (callee != index || found->second.size() == 1) function.callees.emplace_back(callee, count);
  }
}

void CallCount::finish(ShaderSize& size) {
  for (std::uint32_t i = 0; i < functions_.size(); ++i) resolve(i);
  for (std::uint32_t i = 0; i < functions_.size(); ++i)
    if (functions_[i].state == Function::State::fresh) visit(i, size);
  // Mesa does it in every function, not in main() alone: a chain of calls costs the square of its length.
  std::uint64_t largest = 0, all = 0;
  for (const Function& function : functions_) {
    all = addTimes(all, function.inlined, 1);
    if (function.inlined <= largest) continue;
    largest = function.inlined;
    size.inlined = {.count = 0,
                    .line = function.at.line,
                    .column = function.at.column,
                    .name = std::string(function.signature.first)};
  }
  size.inlined.count = all;
}

// Depth first without recursion: a chain of calls may be long.
void CallCount::visit(std::uint32_t root, ShaderSize& size) {
  std::vector<std::uint32_t> path{root};
  std::vector<std::size_t> next{0};
  functions_[root].state = Function::State::open;
  while (!path.empty()) {
    Function& function = functions_[path.back()];
    if (next.back() == function.callees.size()) {
      close(function);
      path.pop_back();
      next.pop_back();
      continue;
    }
    const std::uint32_t callee = function.callees[next.back()++].first;
    if (functions_[callee].state == Function::State::open) noteCircle(path, callee, size);
    if (functions_[callee].state != Function::State::fresh) continue;
    functions_[callee].state = Function::State::open;
    path.push_back(callee);
    next.push_back(0);
  }
}

void CallCount::close(Function& function) {
  function.inlined = function.tokens;
  for (const auto& [signature, count] : function.calls) {
    std::uint64_t largest = 0;
    for (const auto& [callee, times] : function.callees)
      if (functions_[callee].signature == signature) largest = std::max(largest, functions_[callee].inlined);
    function.inlined = addTimes(function.inlined, largest, count);
  }
  function.state = Function::State::done;
}

void CallCount::noteCircle(const std::vector<std::uint32_t>& path, std::uint32_t first,
                           ShaderSize& size) const {
  if (!size.circle.empty()) return;
  for (auto it = std::find(path.begin(), path.end(), first); it != path.end(); ++it)
    size.circle.emplace_back(functions_[*it].signature.first);
  size.circle.push_back(size.circle.front());
  const Token& at = functions_[first].at;
  size.circleAt = {
      .count = size.circle.size() - 1, .line = at.line, .column = at.column, .name = size.circle.front()};
}

}  // namespace weft::glsl
