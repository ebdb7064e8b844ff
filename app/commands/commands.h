// One function per command; each returns the exit code: 0 done, 1 something is wrong with the input, 2 usage, 3 the
// machine cannot (no context).
#pragma once

#include "app/session/options.h"

namespace weft::app {

int runRender(const Options& options);
int runDump(const Options& options);
int runCheck(const Options& options);
int runExplain(const Options& options);
int runExpand(const Options& options);
int runDiff(const Options& options);  // 0: no difference, 1: some, 2: a graph cannot be compiled
int runTest(
    const Options& options);  // 0: every case as its golden, 1: some differ, 2: some cannot be compared
int runBisect(const Options& options);  // 0: no pass differs, 1: one does, 2: a graph cannot be rendered
int runAblate(const Options& options);
int runFuzz(
    const Options& options);  // 0: every picture is the same, 1: one differs, 2: it cannot be rendered
int runNew(const Options& options);
int runParams(const Options& options);
int runPresets(const Options& options);
int runDot(const Options& options);
int runPlan(const Options& options);
int runBench(const Options& options);
int runFormat(const Options& options);
int runImport(const Options& options);
int runSchema(const Options& options);
int runTypes(const Options& options);

}  // namespace weft::app
