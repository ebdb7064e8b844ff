#!/usr/bin/env python3
"""Weft's own goldens, by `weft test`, and what it does not look at: files without a case, their size, and the example of the vignette, which is
one stanza and one GLSL file more than graphs/glow.json.

    golden.py WEFT OUT      exit 1 when something moved, with a page, the pictures and their differences left in OUT
"""
import json
import pathlib
import re
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parents[1]
MOST_BYTES = 1_500_000


def read_graph(path):
    return json.loads(re.sub(r"^\s*//.*$", "", path.read_text(), flags=re.M))


def check_vignette():
    """tests/golden/vignette.json is graphs/glow.json with one stanza more, whose shader is the only one beside it."""
    base, example = read_graph(TOP / "graphs/glow.json"), read_graph(HERE / "vignette.json")
    for graph in (base, example):
        graph.pop("name", None), graph.pop("$schema")
    added = [stanza for stanza in example["passes"] if stanza not in base["passes"]]
    if len(added) != 1:
        return f"{len(added)} stanzas differ from graphs/glow.json"
    example["passes"].remove(added[0])
    if example != base:
        return "without its stanza it is not graphs/glow.json"
    files = [str(f.relative_to(HERE / "shaders")) for f in (HERE / "shaders").rglob("*") if f.is_file()]
    if files != [added[0]["shader"]]:
        return f"its shaders are {files}, its stanza names {added[0]['shader']}"
    if (TOP / "shaders" / added[0]["shader"]).exists():
        return "its shader is a bundled one"
    return None


def check_files(cases):
    """Every golden has a case, every case its golden and its record."""
    expected = {f"{case['name']}.txt" for case in cases if case.get("plan")}
    expected |= {f"{case['name']}{suffix}" for case in cases if not case.get("plan") for suffix in (".png", ".passes")}
    there = {f.name for f in HERE.iterdir() if f.suffix in (".png", ".txt", ".passes")} - {"CMakeLists.txt"}
    size = sum(f.stat().st_size for f in HERE.rglob("*") if f.is_file())
    problems = [f"{name}: no case has it" for name in sorted(there - expected)] + [f"{name} is not there" for name in sorted(expected - there)]
    if size > MOST_BYTES:
        problems.append(f"{size} bytes of goldens: above {MOST_BYTES}")
    return "\n".join(problems)


def main():
    weft, out = sys.argv[1], pathlib.Path(sys.argv[2])
    cases = json.loads((HERE / "goldens.cases.json").read_text())["cases"]
    problems = [problem for problem in (check_vignette(), check_files(cases)) if problem]
    done = subprocess.run([weft, "test", "tests/golden", "--program-cache", out / "programs", "-o", out, "--report", out / "report.html"], cwd=TOP)
    if done.returncode:
        problems.append(f"weft test: exit code {done.returncode}; look at {out}/report.html")
    print("\n".join(f"FAILED: {problem}" for problem in problems) or "every golden has a case; the vignette is one stanza and one GLSL file")
    return 1 if problems else 0


sys.exit(main())
