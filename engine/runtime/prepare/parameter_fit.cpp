#include "engine/runtime/prepare/parameter_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/runtime/prepare/missing_slot.h"
#include "engine/runtime/prepare/pass_errors.h"
#include "engine/runtime/prepare/shader_advice.h"
#include "engine/runtime/storage/block_writer.h"

namespace weft::runtime {

using base::Code;

namespace {

class ParameterCheck : PassErrors {
 public:
  ParameterCheck(const graph::FlatGraph& graph, const graph::PassSpec& spec, const gl::Variant& variant,
                 const ShaderWords& words, const std::string& shaders, base::Diagnostics& diagnostics)
      : PassErrors(spec.name, diagnostics),
        graph_(graph),
        spec_(spec),
        variant_(variant),
        reflection_(variant.program.reflection()),
        words_(words),
        shaders_(shaders) {}

  bool run() {
    const gl::Block* block = reflection_.findUniformBlock("Parameters");
    std::string misnamed;  // one that has the parameters
    for (const graph::UniformSpec& uniform : spec_.uniforms) {
      const gl::BlockMember* member = block ? block->find(uniform.name) : nullptr;
      if (!member) {
        if (words_.declaresParameter(uniform.name)) continue;
        parameterMissing_ = true;
        if (const std::string other = words_.blockOf(uniform.name);
            !other.empty() && !isSlotOf(graph_, spec_, other)) {
          if (misnamed.empty())
            sayBlockName(other, shaders_, fail(Code::undeclaredShaderInput, spec_.shaderPlace, ""));
          misnamed = other;
          continue;
        }
        sayMissingParameter(uniform, words_, shaders_, declaredNames(variant_),
                            fail(Code::parameterNotInShader, uniform.place, ""));
        continue;
      }
      std::string expected;
      if (!memberTakes(*member, uniform.value, expected)) {
        base::Diagnostic* const d =
            failOnce(graph_, Code::parameterTypeMismatch, uniform.place,
                     fmt::format("parameter '{}' does not fit the shader's {}", uniform.name,
                                 gl::glslTypeName(member->type)),
                     fmt::format("declare `{} {};` in the block, or give it {}", memberTypeFor(uniform.value),
                                 uniform.name, expected));
        if (!d) continue;
        d->expected = expected;
        d->found = graph::toText(uniform.value);
        continue;
      }
      checkWhole(uniform, *member);
    }
    checkUnset(block);
    return !any();
  }

 private:
  // Reports numbers in the graph, and sliders, that would lose their fraction in an integer member. What an expression computes is cut.
  void checkWhole(const graph::UniformSpec& uniform, const gl::BlockMember& member) {
    const auto shape = gl::shapeOf(member.type);
    if (!shape || (shape->base != GL_INT && shape->base != GL_UNSIGNED_INT)) return;
    const auto parameter = std::ranges::find(graph_.parameters, uniform.path, &graph::ParameterSpec::path);
    const bool slider = !uniform.path.empty() && parameter != graph_.parameters.end() &&
                        parameter->desc.type == graph::ParameterDesc::Type::number;
    bool whole = true;
    for (std::size_t i = 0; i < uniform.value.count; ++i)
      whole = whole && uniform.value.v[i] == std::floor(uniform.value.v[i]) &&
              (uniform.value.v[i] >= 0 || shape->base == GL_INT);
    if (!slider && (!uniform.constant || whole)) return;
    const std::string type = gl::glslTypeName(member.type);
    base::Diagnostic& d =
        fail(Code::parameterTypeMismatch, uniform.place,
             slider ? fmt::format("parameter '{}' is a float, and the shader's {} would lose its fraction",
                                  uniform.name, type)
                    : fmt::format("parameter '{}' does not fit the shader's {}", uniform.name, type));
    d.expected =
        fmt::format("{} for {}", shape->base == GL_INT ? "whole numbers" : "whole numbers from 0 on", type);
    d.found = graph::toText(uniform.value);
    d.hint = slider
                 ? fmt::format("give the parameter \"type\": \"int\", or declare `float {};` in the shader",
                               uniform.name)
                 : fmt::format("write whole numbers, or declare `{} {};` in the shader",
                               memberTypeFor(uniform.value), uniform.name);
  }

  // Reports members that the pass does not set: they would be 0, which mostly gives a black picture. Says nothing when a
  // parameter's name was not found, because one misspelling is one mistake.
  void checkUnset(const gl::Block* block) {
    if (!block || parameterMissing_) return;
    for (const gl::BlockMember& member : block->members) {
      if (std::ranges::find(spec_.uniforms, member.name, &graph::UniformSpec::name) != spec_.uniforms.end())
        continue;
      const std::string dimension = member.arraySize == 1 ? "" : fmt::format("[{}]", member.arraySize);
      sayUnset(member.name, gl::glslTypeName(member.type) + dimension, spec_, shaders_,
               fail(Code::undeclaredShaderInput, spec_.shaderPlace, ""));
    }
  }

  const graph::FlatGraph& graph_;
  const graph::PassSpec& spec_;
  const gl::Variant& variant_;
  const gl::Reflection& reflection_;
  const ShaderWords& words_;
  const std::string& shaders_;
  bool parameterMissing_ = false;
};

}  // namespace

bool checkParameters(const graph::FlatGraph& graph, const graph::PassSpec& spec, const gl::Variant& variant,
                     const ShaderWords& words, const std::string& shaders, base::Diagnostics& diagnostics) {
  return ParameterCheck(graph, spec, variant, words, shaders, diagnostics).run();
}

std::vector<std::string> declaredNames(const gl::Variant& variant) {
  std::vector<std::string> names;
  for (const gl::StageSource& stage : variant.stages)
    names.insert(names.end(), stage.source->declared.begin(), stage.source->declared.end());
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace weft::runtime
