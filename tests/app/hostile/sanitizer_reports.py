#!/usr/bin/env python3
"""That a report of the sanitizers fails a test: programs that overflow a block, overflow a number and leak, each ending with the exit code
that is expected and with nobody reading what it prints. SOUND is the same program without a mistake. And that run_script.py runs a script
again in which LeakSanitizer died, and only then. sanitizer_reports.py PROGRAM --sanitized"""
import os
import pathlib
import subprocess
import sys

import run_script
from program import Report, run, sanitizers, temporary_folder

# Mistakes in the runs of a script, one run a word; the exit code of run_script.py. All of the words are run, and no more.
SCRIPTS = [("sound", 0), ("leak", 1), ("death sound", 0), ("death death sound", 0), ("death death death", 1), ("death leak", 1), ("death+leak", 1), ("leak+death", 1),
           ("death+block", 1), ("failure", 1), ("death failure", 1)]
DEATH = "==9068==LeakSanitizer has encountered a fatal error.\n==9068==HINT: LeakSanitizer does not work under ptrace (strace, gdb, etc)\n"
TRACER = "Tracer caught signal 11: addr=0x4b70 pc=0x561576afc020 sp=0x7f7285ffdd10\n"
REPORTS = ["", TRACER, DEATH + "SUMMARY: AddressSanitizer: 8 byte(s) leaked in 1 allocation(s).\n", "a.cpp:1:1: runtime error: signed integer overflow\n" + DEATH]


def script(program, runs, *mistakes):
    """What run_script.py runs here: the mistakes of this run, which is counted in the file `runs`."""
    report, before = Report(), runs.read_text()
    runs.write_text(before + ".")
    for mistake in mistakes[len(before)].split("+"):
        report.check(mistake != "failure" and run(program, mistake).code == 1, mistake)
    report.end()


def judge_scripts(program, report):
    for file in sanitizers.seen:
        file.unlink()
    with temporary_folder() as name:
        log, runs = pathlib.Path(name) / "log", pathlib.Path(name) / "runs"
        environment = {key: ":".join(word for word in os.environ[key].split(":") if not word.startswith("log_path=")) for key in ("ASAN_OPTIONS", "UBSAN_OPTIONS", "LSAN_OPTIONS")}
        for mistakes, code in SCRIPTS:
            runs.write_text("")
            done = subprocess.run([sys.executable, run_script.__file__, log, "hostile/sanitizer_reports", program, runs, *mistakes.split()], env={**os.environ, **environment}, capture_output=True, text=True)
            report.check(done.returncode == code and len(runs.read_text()) == len(mistakes.split()), f"{mistakes}: exit code {done.returncode}, {runs.read_text()}\n{done.stdout}{done.stderr}")
    report.check(all(map(run_script.is_death, (DEATH, TRACER + DEATH))), "a death is taken for a report")
    for text in REPORTS:
        report.check(not run_script.is_death(text), f"a report is taken for a death: {text}")


def main():
    program, report = os.path.abspath(sys.argv[1]), Report()
    if len(sys.argv) > 3:
        script(program, pathlib.Path(sys.argv[2]), *sys.argv[3:-1])
    sound = run(program, "sound")
    report.check(sound.code == 1 and not sanitizers.new(), f"a sound program: {sound.code}\n{sound.err}")
    for mistake, says in (("block", "heap-buffer-overflow"), ("number", "signed integer overflow"), ("leak", "LeakSanitizer")):
        for before in ((), ("sh", "-c", '"$@" >/dev/null 2>&1; exit 1', "sh")):
            seen = Report()
            done = run(program, mistake, before=before)
            seen.check(done.code == (1 if before else 86), f"{mistake}: exit code {done.code}")
            fits = seen.reports == 1 and len(seen.problems) == 1 and says in seen.problems[0]
            report.check(fits, f"{mistake}, {'hidden' if before else 'plain'}: {seen.reports} reports, {seen.problems}")
    judge_scripts(program, report)
    report.end()


main()
