#include "engine/gl/programs/needs.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "engine/glsl/roles.h"
#include "engine/glsl/tokens.h"

namespace weft::gl {

namespace {

struct Extent2 {
  std::uint32_t locations = 0, components = 0;
};

std::optional<Extent2> extentOfValue(std::string_view type) {
  for (std::uint32_t columns = 2; columns <= 4; ++columns) {
    const std::string square = "mat" + std::to_string(columns);
    if (type == square) return Extent2{columns, columns * columns};
    for (std::uint32_t rows = 2; rows <= 4; ++rows)
      if (type == square + "x" + std::to_string(rows)) return Extent2{columns, columns * rows};
    for (const char* vector : {"vec", "ivec", "uvec", "bvec"})
      if (type == vector + std::to_string(columns)) return Extent2{1, columns};
  }
  if (type == "float" || type == "int" || type == "uint" || type == "bool") return Extent2{1, 1};
  return std::nullopt;
}

using Words = std::span<const glsl::Token>;

bool hasWord(Words words, std::string_view what) {
  return std::ranges::any_of(words, [&](const glsl::Token& token) { return token.is(what); });
}

// The declarations of one stage, statement by statement.
class NeedsCount {
 public:
  NeedsCount(GLenum stage, const glsl::ShaderRoles& roles) : stage_(stage), roles_(roles) {}

  void read(const std::vector<glsl::Token>& tokens) {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
      if (tokens[i].is(";")) {
        takeStatement(Words(tokens).subspan(begin, i - begin));
        begin = i + 1;
      } else if (tokens[i].is("{")) {
        const std::size_t end = closing(tokens, i);
        const Words before = Words(tokens).subspan(begin, i - begin),
                    inside = Words(tokens).subspan(i + 1, end - i - 1);
        i = end;
        if (before.empty() || before.back().is(")") || before.back().is("=")) {
          if (before.empty() || !before.back().is("="))
            begin = i + 1;  // a function; an initializer goes on to its ';'
          continue;
        }
        std::size_t behind = end;
        while (behind < tokens.size() && !tokens[behind].is(";")) ++behind;
        takeBody(before, inside,
                 Words(tokens).subspan(std::min(end + 1, tokens.size()), behind - std::min(end + 1, behind)));
        i = behind;
        begin = i + 1;
      }
    }
  }

  StageNeeds needs;

 private:
  static std::size_t closing(const std::vector<glsl::Token>& tokens, std::size_t open) {
    int depth = 0;
    for (std::size_t i = open; i < tokens.size(); ++i) {
      depth += tokens[i].is("{") ? 1 : tokens[i].is("}") ? -1 : 0;
      if (depth == 0) return i;
    }
    return tokens.size() - 1;
  }

  bool isUsed(std::string_view name) const { return roles_.unsure || roles_.reachable.contains(name); }

  std::optional<std::int64_t> valueOf(Words words) const {
    return glsl::evaluateTokens(
        words,
        [&](std::string_view name) -> std::optional<std::int64_t> {
          const auto known = constants_.find(name);
          return known == constants_.end() ? std::nullopt : std::optional(known->second);
        },
        64);
  }

  // "[4][n]" from `at` on, which is moved behind it. An array without a size has one element.
  std::uint32_t elementsAt(Words words, std::size_t& at) const {
    std::uint32_t elements = 1;
    while (at < words.size() && words[at].is("[")) {
      std::size_t end = at + 1;
      for (int depth = 1; end < words.size(); ++end) {
        depth += words[end].is("[") ? 1 : words[end].is("]") ? -1 : 0;
        if (depth == 0) break;
      }
      const auto size = valueOf(words.subspan(at + 1, std::min(end, words.size()) - at - 1));
      if (size && *size > 0) elements *= static_cast<std::uint32_t>(*size);
      at = end + 1;
    }
    return elements;
  }

  // Calls f(type, name, elements) for each variable that the statement declares.
  template <class F>
  void forEachVariable(Words words, F&& f) const {
    std::size_t at = 0;
    while (at < words.size()) {  // qualifiers
      if (words[at].is("layout")) {
        while (at < words.size() && !words[at].is(")")) ++at;
        ++at;
      } else if (extentOf(words[at].text) || isOpaque(words[at].text)) {
        break;
      } else {
        ++at;
      }
    }
    if (at >= words.size()) return;
    const std::string_view type = words[at++].text;
    const std::uint32_t each = elementsAt(words, at);
    while (at < words.size()) {
      const std::string_view name = words[at++].text;
      f(type, name, each * elementsAt(words, at));
      while (at < words.size() && !words[at].is(",")) ++at;
      ++at;
    }
  }

  static bool isOpaque(std::string_view type) {
    return type.find("sampler") != std::string_view::npos || type.find("image") != std::string_view::npos;
  }
  std::optional<Extent2> extentOf(std::string_view type) const {
    const auto known = structs_.find(type);
    return known == structs_.end() ? extentOfValue(type) : std::optional(known->second);
  }

  Extent2 sumOf(Words members) const {
    Extent2 sum;
    for (std::size_t begin = 0; begin < members.size();) {
      std::size_t end = begin;
      while (end < members.size() && !members[end].is(";")) ++end;
      forEachVariable(members.subspan(begin, end - begin),
                      [&](std::string_view type, std::string_view, std::uint32_t elements) {
                        const Extent2 one = extentOf(type).value_or(Extent2{});
                        sum.locations += one.locations * elements;
                        sum.components += one.components * elements;
                      });
      begin = end + 1;
    }
    return sum;
  }

  void addVarying(Extent2 extent, std::uint32_t elements) {
    needs.locations += extent.locations * elements;
    needs.components += extent.components * elements;
  }

  // A struct, or a block with its members; `behind`: its instance.
  void takeBody(Words before, Words members, Words behind) {
    if (hasWord(before, "struct")) {
      structs_[before.back().text] = sumOf(members);
      return;
    }
    std::size_t at = 1;
    const std::uint32_t elements = behind.empty() ? 1 : elementsAt(behind, at);
    const bool used = behind.empty() ? std::ranges::any_of(members,
                                                           [&](const glsl::Token& word) {
                                                             return word.kind == glsl::TokenKind::word &&
                                                                    isUsed(word.text) && !extentOf(word.text);
                                                           })
                                     : isUsed(behind[0].text);
    if (!used) return;
    if (hasWord(before, "buffer"))
      needs.storageBlocks += elements;
    else if (!hasWord(before, "uniform") && isVarying(before))
      addVarying(sumOf(members), elements);
  }

  bool isVarying(Words words) const {
    return (stage_ == GL_FRAGMENT_SHADER && hasWord(words, "in")) ||
           (stage_ == GL_VERTEX_SHADER && hasWord(words, "out"));
  }

  void takeStatement(Words words) {
    const auto value = std::ranges::find_if(words, [](const glsl::Token& token) { return token.is("="); });
    const Words declared = words.first(static_cast<std::size_t>(value - words.begin()));
    if (declared.empty()) return;
    if (hasWord(declared, "const") && value != words.end()) {
      if (const auto known = valueOf(words.subspan(declared.size() + 1)))
        constants_[declared.back().text] = *known;
      return;
    }
    const bool uniform = hasWord(declared, "uniform"), varying = isVarying(declared);
    const bool output = stage_ == GL_FRAGMENT_SHADER && hasWord(declared, "out");
    if (!uniform && !varying && !output) return;
    forEachVariable(declared, [&](std::string_view type, std::string_view name, std::uint32_t elements) {
      if (!isUsed(name) || name.starts_with("gl_")) return;
      if (uniform && type.find("sampler") != std::string_view::npos) needs.samplers += elements;
      if (uniform && type.find("image") != std::string_view::npos) needs.images += elements;
      if (varying) addVarying(extentOf(type).value_or(Extent2{}), elements);
      if (output) needs.outputs += elements;
    });
  }

  GLenum stage_;
  const glsl::ShaderRoles& roles_;
  std::map<std::string_view, Extent2> structs_;
  std::map<std::string_view, std::int64_t> constants_;
};

}  // namespace

StageNeeds needsOf(const StageSource& stage, std::span<const glsl::Define> defines) {
  const glsl::ShaderRoles roles = glsl::rolesIn(stage.source->text, defines);
  const glsl::TokenList list = glsl::expandTokens(stage.source->text, defines, 1'000'000, 100);
  NeedsCount count(stage.stage, roles);
  count.read(list.tokens);
  return count.needs;
}

ProgramNeeds needsOf(std::span<const StageSource> stages, std::span<const glsl::Define> defines) {
  ProgramNeeds all;
  for (const StageSource& stage : stages) {
    const StageNeeds one = needsOf(stage, defines);
    if (stage.stage == GL_FRAGMENT_SHADER) {
      all.locations = one.locations;
      all.components = one.components;
    }
    all.samplers = std::max(all.samplers, one.samplers);
    all.together = std::max(all.together, one.images + one.storageBlocks + one.outputs);
  }
  return all;
}

ProgramNeeds limitsOfDevice() {
  const auto get = [](GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return static_cast<std::uint32_t>(std::max(0, value));
  };
  return {.locations = get(GL_MAX_VARYING_VECTORS),
          .components = get(GL_MAX_VARYING_COMPONENTS),
          .samplers = get(GL_MAX_TEXTURE_IMAGE_UNITS),
          .together = get(GL_MAX_COMBINED_SHADER_OUTPUT_RESOURCES)};
}

std::optional<Excess> excessOf(const ProgramNeeds& needs, const ProgramNeeds& limits) {
  constexpr const char* kFetch =
      "pass the number of the instance as one `flat` input, and read what belongs to it in the fragment "
      "shader";
  for (const Excess& each : {Excess{"locations of varyings", needs.locations, limits.locations, kFetch},
                             Excess{"components of varyings", needs.components, limits.components, kFetch},
                             Excess{"samplers in one stage", needs.samplers, limits.samplers,
                                    "put textures of one size into the layers of one"},
                             Excess{"images, storage blocks and outputs in one stage", needs.together,
                                    limits.together, "merge blocks, or write in two passes"}})
    if (each.needed > each.allowed) return each;
  return std::nullopt;
}

}  // namespace weft::gl
