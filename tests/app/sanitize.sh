#!/usr/bin/env bash
# Builds the weft command and the tests that need no GL with AddressSanitizer and UBSan (build/asan, or $WEFT_ASAN_BUILD), then runs
# the broken inputs and those tests with them. Leaks of the software GL driver are excepted (tests/gl/lsan.supp).
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build="${WEFT_ASAN_BUILD:-$top/build/asan}"
cmake -S "$top" -B "$build" -G Ninja -DWEFT_SANITIZE=address,undefined -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O1 -DCMAKE_C_FLAGS_DEBUG=-O1 >/dev/null
# The executables of the cpu tests are called like the tests; ctest gives no command for those not built yet.
targets=$(ctest --test-dir "$build" -L cpu --show-only=json-v1 | python3 -c "
import json, sys
for test in json.load(sys.stdin)['tests']:
    if test.get('command', ['$build/'])[0].startswith('$build/'): print(test['name'])")
start=$SECONDS
ninja -j2 -C "$build" app/weft $targets
echo "built in $((SECONDS - start)) s"
export ASAN_OPTIONS="detect_stack_use_after_return=1:strict_string_checks=1:check_initialization_order=1"
export UBSAN_OPTIONS="print_stacktrace=1:halt_on_error=1"
export LSAN_OPTIONS="suppressions=$top/tests/gl/lsan.supp:print_suppressions=0"
start=$SECONDS
python3 "$top/tests/app/broken_inputs.py" "$build/app/weft" --sanitized
ctest --test-dir "$build" -L cpu --output-on-failure
echo "run in $((SECONDS - start)) s"
