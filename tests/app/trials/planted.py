#!/usr/bin/env python3
"""Bugs of planted_bugs.json, planted one after another in a copy of graphs and shaders: `weft test` finds each, and the pass it is in, with a tolerance of 0,
and with the default one. The case bloom_exact has a tolerance of its own, which is 0: what its bug changes the default one lets pass. Without a bug it finds nothing, however often it runs, on one thread or on all.

    planted.py WEFT [--all] [--no-bugs] [--runs N]

Some bugs of glow.json, with --all all bugs of all cases, with --no-bugs none; then N runs (default 2) of the cases without a bug. Every second one has one
thread. Two of four compare pictures with their goldens, the other two also what each pass wrote, with the record beside the golden.
"""
import argparse
import collections
import json
import os
import pathlib
import re
import shutil
import time

from program import TOP, Report, run, temporary_folder

HERE = pathlib.Path(__file__).resolve().parent
FIRST = re.compile(r"first that differs: pass '([^']+)'")
FOUND = re.compile(r"FLIP ([\d.]+), at most ([\d.]+)")


class Copy:
    """The data of Weft in a folder of its own, with the cases and their goldens."""

    def __init__(self, weft, folder):
        self.weft, self.folder, self.cache = weft, folder, folder / "programs"
        for name in ("graphs", "shaders", "scenes", "materials"):
            shutil.copytree(TOP / name, folder / name)
        self.cases = json.loads((HERE / "planted.cases.json").read_text())
        self.choose_tolerance(self.cases["defaults"]["tolerance"])

    def choose_tolerance(self, tolerance):
        """None: the default one."""
        defaults = {**self.cases["defaults"], "tolerance": tolerance or {}}
        (self.folder / "planted.cases.json").write_text(json.dumps({**self.cases, "defaults": defaults}))

    def test(self, *arguments, threads=0):
        """`threads`: 1, or 0 for as many as there are."""
        environment = {**os.environ, "WEFT_DATA": str(self.folder), **({"LP_NUM_THREADS": "0"} if threads == 1 else {})}
        confine = (lambda: os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})) if threads == 1 else None
        return run(self.weft, "test", self.folder, "--program-cache", self.cache, *arguments, folder=self.folder, env=environment, preexec_fn=confine)


def plant(copy, bug, report):
    path = copy.folder / bug["file"]
    text = path.read_text()
    if not report.check(text.count(bug["from"]) >= 1 and bug["from"] != bug["to"], f"{bug['bug']}: {bug['file']} has no '{bug['from']}'"):
        return
    path.write_text(text.replace(bug["from"], bug["to"], 1))
    results = []
    for tolerance in (copy.cases["defaults"]["tolerance"], None):
        copy.choose_tolerance(tolerance)
        results.append(copy.test("--only", bug["case"]))
    path.write_text(text)
    copy.choose_tolerance(copy.cases["defaults"]["tolerance"])
    for result in results:
        found, expected = FIRST.findall(result.out), [bug["pass"]]
        report.check(result.code == 1 and found == expected, f"{bug['bug']}: expected {expected}, found {found}, code {result.code}\n{result.out}{result.err}")
    numbers = FOUND.search(results[0].out)
    print(f"{bug['bug']}: {FIRST.findall(results[0].out)}, FLIP {numbers[1]}, at most {numbers[2]}; with the tolerance of its case or the default one {'found' if results[1].code else 'not found'}" if numbers else results[0].out, flush=True)


def run_without_bugs(copy, cases, runs, report):
    """Prints how many comparisons there were, and how many of them raised an alarm."""
    began, counts = time.monotonic(), collections.Counter()
    only = [word for case in cases for word in ("--only", case)]
    for number in range(runs):
        threads, records = (1, 0)[number % 2], number % 4 >= 2
        result = copy.test(*only, *(["--accept"] if records else []), threads=threads)
        word = "kept" if records else "ok"
        same = [case for case in cases if re.search(rf"^{word} +{case}$", result.out, re.MULTILINE)]
        counts[threads, records] += len(cases)
        counts["alarms"] += len(cases) - len(same)
        report.check(result.code == 0 and len(same) == len(cases), f"run {number} without a bug, {threads or 'all'} threads: {result.code}\n{result.out}{result.err}")
        if number % 10 == 9:
            print(f"{number + 1} runs without a bug, {counts['alarms']} alarms", flush=True)
    for (threads, records), count in sorted((key, count) for key, count in counts.items() if key != "alarms"):
        print(f"{'one thread' if threads else 'all threads'}, {'pictures and what each pass wrote' if records else 'pictures'}: {count} comparisons")
    print(f"{runs} runs without a bug of {', '.join(cases)}: {runs * len(cases)} comparisons, {counts['alarms']} alarms, in {time.monotonic() - began:.0f} s")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("weft", type=pathlib.Path)
    for flag in ("--all", "--no-bugs"):
        parser.add_argument(flag, action="store_true")
    parser.add_argument("--runs", type=int, default=2)
    options, report = parser.parse_args(), Report()
    bugs = json.loads((HERE / "planted_bugs.json").read_text())
    report.check(len([bug for bug in bugs if bug["case"] != "bloom_exact"]) >= 20, f"{len(bugs)} bugs")
    with temporary_folder() as folder:
        copy = Copy(options.weft.resolve(), pathlib.Path(folder))
        every = options.all or options.no_bugs
        cases = [case["name"] for case in copy.cases["cases"] if every or case["name"] == "glow"]
        written = copy.test("--accept", *(word for case in cases for word in ("--only", case)))
        report.check(written.code == 0, f"{written.out}{written.err}")
        chosen = [] if options.no_bugs else bugs if options.all else [bug for bug in bugs if bug["case"] == "glow"][1::3]
        for bug in chosen:
            plant(copy, bug, report)
        print(f"{len(chosen)} bugs planted")
        run_without_bugs(copy, cases, options.runs, report)
    report.end()


main()
