#!/usr/bin/env python3
"""Command lines: what --help lists is what bash completes, and a wrong option is named.

    command_line.py WEFT
"""
import pathlib
import re
import subprocess
import sys

from program import TOP, Report, run

ASK = 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _weft; printf "%s\\n" "${COMPREPLY[@]}"'


def complete(weft, *words):
    done = subprocess.run(["bash", "-u", "-c", ASK, "bash", TOP / "app/completion.bash", weft, *words], capture_output=True, text=True)
    assert done.returncode == 0 and not done.stderr, done.stderr
    return done.stdout.split()


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    commands = re.findall(r"^  ([a-z]+) ", run(weft, "--help").out.split("Subcommands:")[1], re.M)
    report.check(len(commands) > 10 and complete(weft, "") == commands, f"{commands}, completed {complete(weft, '')}")
    report.check(complete(weft, "rend") == ["render"], "rend")
    report.check({"--scene", "--backend"} <= set(complete(weft, "render", "--")) and complete(weft, "render", "--back") == ["--backend"], "options of render")
    done = run(weft, "new", "pass", "tint", "--grap", "g.json")
    report.check(done.code == 2 and "--grap" in done.err, done.err)
    done = run(weft, "new", "pass", "9", "--confine", ".", "--limit", "7")
    report.check(done.code == 1 and done.codes() == ["W012"], f"new pass --confine --limit: {done.code} {done.err}")
    report.end()


main()
