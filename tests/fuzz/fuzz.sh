#!/usr/bin/env bash
# Builds the fuzz targets with clang under AddressSanitizer and UBSan (build/fuzz, or $WEFT_FUZZ_BUILD), and runs them: fuzz.py, whose
# arguments these are. The tests that write files to begin with are built there, too.
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$(realpath -m "${WEFT_FUZZ_BUILD:-$top/build/fuzz}")
kept="$build/kept"
mkdir -p "$kept"
CC=clang-16 CXX=clang++-16 cmake -S "$top" -B "$build" -G Ninja -DCMAKE_UNITY_BUILD=ON -DWEFT_TESTS=ON -DWEFT_SANITIZE=address,undefined,fuzzer-no-link -DCMAKE_BUILD_TYPE=Debug \
  -DCMAKE_CXX_FLAGS_DEBUG=-O1 -DCMAKE_C_FLAGS_DEBUG=-O1 >/dev/null
ninja -j2 -C "$build" weft_fuzz assets_test
cd "$top"
WEFT_KEEP_FILES="$kept" "$build/tests/assets/assets_test" >/dev/null
exec python3 tests/fuzz/fuzz.py "$build" "$kept" "$@"
