#!/usr/bin/env python3
"""Runs a script below tests/app under the sanitizers, as sanitize.sh does. Their reports stand in files of this script alone, LOG.report.PID,
and fail it, whatever became of the exit code and the output, which is shown and kept in LOG. LeakSanitizer itself dies now and then while it
stops many threads: a run of the script in which it died, and nothing else was reported, has no verdict, and the script is run again, three
times at most.

    run_script.py LOG SCRIPT ARGUMENTS...
"""
import os
import pathlib
import re
import subprocess
import sys
import time

TESTS = pathlib.Path(__file__).resolve().parents[1]
RUNS = 3
# All that the file of such a process holds. One line more, and it is a report.
DEATH = re.compile(r"(?:Tracer caught signal \d+: [^\n]*\n)?==\d+==LeakSanitizer has encountered a fatal error\.\n(?:==\d+==HINT: [^\n]*\n)*")


def is_death(report):
    return bool(DEATH.fullmatch(report))


def run_once(log, script, arguments):
    """Exit code and reports."""
    for file in reports_of(log):
        file.unlink()
    kept = f"log_path={log}.report"
    options = {name: f"{os.environ[name]}:{kept}" for name in ("UBSAN_OPTIONS", "LSAN_OPTIONS")}
    options["ASAN_OPTIONS"] = f"{os.environ['ASAN_OPTIONS']}:verify_asan_link_order=0:{kept}"
    began = time.monotonic()
    with open(log, "w") as output:
        done = subprocess.run([sys.executable, TESTS / f"{script}.py", *arguments, "--sanitized"], env={**os.environ, **options, "PYTHONPATH": str(TESTS)},
                              stdout=output, stderr=subprocess.STDOUT)
    reports = [file.read_text(errors="replace") for file in reports_of(log)]
    print(f"-- {log.name}: {time.monotonic() - began:.0f} s", log.read_text(errors="replace"), *reports, sep="\n", flush=True)
    return done.returncode, reports


def reports_of(log):
    return sorted(log.parent.glob(f"{log.name}.report.*"))


def main():
    log, script, *arguments = sys.argv[1:]
    for i in range(RUNS):
        code, reports = run_once(pathlib.Path(log), script, arguments)
        if not reports or not all(map(is_death, reports)):
            break
        print(f"LeakSanitizer died: no verdict, run {i + 1} of at most {RUNS}", flush=True)
    sys.exit(1 if reports or code not in (0, 77) else 0)


if __name__ == "__main__":
    main()
