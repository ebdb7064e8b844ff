// Hand-made FlatGraphs for compiler tests: resources first, then passes with their uses in a chain of calls.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "engine/graph/compile/compile.h"
#include "engine/graph/plan.h"
#include "engine/graph/subresource.h"
#include "engine/graph/versions/versions.h"

namespace weft::graph {

struct FlatBuilder {
  FlatGraph graph;

  std::uint32_t add(FlatResource r, const std::string& name) {
    graph.resources.push_back(r);
    graph.resourceNames.push_back(name);
    return static_cast<std::uint32_t>(graph.resources.size() - 1);
  }
  std::uint32_t texture(const std::string& name, Format format = Format::rgba8, std::uint32_t size = 64,
                        std::uint16_t mips = 1, std::uint16_t layers = 1) {
    FlatResource r;
    r.format = format;
    r.width = r.height = size;
    r.mips = mips;
    r.layers = layers;
    if (layers > 1) r.target = Target::texture_2d_array;
    for (std::uint32_t mip = 0; mip < mips; ++mip)
      r.bytes += std::uint64_t{std::max(1u, size >> mip)} * std::max(1u, size >> mip) * layers *
                 infoOf(format).bytes;
    return add(r, name);
  }
  std::uint32_t buffer(const std::string& name, std::uint64_t bytes) {
    FlatResource r;
    r.kind = ResourceKind::buffer;
    r.bytes = bytes;
    return add(r, name);
  }
  FlatResource& resource(std::uint32_t index) { return graph.resources[index]; }

  FlatBuilder& pass(const std::string& name, Cadence cadence = Cadence::always) {
    FlatPass p;
    p.firstUse = static_cast<std::uint32_t>(graph.uses.size());
    p.cadence = cadence;
    graph.passes.push_back(p);
    graph.passNames.push_back(name);
    return *this;
  }
  FlatBuilder& sideEffect() {
    graph.passes.back().sideEffect = true;
    return *this;
  }
  FlatBuilder& use(const FlatUse& u) {
    graph.uses.push_back(u);
    ++graph.passes.back().useCount;
    return *this;
  }
  FlatUse whole(std::uint32_t r, Kind kind, Access access) const {
    return wholeUse(r, graph.resources[r], kind, access);
  }
  FlatBuilder& read(std::uint32_t r, Kind kind = Kind::sampled, std::uint8_t history = 0) {
    FlatUse u = whole(r, kind, Access::read);
    u.history = history;
    return use(u);
  }
  FlatBuilder& write(std::uint32_t r, Kind kind = Kind::color) { return use(whole(r, kind, Access::write)); }
  FlatBuilder& modify(std::uint32_t r, Kind kind = Kind::color) {
    return use(whole(r, kind, Access::modify));
  }
  FlatBuilder& mip(std::uint32_t r, std::uint16_t level, Kind kind, Access access) {
    FlatUse u = whole(r, kind, access);
    u.mip = level;
    u.mips = 1;
    return use(u);
  }
  FlatBuilder& layer(std::uint32_t r, std::uint16_t index, Kind kind, Access access) {
    FlatUse u = whole(r, kind, access);
    u.layer = index;
    u.layers = 1;
    return use(u);
  }
  FlatBuilder& keep() {
    graph.uses.back().keep = true;
    return *this;
  }
  FlatBuilder& present(std::uint32_t r) {
    graph.present = whole(r, Kind::copy, Access::read);
    return *this;
  }
  FlatBuilder& output(std::uint32_t r) {
    graph.outputs.push_back(whole(r, Kind::copy, Access::read));
    graph.outputNames.push_back(graph.resourceNames[r]);
    return *this;
  }
  std::shared_ptr<const FlatGraph> linked() const {
    FlatGraph copy = graph;
    linkVersions(copy);
    return std::make_shared<const FlatGraph>(std::move(copy));
  }
  Plan compiled(CompileOptions options = {}) const { return compile(linked(), options); }
};

inline FlatBuilder emptyGraph() {
  FlatBuilder b;
  b.graph.present.resource = kNone;
  return b;
}

// Names of the passes that run, in order: "a b c".
inline std::string orderOf(const Plan& plan) {
  std::string text;
  for (const Step& step : plan.steps) text += (text.empty() ? "" : " ") + plan.graph->passNames[step.pass];
  return text;
}

}  // namespace weft::graph
