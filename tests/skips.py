#!/usr/bin/env python3
"""A skipped case is seen: the exit code of a test executable whose cases skip, and what ./test and .ci/run print at their end. Runs copies of
these scripts on tests that are pretended, in a folder with a space.

    skips.py SKIP_PROBE
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parents[1]
# Suites of skip_probe.cpp, the exit code, and words of the output.
PROBES = [
    ("runs", 0, ""),
    ("skips", 77, "skipped: no moon tonight"),
    ("skips,runs", 1, "2 of 3 cases skipped; they need a ctest of their own"),
    ("fails", 1, "skipped: after a failure"),
    ("fails_first", 1, "skipped: no context"),
    ("all", 77, "skipped: no context"),
]
TESTS = """
add_test(passes "true")
add_test(moon "sh" "-c" "seq 1 5000; echo 'skipped: no moon'; echo 'skipped: no "sun" either'; exit 77")
set_tests_properties(moon PROPERTIES SKIP_RETURN_CODE 77)
add_test(silent "sh" "-c" "exit 77")
set_tests_properties(silent PROPERTIES SKIP_RETURN_CODE 77)
add_test(off "false")
set_tests_properties(off PROPERTIES DISABLED ON)
add_test(broken "sh" "-c" "exit 3")
"""
NAMED = {"moon": 'moon (no moon; no "sun" either)', "silent": "silent (it does not say why)", "off": "off (disabled in this build)"}


def check_probe(probe, problems):
    for suites, code, words in PROBES:
        done = subprocess.run([probe, f"--test-suite={suites}"], capture_output=True, text=True)
        if done.returncode != code or words not in done.stdout:
            problems.append(f"{suites}: exit code {done.returncode}, expected {code} and '{words}':\n{done.stdout}{done.stderr}")
    quiet = subprocess.run([probe, "--test-suite=runs"], capture_output=True, text=True, env=environment(WEFT_PROBE_QUIET="1"))
    if quiet.returncode != 1 or "'skips quietly' has doctest::skip" not in quiet.stdout:
        problems.append(f"a case with doctest::skip: exit code {quiet.returncode}\n{quiet.stdout}")


def check_script(folder, command, arguments, code, named, problems):
    done = subprocess.run([*command, *arguments], cwd=folder, capture_output=True, text=True, env=environment(CI="true"))
    line = f"skipped: {', '.join(NAMED[name] for name in named) or 'nothing'}"
    last = done.stdout.rstrip("\n").rpartition("\n")[2]
    what = f"{' '.join([*command, *arguments])}: exit code {done.returncode}, expected {code}"
    if done.returncode != code:
        problems.append(f"{what}\n{done.stdout}{done.stderr}")
    if last != line:
        problems.append(f"{what}\n  last line {last!r}\n  expected  {line!r}\n{done.stderr}")
    if "tests passed" not in done.stdout:
        problems.append(f"{what}: ctest's summary is not there:\n{done.stdout}")


def environment(**more):
    return {key: value for key, value in os.environ.items() if key != "WEFT_BUILD"} | more


def main():
    problems = []
    check_probe(sys.argv[1], problems)
    with tempfile.TemporaryDirectory(prefix="weft_test_") as name:
        folder = pathlib.Path(name).resolve() / "a folder"
        for part in ("test", ".ci/run", "tests/ctest.sh", "tests/skipped.py"):
            (folder / part).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(TOP / part, folder / part)
        (folder / "run").write_text("#!/bin/sh\nexit 0\n")  # the set-up
        (folder / "run").chmod(0o755)
        build = folder / "build/release"
        build.mkdir(parents=True)
        (build / "CTestTestfile.cmake").write_text(TESTS.replace('"sun"', '\\"sun\\"'))
        check_script(folder, ["./test"], ["-E", "broken"], 0, ["moon", "silent", "off"], problems)
        check_script(folder, ["./test"], ["-R", "passes"], 0, [], problems)
        check_script(folder, ["./test"], ["-R", "silent|passes|broken"], 8, ["silent"], problems)
        check_script(folder, ["bash", ".ci/run"], [], 8, ["moon", "silent", "off"], problems)
    print("\n".join(problems) or "skips: every skip is seen")
    return 1 if problems else 0


sys.exit(main())
