#!/usr/bin/env bash
# ctest with one line more at its end, which names what was skipped and why. The exit code is ctest's.
# Usage: ctest.sh BUILD_DIR [ARGUMENTS OF CTEST...]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$1
shift
results=$(mktemp)
trap 'rm -f "$results"' EXIT
code=0
ctest --test-dir "$build" --output-on-failure --output-junit "$results" "$@" || code=$?
python3 "$here/skipped.py" "$results" || true
exit "$code"
