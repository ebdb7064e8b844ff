#!/usr/bin/env bash
# Builds the weft command, the tests that need no GL, and some that do with AddressSanitizer and UBSan (build/asan, or
# $WEFT_ASAN_BUILD), then runs them: broken inputs, the cpu tests, the GL tests below, and sessions with the viewer in a virtual
# display. Leaks of the software GL drivers are excepted (tests/gl/lsan.supp).
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
. "$top/cmake/plain_path.sh"
build="${WEFT_ASAN_BUILD:-$top/build/asan}"
mkdir -p "$build"
build=$(plain_build_path "$top" "$(realpath "$build")")
top=$(plain_path "$top")
cmake -S "$top" -B "$build" -G Ninja -DWEFT_SANITIZE=address,undefined -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O1 -DCMAKE_C_FLAGS_DEBUG=-O1 >/dev/null
# What holds buffers, textures and threads over many frames, saves and environments; the others go through the same code.
gl_tests="gl_objects_test gl_program_test runtime_reload_test runtime_studio_test"
start=$SECONDS
ninja -j2 -C "$build" app/weft tests/app/weft_compare weft_cpu_tests $gl_tests
echo "built in $((SECONDS - start)) s"
export ASAN_OPTIONS="detect_stack_use_after_return=1:strict_string_checks=1:check_initialization_order=1"
export UBSAN_OPTIONS="print_stacktrace=1:halt_on_error=1"
export LSAN_OPTIONS="suppressions=$top/tests/gl/lsan.supp:print_suppressions=0"
start=$SECONDS
python3 "$top/tests/app/broken_inputs.py" "$build/app/weft" --sanitized
"$top/tests/ctest.sh" "$build" -L cpu
"$top/tests/ctest.sh" "$build" -R "^(${gl_tests// /|})(_binaries|_mesa_messages)?$"

# The viewer's driver stays loaded until leaks are looked for. A report of the sanitizers goes to a file: it fails the run,
# whatever became of the exit code.
cc -shared -fPIC -o "$build/keep_drivers.so" "$top/tests/app/keep_drivers.c"
cat >"$build/weft_kept" <<END
#!/bin/sh
LD_PRELOAD="$build/keep_drivers.so" exec "$build/app/weft" "\$@"
END
chmod +x "$build/weft_kept"
rm -f "$build"/sanitizer_report.*
export ASAN_OPTIONS="$ASAN_OPTIONS:verify_asan_link_order=0:log_path=$build/sanitizer_report"
export UBSAN_OPTIONS="$UBSAN_OPTIONS:log_path=$build/sanitizer_report"
skipped=
for session in view "view --window" view_session environments "environments --window"; do
  echo "viewer: $session"
  code=0
  read -ra words <<<"$session"
  python3 "$top/tests/app/${words[0]}.py" "$build/weft_kept" "$build/tests/app/weft_compare" "${words[@]:1}" || code=$?
  if compgen -G "$build/sanitizer_report.*" >/dev/null; then
    cat "$build"/sanitizer_report.*
    exit 1
  fi
  [ "$code" != 77 ] || skipped="$skipped, $session"
  [ "$code" = 0 ] || [ "$code" = 77 ] || exit "$code"
done
echo "run in $((SECONDS - start)) s"
if [ -n "$skipped" ]; then echo "skipped: the viewer's sessions ${skipped#, } (why is said above)"; fi
