// What the names in the texts of a pass's shaders are (engine/glsl/roles.h), as the checks of slots and parameters ask
// for it: whether the text declares what a slot needs, which the linker may have dropped, and what carries the name
// instead. Keeps what it scanned, by text and defines. Does not: need a context, or report.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/gl/programs/program.h"
#include "engine/glsl/roles.h"
#include "engine/glsl/source.h"
#include "engine/graph/flat_graph.h"

namespace weft::runtime {

// What was scanned, kept by the content of the text, so that a changed file is another text. References stay valid until
// clear() or makeRoom().
class RoleCache {
 public:
  const glsl::ShaderRoles& ofText(const glsl::ShaderSource& source);
  const glsl::ShaderRoles& ofVariant(const glsl::ShaderSource& source, std::span<const glsl::Define> defines);
  // The bytes of all texts that were scanned. A text counts once, and once more for each of its variants.
  std::size_t textBytes() const { return bytes_; }
  void clear();
  // Forgets everything when more than `most` bytes of texts were scanned.
  void makeRoom(std::size_t most = std::size_t{16} << 20) {
    if (bytes_ > most) clear();
  }

 private:
  std::map<std::string, glsl::ShaderRoles> known_;
  std::size_t bytes_ = 0;
};

class ShaderWords {
 public:
  // All must outlive this. The last stage is the one that has outputs.
  ShaderWords(std::span<const gl::StageSource> stages, std::span<const glsl::Define> defines,
              RoleCache& cache)
      : stages_(stages), defines_(defines), cache_(cache), variants_(stages.size()) {}

  // Whether the text declares the name as what a slot of this kind needs, in any branch, or may do so.
  bool declares(std::string_view name, graph::Kind kind) const;
  // The same for a parameter: a member of the block Parameters.
  bool declaresParameter(std::string_view name) const;
  // Whether the fragment shader of this variant has an output of that name.
  bool hasOutput(std::string_view name) const;
  // Whether main() of the fragment shader reaches the output of that name, or may do so.
  bool mayWrite(std::string_view name) const;
  // "an input", "a built-in function", "a word that declares nothing"; "" when no text has the name.
  std::string whatIs(std::string_view name) const;
  // The names that a slot of this kind could have.
  std::vector<std::string> namesFor(graph::Kind kind) const;
  // The words of the layout of an image, in this variant.
  std::vector<std::string> imageFormatsOf(std::string_view name) const;
  // The uniform block that has the name as a member, where no block is called Parameters; "" for the engine's own blocks.
  std::string blockOf(std::string_view name) const;
  // The members of the block Parameters, also those that are not read; empty when this variant reads no member of it.
  std::vector<glsl::ShaderRoles::Member> parameters() const;
  // Whether main() of some stage reaches the name.
  bool uses(std::string_view name) const;
  // The same, of a member of the block View.
  bool usesOfView(std::string_view member) const;

 private:
  bool maybe(std::string_view name, glsl::Role role, bool lastOnly) const;
  // The roles in this variant. Looks them up once for each stage, because a pass may have many slots and many defines.
  const glsl::ShaderRoles& variantOf(const gl::StageSource& stage) const;

  const std::span<const gl::StageSource> stages_;
  const std::span<const glsl::Define> defines_;
  RoleCache& cache_;
  mutable std::vector<const glsl::ShaderRoles*> variants_;  // by stage; null: not asked for yet
};

}  // namespace weft::runtime
