#!/usr/bin/env python3
"""Bugs of planted_bugs.json, planted one after another in a copy of graphs and shaders: `weft test` finds each, and the pass it is in. Without a bug
it finds nothing, however often it runs.

    planted.py WEFT [--all] [--runs N]      the first bugs that reach different passes of glow.json, or all; N runs without a bug (default 2)
"""
import argparse
import json
import os
import pathlib
import re
import shutil

from program import TOP, Report, run, temporary_folder

HERE = pathlib.Path(__file__).resolve().parent
FIRST = re.compile(r"first that differs: pass '([^']+)'")


class Copy:
    """The data of Weft in a folder of its own, with the cases and their goldens."""

    def __init__(self, weft, folder):
        self.weft, self.folder, self.cache = weft, folder, folder / "programs"
        for name in ("graphs", "shaders", "scenes", "materials"):
            shutil.copytree(TOP / name, folder / name)
        shutil.copy(HERE / "planted.cases.json", folder)

    def test(self, *arguments):
        environment = {**os.environ, "WEFT_DATA": str(self.folder)}
        return run(self.weft, "test", self.folder, "--program-cache", self.cache, *arguments, folder=self.folder, env=environment)


def plant(copy, bug, report):
    path = copy.folder / bug["file"]
    text = path.read_text()
    if not report.check(text.count(bug["from"]) >= 1 and bug["from"] != bug["to"], f"{bug['bug']}: {bug['file']} has no '{bug['from']}'"):
        return
    path.write_text(text.replace(bug["from"], bug["to"], 1))
    result = copy.test("--only", bug["case"])
    path.write_text(text)
    found = FIRST.findall(result.out)
    report.check(result.code == 1 and found == [bug["pass"]], f"{bug['bug']}: expected {bug['pass']}, found {found}, code {result.code}\n{result.out}{result.err}")
    print(f"{bug['bug']}: {found}", flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("weft", type=pathlib.Path)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--runs", type=int, default=2)
    options, report = parser.parse_args(), Report()
    bugs = json.loads((HERE / "planted_bugs.json").read_text())
    report.check(len(bugs) >= 20, f"{len(bugs)} bugs")
    with temporary_folder() as folder:
        copy = Copy(options.weft.resolve(), pathlib.Path(folder))
        only = () if options.all else ("--only", "glow")
        written = copy.test("--accept", *only)
        report.check(written.code == 0, f"{written.out}{written.err}")
        chosen = bugs if options.all else [bug for bug in bugs if bug["case"] == "glow"][1::3]
        for bug in chosen:
            plant(copy, bug, report)
        for number in range(options.runs):
            result = copy.test(*only)
            report.check(result.code == 0 and "FAILED" not in result.out, f"run {number} without a bug\n{result.out}{result.err}")
            if number % 10 == 9:
                print(f"{number + 1} runs without a bug", flush=True)
        print(f"{len(chosen)} bugs, {options.runs} runs without one")
    report.end()


main()
