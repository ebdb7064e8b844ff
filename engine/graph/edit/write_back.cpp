#include "engine/graph/edit/write_back.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>

#include "engine/base/files/file.h"
#include "engine/base/json/edit.h"
#include "engine/graph/edit/write_back_target.h"
#include "engine/graph/language/suffix.h"
#include "engine/graph/read/read.h"

namespace weft::graph {

namespace {

using base::Code;
using base::Diagnostics;

bool sameUniforms(const FlatGraph& a, const FlatGraph& b) {
  if (a.specs.size() != b.specs.size()) return false;
  for (std::size_t i = 0; i < a.specs.size(); ++i) {
    const PassSpec &x = a.specs[i], &y = b.specs[i];
    if (x.name != y.name || x.uniforms.size() != y.uniforms.size() || x.defines.size() != y.defines.size())
      return false;
    for (std::size_t u = 0; u < x.uniforms.size(); ++u)
      if (x.uniforms[u].name != y.uniforms[u].name || !(x.uniforms[u].value == y.uniforms[u].value))
        return false;
    for (std::size_t d = 0; d < x.defines.size(); ++d)
      if (x.defines[d].name != y.defines[d].name || x.defines[d].text != y.defines[d].text) return false;
  }
  return true;
}

bool sameResources(const FlatGraph& a, const FlatGraph& b) {
  if (a.resourceNames != b.resourceNames || a.uses.size() != b.uses.size()) return false;
  for (std::size_t r = 0; r < a.resources.size(); ++r) {
    const FlatResource &x = a.resources[r], &y = b.resources[r];
    if (x.format != y.format || x.bytes != y.bytes || x.width != y.width || x.height != y.height ||
        x.mips != y.mips)
      return false;
  }
  return true;
}

// Paths are the same when they lead to one file.
bool sameValue(const ParameterDesc& desc, const Value& x, const Value& y) {
  if (desc.type != ParameterDesc::Type::file || x.symbol.empty() || y.symbol.empty()) return x == y;
  std::error_code ignored;
  const auto whole = [&](const std::string& path) {
    return std::filesystem::absolute(path, ignored).lexically_normal();
  };
  return whole(x.symbol) == whole(y.symbol);
}

bool sameParameters(const FlatGraph& a, const FlatGraph& b) {
  const auto same = [](const ParameterSpec& x, const ParameterSpec& y) {
    return x.path == y.path && sameValue(x.desc, x.value, y.value) && x.desc.type == y.desc.type;
  };
  return std::ranges::equal(a.parameters, b.parameters, same);
}

// Passes that run, and those that are disabled, whatever disables them.
bool samePasses(const FlatGraph& a, const FlatGraph& b) {
  const auto names = [](const FlatGraph& graph) {
    std::vector<std::string> all;
    for (const DisabledPass& pass : graph.disabled) all.push_back(pass.name);
    std::ranges::sort(all);
    return all;
  };
  return a.passNames == b.passNames && names(a) == names(b);
}

class Planner {
 public:
  Planner(const GraphDesc& desc, std::span<const std::string> presets, const Registry& registry,
          const Settings& settings, Diagnostics& diagnostics)
      : desc_(desc),
        presets_(presets),
        registry_(registry),
        diagnostics_(diagnostics),
        now_(&desc),
        texts_(desc.texts) {
    out_.rest = settings;
  }

  std::optional<WriteBack> run() {
    wanted_ = expand(desc_);
    if (!wanted_) return fail("the graph with these changes", "nothing: it is not valid");
    for (const ParameterSpec& parameter : wanted_->parameters) paths_.push_back(parameter.path);
    for (const std::string& path : tweaked())
      if (!writeParameter(path)) return std::nullopt;
    const std::vector<Disable> disables = out_.rest.disables;
    for (const Disable& disable : disables)
      if (!writePass(disable.name)) return std::nullopt;
    const auto made = expand(*now_);
    if (!made || !sameParameters(*made, *wanted_) || !samePasses(*made, *wanted_) ||
        !sameUniforms(*made, *wanted_) || !sameResources(*made, *wanted_))
      return fail("the changes together", "the edited files would give another graph");
    for (const auto& [path, text] : texts_)
      if (const auto before = desc_.texts.find(path); *before->second != *text)
        out_.files.push_back({path, *before->second, *text});
    return std::move(out_);
  }

 private:
  std::nullopt_t fail(const std::string& what, const std::string& found, const base::Place& place = {}) {
    auto& d = diagnostics_.error(Code::cannotWriteBack, place,
                                 fmt::format("{} cannot be written into the files", what));
    d.found = found;
    d.hint = "write it by hand, or take the change back";
    return std::nullopt;
  }

  std::shared_ptr<const FlatGraph> expand(const GraphDesc& desc) const {
    Diagnostics said;
    auto graph = expandGraph(desc, registry_, out_.rest, said);
    return said.hasErrors() ? nullptr : graph;
  }

  // Full names behind the settings, each once.
  std::vector<std::string> tweaked() const {
    std::vector<std::string> paths;
    for (const Setting& set : out_.rest.sets)
      for (const std::size_t i : suffixMatches(paths_, set.name))
        if (std::ranges::find(paths, paths_[i]) == paths.end()) paths.push_back(paths_[i]);
    return paths;
  }

  const ParameterSpec& wantedParameter(const std::string& path) const {
    return *std::ranges::find(wanted_->parameters, path, &ParameterSpec::path);
  }

  bool writeParameter(const std::string& path) {
    std::erase_if(out_.rest.sets, [&](const auto& set) {
      const auto found = suffixMatches(paths_, set.name);
      return found.size() == 1 && paths_[found[0]] == path;
    });
    const ParameterSpec& wanted = wantedParameter(path);
    const auto before = expand(*now_);
    if (!before)
      return fail(fmt::format("parameter '{}'", path), "what is left without it is not valid"), false;
    const auto here = std::ranges::find(before->parameters, path, &ParameterSpec::path);
    if (here == before->parameters.end())
      return fail(fmt::format("parameter '{}'", path), "it is not in the files"), false;
    if (sameValue(wanted.desc, here->value, wanted.value)) return true;  // the files say so already
    const auto good = [&](const FlatGraph& made) {
      return std::ranges::equal(made.parameters, before->parameters,
                                [&](const ParameterSpec& x, const ParameterSpec& y) {
                                  return x.path == y.path && x.desc.type == y.desc.type &&
                                         sameValue(x.desc, x.value, x.path == path ? wanted.value : y.value);
                                });
    };
    for (const TextEdit& edit : editsOfParameter(*now_, presets_, texts_, wanted, paths_))
      if (take(edit, good)) {
        out_.parameters.push_back(path);
        return true;
      }
    fail(fmt::format("parameter '{}'", path), toText(wanted.value), wanted.desc.place);
    return false;
  }

  bool writePass(const std::string& name) {
    const std::vector<std::string> declared = declaredPasses(*now_);
    const std::vector<std::size_t> found = suffixMatches(declared, name);
    if (found.empty()) return true;  // an instance
    const std::string& pass = declared[found[0]];
    const auto before = expand(*now_);
    if (!before) return fail(fmt::format("pass '{}'", pass), "what is left without it is not valid"), false;
    std::erase_if(out_.rest.disables, [&](const Disable& each) { return each.name == name; });
    const auto good = [&](const FlatGraph& made) {
      return samePasses(made, *before) && sameParameters(made, *before);
    };
    for (const TextEdit& edit : editsOfPass(*now_, presets_, texts_, pass))
      if (take(edit, good)) {
        out_.passes.push_back(pass);
        return true;
      }
    fail(fmt::format("\"enabled\": false of pass '{}'", pass), "no edit gives the graph that runs");
    return false;
  }

  bool take(const TextEdit& edit, const std::function<bool(const FlatGraph&)>& good) {
    FileTexts texts = texts_;
    texts[edit.path] = std::make_shared<const std::string>(edit.text);
    Diagnostics said;
    auto desc = readGraph(desc_.path, presets_, texts, said);
    if (!desc || said.hasErrors()) return false;
    const auto made = expand(*desc);
    if (!made || !good(*made)) return false;
    texts_ = std::move(texts);
    kept_ = std::move(desc);
    now_ = kept_.get();
    return true;
  }

  const GraphDesc& desc_;
  std::span<const std::string> presets_;
  const Registry& registry_;
  Diagnostics& diagnostics_;
  std::shared_ptr<const FlatGraph> wanted_;
  std::vector<std::string> paths_;
  std::shared_ptr<const GraphDesc> kept_;
  const GraphDesc* now_;  // with the edits so far
  FileTexts texts_;
  WriteBack out_;
};

}  // namespace

std::optional<WriteBack> planWriteBack(const GraphDesc& desc, std::span<const std::string> presets,
                                       const Registry& registry, const Settings& settings,
                                       base::Diagnostics& diagnostics) {
  return Planner(desc, presets, registry, settings, diagnostics).run();
}

bool saveWriteBack(const WriteBack& plan, base::Diagnostics& diagnostics) {
  bool same = true;
  for (const WriteBack::File& file : plan.files) {
    const auto now = base::readFile(file.path, diagnostics);
    if (now && *now == file.before) continue;
    same = false;
    if (!now) continue;
    auto& d = diagnostics.error(Code::fileChanged, {std::make_shared<const std::string>(file.path), 0, 0},
                                fmt::format("'{}' has changed since it was read", file.path));
    d.hint = "wait until the viewer shows the file as it is, then write again";
  }
  if (!same) return false;
  for (std::size_t i = 0; i < plan.files.size(); ++i) {
    if (base::writeFile(plan.files[i].path, plan.files[i].after, diagnostics)) continue;
    for (std::size_t done = 0; done < i; ++done)
      base::writeFile(plan.files[done].path, plan.files[done].before, diagnostics);
    return false;
  }
  return true;
}

}  // namespace weft::graph
