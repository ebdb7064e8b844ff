// How long functions are once every call is replaced by what it calls, as compilers do, and which of them
// call each other in a circle. A part of shader_bounds, not for others.
#pragma once

#include <cstdint>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/glsl/bounds.h"
#include "engine/glsl/tokens.h"

namespace weft::glsl {

class CallCount {
 public:
  void begin(std::string_view name, std::uint32_t arguments, const Token& at);
  void end() { open_ = false; }
  bool open() const { return open_; }
  void addTokens(std::uint64_t count) { functions_.back().tokens += count; }
  void addCall(std::string_view name, std::uint32_t arguments) {
    ++functions_.back().calls[{name, arguments}];
  }
  // Writes `inlined` and the circle.
  void finish(ShaderSize& size);

 private:
  using Signature = std::pair<std::string_view, std::uint32_t>;
  struct Function {
    Signature signature;
    Token at;
    std::uint64_t tokens = 0, inlined = 0;
    std::map<Signature, std::uint64_t> calls;  // how often each is called
    std::vector<std::pair<std::uint32_t, std::uint64_t>>
        callees;  // candidates of one call beside one another
    enum class State : std::uint8_t { fresh, open, done } state = State::fresh;
  };
  void resolve(std::uint32_t index);
  void visit(std::uint32_t root, ShaderSize& size);
  void close(Function& function);
  void noteCircle(const std::vector<std::uint32_t>& path, std::uint32_t first, ShaderSize& size) const;

  std::vector<Function> functions_;
  std::map<Signature, std::vector<std::uint32_t>> bySignature_;
  bool open_ = false;
};

}  // namespace weft::glsl
