// Expands inline graphs for tests and finds passes, slots and uses of the result by name.
#pragma once

#include <doctest/doctest.h>

#include <initializer_list>
#include <memory>
#include <string>
#include <utility>

#include "engine/graph/expand/expand.h"
#include "engine/graph/read/read.h"
#include "tests/graph/test_folder.h"
#include "tests/graph/test_registry.h"

namespace weft::graph::test {

struct Expanded {
  std::shared_ptr<const FlatGraph> graph;
  text::Diagnostics diagnostics;

  // Without W089: tests share resources, which not each of them uses. unused_test.cpp and unnamed_test.cpp look for it.
  std::string text() const {
    text::Diagnostics others;
    for (const text::Diagnostic& d : diagnostics.items())
      if (d.code != text::Code::unusedDeclaration) others.add(d);
    return others.text();
  }
  bool has(text::Code code) const { return diagnostics.contains(code); }
  // The first diagnostic of a code; fails the test when there is none.
  const text::Diagnostic& of(text::Code code) const {
    for (const text::Diagnostic& d : diagnostics.items())
      if (d.code == code) return d;
    INFO(text());
    REQUIRE_MESSAGE(false, "expected ", text::nameOf(code));
    return diagnostics.items().front();
  }

  std::uint32_t pass(std::string_view name) const {
    REQUIRE_MESSAGE(graph, text());
    for (std::uint32_t i = 0; i < graph->passNames.size(); ++i)
      if (graph->passNames[i] == name) return i;
    return kNone;
  }
  const PassSpec& spec(std::string_view name) const {
    const std::uint32_t i = pass(name);
    REQUIRE_MESSAGE(i != kNone, "no pass ", std::string(name));
    return graph->specs[i];
  }
  const SlotSpec& slot(std::string_view passName, std::string_view name) const {
    const PassSpec& s = spec(passName);
    for (std::uint32_t i = s.firstSlot; i < s.firstSlot + s.slotCount; ++i)
      if (graph->slots[i].name == name) return graph->slots[i];
    REQUIRE_MESSAGE(false, "no slot ", std::string(name));
    return graph->slots[0];
  }
  const FlatUse& use(std::string_view passName, std::string_view name, std::uint32_t element = 0) const {
    const SlotSpec& s = slot(passName, name);
    REQUIRE_MESSAGE(s.useCount > element, "slot ", std::string(name), " of ", std::string(passName),
                    " is not connected");
    return graph->uses[s.firstUse + element];
  }
  // "hdr#2 mip 1" with "@-1", the levels only when not all: enough to compare uses by eye.
  std::string useText(std::string_view passName, std::string_view name, std::uint32_t element = 0) const {
    const SlotSpec& s = slot(passName, name);
    if (s.useCount == 0) return "-";
    const FlatUse& u = use(passName, name, element);
    const FlatResource& r = graph->resources[u.resource];
    std::string text = graph->resourceNames[u.resource];
    if (u.mips != r.mips)
      text += " mip " + std::to_string(u.mip) + (u.mips > 1 ? ".." + std::to_string(u.mip + u.mips - 1) : "");
    if (u.layers != r.layers)
      text += " layer " + std::to_string(u.layer) +
              (u.layers > 1 ? ".." + std::to_string(u.layer + u.layers - 1) : "");
    if (u.history > 0) text += " @-" + std::to_string(u.history);
    return text;
  }
  const FlatResource& resource(std::string_view name) const {
    REQUIRE_MESSAGE(graph, text());
    for (std::size_t i = 0; i < graph->resourceNames.size(); ++i)
      if (graph->resourceNames[i] == name) return graph->resources[i];
    REQUIRE_MESSAGE(false, "no resource ", std::string(name));
    return graph->resources[0];
  }
  const UniformSpec& uniform(std::string_view passName, std::string_view name) const {
    const PassSpec& s = spec(passName);
    for (const UniformSpec& u : s.uniforms)
      if (u.name == name) return u;
    REQUIRE_MESSAGE(false, "no uniform ", std::string(name));
    return s.uniforms[0];
  }
  std::string define(std::string_view passName, std::string_view name) const {
    for (const DefineSpec& d : spec(passName).defines)
      if (d.name == name) return d.text;
    return "not defined";
  }
  std::string names() const {
    REQUIRE_MESSAGE(graph, text());
    std::string all;
    for (const std::string& name : graph->passNames) all += (all.empty() ? "" : " ") + name;
    return all;
  }
};

inline Expanded expandText(std::string_view json, const Settings& settings = {},
                           const Registry& registry = testRegistry()) {
  Expanded result;
  const auto desc = readGraphText(json, "test.json", result.diagnostics);
  REQUIRE_MESSAGE(desc, result.text());
  result.graph = expandGraph(*desc, registry, settings, result.diagnostics);
  return result;
}

// Files that include each other, by their names; the last is the graph. `folder`: one test file's own.
inline Expanded expandFiles(const std::string& folder,
                            std::initializer_list<std::pair<const char*, std::string>> files) {
  const TestFolder kept(folder);
  std::string path;
  for (const auto& [name, text] : files) path = kept.write(name, text);
  Expanded result;
  const auto desc = readGraph(path, result.diagnostics);
  REQUIRE_MESSAGE(desc, result.text());
  result.graph = expandGraph(*desc, testRegistry(), {}, result.diagnostics);
  return result;
}

inline Settings with(std::vector<Setting> sets, std::vector<Disable> disables = {}) {
  Settings settings;
  settings.sets = std::move(sets);
  settings.disables = std::move(disables);
  return settings;
}

}  // namespace weft::graph::test
