#!/usr/bin/env bash
# Builds the weft command, the tests that need no GL, and some that do with AddressSanitizer and UBSan (build/asan, or
# $WEFT_ASAN_BUILD), then runs them: the cpu tests, the GL tests below, the fuzz targets, broken and hostile inputs, sequences and checkpoints, and sessions with
# the viewer in a virtual display. Leaks of the software GL drivers are excepted (tests/gl/lsan.supp).
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
build=$(realpath -m "${WEFT_ASAN_BUILD:-$top/build/asan}")
case "$top$build" in *" "*) echo "test: a space ends a path in the options of sanitizers; clone into a folder without one" >&2; exit 1 ;; esac
mkdir -p "$build"
cmake -S "$top" -B "$build" -G Ninja -DCMAKE_UNITY_BUILD=ON -DWEFT_SANITIZE=address,undefined -DWEFT_WERROR=ON -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O1 -DCMAKE_C_FLAGS_DEBUG=-O1 >/dev/null
# What holds buffers, textures and threads over many frames, saves and environments; the others go through the same code.
gl_tests="gl_objects_test gl_program_test runtime_reload_test runtime_studio_test"
start=$SECONDS
ninja -j2 -C "$build" app/weft tests/app/weft_compare weft_cpu_tests weft_fuzz
echo "built in $((SECONDS - start)) s"
# Exit code 86 is theirs alone. A run that takes more than 4 GB ends with a report. What GCC 12 takes for blocks of TLS may be any memory, and
# LeakSanitizer dies of it (intercept_tls_get_addr).
export ASAN_OPTIONS="intercept_tls_get_addr=0:detect_stack_use_after_return=1:strict_string_checks=1:check_initialization_order=1:exitcode=86:hard_rss_limit_mb=4096"
export UBSAN_OPTIONS="print_stacktrace=1:halt_on_error=1:exitcode=86:suppressions=$top/tests/app/hostile/ubsan.supp"
export LSAN_OPTIONS="suppressions=$top/tests/gl/lsan.supp:print_suppressions=0:exitcode=86"
start=$SECONDS
export WEFT_KEEP_FILES="$build/kept"  # for the fuzz targets
mkdir -p "$WEFT_KEEP_FILES"
"$top/tests/ctest.sh" "$build" -L cpu -E '^app_hostile_'
"$top/tests/ctest.sh" "$build" -R "^(${gl_tests// /|})(_binaries)?$"

python3 "$top/tests/fuzz/fuzz.py" "$build" "$WEFT_KEEP_FILES"

# The scripts: a report goes to a file and fails the script that caused it (run_script.py, tests/app/program.py). The viewer's driver stays
# loaded until leaks are looked for.
cc -shared -fPIC -o "$build/keep_drivers.so" "$top/tests/app/hostile/keep_drivers.c"
cat >"$build/weft_kept" <<END
#!/bin/sh
LD_PRELOAD="$build/keep_drivers.so" exec "$build/app/weft" "\$@"
END
chmod +x "$build/weft_kept"
cc -fsanitize=address,undefined -static-libasan -static-libubsan -O1 -g1 -o "$build/sanitizer_reports" "$top/tests/app/hostile/sanitizer_reports.c"
weft="$build/app/weft"
kept="$build/weft_kept"
compare="$build/tests/app/weft_compare"
logs="$build/sanitized"
rm -rf "$logs"
mkdir "$logs"
# run_script LOG SCRIPT ARGUMENTS... (a script below tests/app)
run_script() {
  python3 "$top/tests/app/hostile/run_script.py" "$logs/$1" "${@:2}"
}
# runs LOGS...: how often the program was run by these.
runs() {
  (cd "$logs" && sed -n 's/^\([0-9]*\) runs under sanitizers, 0 reports$/\1/p' "$@") | awk '{ sum += $1 } END { print sum + 0 }'
}
run_script sanitizer_reports hostile/sanitizer_reports "$build/sanitizer_reports"
# Beside each other: the graphs take as long as all other files.
run_script hostile_graphs hostile/graphs "$weft" &
graphs=$!
code=0
{ run_script broken_inputs hostile/broken_inputs "$weft" && run_script hostile_files hostile/files "$weft" && run_script hostile_files_cache hostile/files "$weft" --cache &&
  run_script hostile_outputs hostile/outputs "$kept" && run_script hostile_shaders hostile/shaders "$kept" "$compare" && run_script view_files view/files "$kept" "$compare"; } || code=1
wait "$graphs" || code=1
[ "$code" = 0 ] || exit 1
echo "broken and hostile inputs: $(runs broken_inputs hostile_graphs hostile_files hostile_files_cache hostile_outputs hostile_shaders view_files) runs of the program, 0 reports"
{ run_script view view/basics "$kept" "$compare" && run_script view_window view/basics "$kept" "$compare" --window; } &
views=$!
{ run_script sequences output/sequences "$weft" && run_script videos output/videos "$weft" && run_script checkpoints session/checkpoints "$weft" &&
  run_script view_session view/session "$kept" "$compare" && run_script environments view/environments "$kept" "$compare" && run_script environments_window view/environments "$kept" "$compare" --window &&
  run_script view_panels view/panels "$kept"; } || code=1
wait "$views" || code=1
[ "$code" = 0 ] || exit 1
echo "run in $((SECONDS - start)) s; scripts ran the program $(runs $(ls "$logs" | grep -v sanitizer_reports)) times, 0 reports"
skipped=$(grep -l '^skipped: ' "$logs"/* | xargs -rn1 basename | paste -sd, | sed 's/,/, /g') || true
if [ -n "$skipped" ]; then echo "skipped: $skipped (why is said above)"; fi
