// What the names in the text of a shader are: inputs, outputs, samplers, blocks and their members, functions, variables.
// From the tokens, without a context. A text has two answers: that of all branches of every #if, where a name may be
// several things, and that of one variant, with conditionals decided and macros expanded. Does not: check that the text is
// right, or know types. What macros or unpaired brackets hide counts as anything (Role::unsure), so that nothing is denied
// which may be there.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace weft::glsl {

struct Define;

enum class Role : std::uint16_t {
  input = 1,
  output = 2,
  opaque = 4,  // a sampler, an image or a loose uniform
  uniform_block = 8,
  storage_block = 16,
  parameter = 32,  // a member of the block Parameters
  member = 64,     // of another block
  instance = 128,  // of a block
  function = 256,
  variable = 512,
  constant = 1024,
  structure = 2048,
  unsure = 4096,
};

struct ShaderRoles {
  struct Member {
    std::string type, name;  // type of an array: "vec4[4]"
  };
  std::map<std::string, std::uint16_t, std::less<>> roles;  // by name: roles, or'ed
  std::map<std::string, std::vector<std::string>, std::less<>>
      imageFormats;                // by image: the words of its layout
  std::vector<Member> parameters;  // of the block Parameters
  std::map<std::string, std::string, std::less<>>
      blockOf;                                   // by member: its uniform block, where that has another name
  std::string parametersInstance;                // its instance name, or ""
  std::set<std::string, std::less<>> reachable;  // words of the functions that main() reaches
  bool unsure = false;                           // brackets do not pair
  bool is(std::string_view name, Role role) const;
  // True when the name may be in that role, as far as is known.
  bool maybe(std::string_view name, Role role) const {
    return unsure || is(name, role) || is(name, Role::unsure);
  }
  std::vector<std::string> namesOf(Role role) const;
};

// Of all branches of the text; macros as they stand.
ShaderRoles rolesIn(std::string_view text);
// Of the variant that has these defines.
ShaderRoles rolesIn(std::string_view text, std::span<const Define> defines);

// "an input", "a function", …: the plainest of the roles that a name has; "" when it has none.
std::string_view nameOfRole(std::uint16_t roles);

}  // namespace weft::glsl
