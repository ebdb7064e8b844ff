#!/usr/bin/env bash
# ctest with one line more at its end, which names what was skipped and why. The exit code is ctest's.
# Usage: ctest.sh BUILD_DIR [ARGUMENTS OF CTEST...]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$1
shift
results=$(mktemp)
trap 'rm -f "$results"' EXIT
# As ./run sets it.
export GLIBC_TUNABLES=${GLIBC_TUNABLES-glibc.malloc.hugetlb=1:glibc.malloc.mmap_threshold=33554432:glibc.malloc.trim_threshold=268435456:glibc.malloc.top_pad=67108864}
# Most tests translate more than they draw: without its optimizations llvmpipe makes the same pictures, in up to a third less time. Theory tests keep them.
export GALLIVM_PERF=${GALLIVM_PERF-nopt}
# The interpreter itself: where python3 is a script that looks for one, a test that starts many waits for it.
interpreter=$(python3 -c 'import os, sys; print(os.path.dirname(sys.executable))' || true)
[ -z "$interpreter" ] || export PATH="$interpreter:$PATH"
code=0
ctest --test-dir "$build" --output-on-failure --output-junit "$results" "$@" || code=$?
python3 "$here/skipped.py" "$results" || true
exit "$code"
