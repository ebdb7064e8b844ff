// What a shader declares and uses, from its tokens: samplers, images with their formats, blocks with their members, inputs, outputs,
// and which names main() reaches. Also how hard a driver has to work: bytes, tokens after macros, nesting, and functions with their
// calls replaced by what they call. docs/limits.md says what drivers were measured to survive. Whether the text is right, the
// driver says.
#pragma once

#include <cstdint>
#include <deque>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/glsl/source.h"
#include "engine/glsl/tokens.h"
#include "engine/text/diagnostic.h"

namespace weft::glsl {

// Of one shader with what it includes; `--limit` raises them. Depth: of brackets, operators or blocks around one another.
constexpr std::uint64_t kMaxShaderBytes = 1ull << 20, kMaxShaderDepth = 500;

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

struct ShaderSize {
  std::uint64_t bytes = 0;
  std::uint64_t depth = 0;             // brackets, blocks and operators around one another
  std::uint32_t line = 0, column = 0;  // where in the text the deepest statement begins, from 1
  std::uint64_t tokens = 0;            // after macros
  std::uint64_t inlined = 0;           // tokens of all functions, once calls are replaced by what they call
  std::uint64_t elements = 0;          // of the largest array, blocks aside
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
  bool isLive(const Declaration& declaration) const;  // of a block without an instance: one of its members
};

// Reports each count that is above its limit (W203). True when there is none.
bool checkShaderSize(const ShaderSize& size, const ShaderSource& source, text::Diagnostics& diagnostics);

// Whether the driver may not survive the shader, or must work long: then a process of its own tries it first.
bool isUnusual(const Interface& interface);

// Of a text with these defines, as assembleSource() puts them before it. The text must outlive the interface.
// Of all branches of every #if at once a name may be several things.
Interface readInterface(std::string_view text, std::span<const Define> defines,
                        Branches branches = Branches::taken);

}  // namespace weft::glsl
