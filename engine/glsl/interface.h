// What a shader declares and uses, from its tokens: samplers, images with their formats, blocks with their members, inputs, outputs,
// and which names main() reaches. Also what says how hard a driver has to work: nesting, functions with their calls replaced by what
// they call, and functions in a circle. Does not: check that the text is right, or know which branch a constant decides.
#pragma once

#include <cstdint>
#include <deque>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/glsl/tokens.h"

namespace weft::glsl {

// Of one shader with what it includes; `--limit` raises them. Tokens: after its macros. Depth: of brackets, operators or blocks
// around one another.
constexpr std::uint64_t kMostShaderBytes = 1ull << 20, kMostShaderTokens = 200'000, kMostShaderDepth = 500;

enum class Role : std::uint8_t {
  sampler,
  image,
  uniform,  // outside a block
  uniform_block,
  storage_block,
  input,
  output,
  member,  // of a uniform or storage block
  structure,
  field,  // of a structure
  function,
  constant,
  variable,  // outside or inside a function
};
// "a sampler", "an output", …
const char* nameOf(Role role);

struct Declaration {
  Role role = Role::variable;
  std::string_view name, type;           // type: "vec3", or a structure; of a block ""
  std::string array;                     // "[4]", as written
  std::uint32_t elements = 1;            // of an array; 0: their number is not written, or not known
  std::string_view owner;                // of a member its block, of a field its structure
  std::string_view instance;             // of a block and its members: the name of its instance, or ""
  std::vector<std::string_view> layout;  // the words of its layout(…)
  bool reads = true, writes = true;      // of images and storage blocks, by their qualifiers
  Token at;                              // the name
  Token begin, end;                      // of the statement; of a block up to its '{'
};

// A count, and where in the text the thing that has it begins (from 1).
struct ShaderCount {
  std::uint64_t count = 0;
  std::uint32_t line = 0, column = 0;
  std::string name;  // of the macro, or empty
};

struct ShaderSize {
  ShaderCount tokens;  // after macros; counting ends above the limit
  ShaderCount depth;   // brackets, blocks and operators around one another
  std::uint64_t bytes = 0;
  std::uint64_t inlined = 0;   // tokens of all functions, once calls are replaced by what they call
  std::uint64_t cases = 0;     // of all switches
  std::uint64_t elements = 0;  // of the largest array or table, blocks aside
  // Functions that call each other in a circle, the first one again at the end; empty: none is seen. Overloads are not
  // told apart, so a circle is only one where the driver refuses the program, too.
  std::vector<std::string> circle;
  ShaderCount circleAt;
};

struct Interface {
  std::vector<Declaration> declarations;  // in the order of the text
  std::set<std::string_view> live;        // words of the functions that main() reaches
  bool unsure = false;                    // it could not be read whole: anything may be declared, and live
  ShaderSize size;
  std::deque<std::string> pasted;  // what views may look into besides the text

  const Declaration* find(std::string_view name, Role role) const;
  // The plainest thing that the name is: what an interface has before what a function has.
  const Declaration* find(std::string_view name) const;
  bool isLive(std::string_view name) const { return unsure || live.contains(name); }
  bool isLive(const Declaration& declaration) const {
    return isLive(declaration.instance.empty() ? declaration.name : declaration.instance);
  }
};

// Of these tokens, directives apart.
Interface readInterface(std::span<const Token> tokens);
// Of a text with these defines, as assembleSource() puts them before it. The text must outlive the interface.
Interface readInterface(std::string_view text, std::span<const Define> defines);
// Of all branches of every #if at once: a name may be several things.
Interface readAllBranches(std::string_view text);

}  // namespace weft::glsl
