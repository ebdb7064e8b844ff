#!/usr/bin/env python3
"""That a report of the sanitizers fails a test: programs that overflow a block, overflow a number and leak, each ending with the exit code
that is expected and with nobody reading what it prints. SOUND is the same program without a mistake. sanitizer_reports.py PROGRAM --sanitized"""
import os
import sys

from program import Report, run, sanitizers


def main():
    program, report = os.path.abspath(sys.argv[1]), Report()
    sound = run(program, "sound")
    report.check(sound.code == 1 and not sanitizers.new(), f"a sound program: {sound.code}\n{sound.err}")
    for mistake, says in (("block", "heap-buffer-overflow"), ("number", "signed integer overflow"), ("leak", "LeakSanitizer")):
        for before in ((), ("sh", "-c", '"$@" >/dev/null 2>&1; exit 1', "sh")):
            seen = Report()
            done = run(program, mistake, before=before)
            seen.check(done.code == (1 if before else 86), f"{mistake}: exit code {done.code}")
            fits = seen.reports == 1 and len(seen.problems) == 1 and says in seen.problems[0]
            report.check(fits, f"{mistake}, {'hidden' if before else 'plain'}: {seen.reports} reports, {seen.problems}")
    for file in sanitizers.seen:
        file.unlink()
    report.end()


main()
