#include "engine/runtime/prepare/shader_words.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/chars.h"
#include "engine/base/words/glsl_words.h"

namespace weft::runtime {

using glsl::Role;
using glsl::ShaderRoles;

namespace {

Role roleFor(graph::Kind kind) {
  switch (kind) {
    case graph::Kind::uniform:
      return Role::uniform_block;
    case graph::Kind::storage:
      return Role::storage_block;
    case graph::Kind::color:
    case graph::Kind::depth:
      return Role::output;
    default:
      return Role::opaque;
  }
}

}  // namespace

const ShaderRoles& RoleCache::ofText(const glsl::ShaderSource& source) {
  const auto [known, fresh] = known_.try_emplace(fmt::format("{:016x} {}", source.hash, source.text.size()));
  if (!fresh) return known->second;
  bytes_ += source.text.size();
  return known->second = glsl::rolesIn(source.text);
}

const ShaderRoles& RoleCache::ofVariant(const glsl::ShaderSource& source,
                                        std::span<const glsl::Define> defines) {
  std::string key = fmt::format("{:016x} {}", source.hash, source.text.size());
  for (const glsl::Define& define : defines) key += fmt::format("|{}={}", define.name, define.value);
  const auto [known, fresh] = known_.try_emplace(key + "|");
  if (!fresh) return known->second;
  bytes_ += source.text.size() + key.size();
  return known->second = glsl::rolesIn(source.text, defines);
}

void RoleCache::clear() {
  known_.clear();
  bytes_ = 0;
}

const ShaderRoles& ShaderWords::variantOf(const gl::StageSource& stage) const {
  const ShaderRoles*& known = variants_[static_cast<std::size_t>(&stage - stages_.data())];
  if (!known) known = &cache_.ofVariant(*stage.source, defines_);
  return *known;
}

bool ShaderWords::maybe(std::string_view name, Role role, bool lastOnly) const {
  for (const gl::StageSource& stage : stages_) {
    if ((lastOnly && &stage != &stages_.back()) || !stage.source->mentions(name)) continue;
    if (cache_.ofText(*stage.source).maybe(name, role)) return true;
  }
  // A macro may paste the name together, or declare it in this variant only.
  for (const gl::StageSource& stage : stages_)
    if ((!lastOnly || &stage == &stages_.back()) && variantOf(stage).maybe(name, role)) return true;
  return false;
}

bool ShaderWords::declares(std::string_view name, graph::Kind kind) const {
  if (maybe(name, roleFor(kind), kind == graph::Kind::color)) return true;
  // A slot may have the instance name of a block; W187 then says it better, from the side of the shader.
  const bool block = kind == graph::Kind::uniform || kind == graph::Kind::storage;
  return block && maybe(name, Role::instance, false);
}

bool ShaderWords::declaresParameter(std::string_view name) const {
  // A uniform outside a block has a message of its own.
  return maybe(name, Role::parameter, false) || maybe(name, Role::opaque, false);
}

bool ShaderWords::hasOutput(std::string_view name) const {
  return !stages_.empty() && stages_.back().source->mentions(name) &&
         variantOf(stages_.back()).is(name, Role::output);
}

bool ShaderWords::mayWrite(std::string_view name) const {
  if (stages_.empty()) return true;
  const ShaderRoles& roles = variantOf(stages_.back());
  return roles.unsure || roles.reachable.contains(name);
}

std::string ShaderWords::whatIs(std::string_view name) const {
  std::uint16_t roles = 0;
  bool mentioned = false;
  // The outputs of a vertex shader are the inputs of what follows it.
  for (auto stage = stages_.rbegin(); stage != stages_.rend() && roles == 0; ++stage) {
    if (!stage->source->mentions(name)) continue;
    mentioned = true;
    const ShaderRoles& all = cache_.ofText(*stage->source);
    if (const auto found = all.roles.find(name); found != all.roles.end()) roles = found->second;
  }
  if (const std::string_view role = glsl::nameOfRole(roles); !role.empty()) return std::string(role);
  if (base::isGlslFunction(name)) return "a built-in function";
  return mentioned ? "a word that declares nothing" : "";
}

std::vector<std::string> ShaderWords::namesFor(graph::Kind kind) const {
  std::vector<std::string> names;
  for (const gl::StageSource& stage : stages_) {
    if (kind == graph::Kind::color && &stage != &stages_.back()) continue;
    for (std::string& name : cache_.ofText(*stage.source).namesOf(roleFor(kind)))
      if (std::ranges::find(names, name) == names.end()) names.push_back(std::move(name));
  }
  return names;
}

std::vector<std::string> ShaderWords::imageFormatsOf(std::string_view name) const {
  for (const gl::StageSource& stage : stages_) {
    if (!stage.source->mentions(name)) continue;
    const ShaderRoles& roles = variantOf(stage);
    if (roles.unsure) continue;
    if (const auto found = roles.imageFormats.find(name); found != roles.imageFormats.end())
      return found->second;
  }
  return {};
}

std::string ShaderWords::blockOf(std::string_view name) const {
  std::string block;
  for (const gl::StageSource& stage : stages_) {
    const ShaderRoles& all = cache_.ofText(*stage.source);
    if (all.is("Parameters", Role::uniform_block)) return {};
    if (const auto found = all.blockOf.find(name); found != all.blockOf.end()) block = found->second;
  }
  return block == "View" || block == "Slice" ? std::string() : block;
}

std::vector<ShaderRoles::Member> ShaderWords::parameters() const {
  for (const gl::StageSource& stage : stages_) {
    if (!stage.source->mentions("Parameters")) continue;
    const ShaderRoles& roles = variantOf(stage);
    if (!roles.unsure && std::ranges::any_of(roles.parameters, [&](const ShaderRoles::Member& member) {
          return roles.reachable.contains(member.name);
        }))
      return roles.parameters;
  }
  return {};
}

namespace {

// Whether the block View alone gives the name: nothing else declares it (a parameter, a local variable), and it is no member of anything.
bool isOfViewAlone(std::string_view text, std::string_view name) {
  int declared = 0;
  for (std::size_t at = text.find(name); at != text.npos; at = text.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if ((at > 0 && base::isIdentChar(text[at - 1])) || (end < text.size() && base::isIdentChar(text[end])))
      continue;
    std::string_view before = text.substr(0, at);
    while (!before.empty() && base::isSpace(before.back())) before.remove_suffix(1);
    if (before.ends_with('.')) return false;
    for (const std::string_view type : {"float", "int", "uint", "double", "vec2", "vec3", "vec4"})
      if (before.ends_with(type)) {
        ++declared;
        break;  // "uint" ends with "int", too
      }
  }
  return declared <= 1;
}

}  // namespace

bool ShaderWords::usesOfView(std::string_view member) const {
  return std::ranges::any_of(stages_, [&](const gl::StageSource& stage) {
    if (!stage.source->mentions("View") || !stage.source->mentions(member)) return false;
    const ShaderRoles& all = cache_.ofText(*stage.source);
    const auto block = all.blockOf.find(member);
    return block != all.blockOf.end() && block->second == "View" &&
           variantOf(stage).reachable.contains(member) && isOfViewAlone(stage.source->text, member);
  });
}

bool ShaderWords::uses(std::string_view name) const {
  return std::ranges::any_of(stages_, [&](const gl::StageSource& stage) {
    return stage.source->mentions(name) && variantOf(stage).reachable.contains(name);
  });
}

}  // namespace weft::runtime
