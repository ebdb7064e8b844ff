// The steps of compile(), one file each, over one Plan and one CompileScratch. Internal to engine/graph.
#pragma once

#include "engine/graph/compile_scratch.h"
#include "engine/graph/plan.h"

namespace weft::graph::steps {

// flags, cellBase
void indexCells(const FlatGraph& graph, CompileScratch& scratch);
// previous, lists, passOf, lastWriter: which use made the version that each use sees
void linkVersions(const FlatGraph& graph, CompileScratch& scratch);
// livePass, Plan::attached: from the roots along the links
void findLive(const FlatGraph& graph, Plan& plan, CompileScratch& scratch);
// Plan::steps, stepOf: declared order of the live passes, or a random legal one
void orderPasses(const FlatGraph& graph, std::uint64_t seed, Plan& plan, const CompileScratch& scratch);
// jobs
void findJobs(const FlatGraph& graph, Plan& plan);
// firstStep, lastStep, persistent, clears, outputLive, bytesBound, and births
void findLifetimes(const FlatGraph& graph, Plan& plan, CompileScratch& scratch);
// storages, storageOf, bufferOffsetOf, arenaBytes, bytes
void placeStorage(const FlatGraph& graph, bool share, Plan& plan, CompileScratch& scratch);
// barrier masks
void placeBarriers(const FlatGraph& graph, Plan& plan, CompileScratch& scratch);

}  // namespace weft::graph::steps
