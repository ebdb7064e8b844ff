#!/usr/bin/env python3
"""docs/limits.md has a row for each limit of engine/base/limits.h, with its default; the tests that a row names are there, and name the
limit. Usage: limits.py TOP"""
import pathlib
import re
import sys

UNITS = {10: "K", 20: "M", 30: "G"}


def defaults(text):
    """Of each limit, as the page writes them: 32M for 32ull << 20."""
    found = re.findall(r"^  X\((\w+), +(\d+)(?:ull << (\d+))?, ", text, re.M)
    return {name: number + (UNITS[int(shift)] if shift else "") for name, number, shift in found}


def main() -> int:
    top = pathlib.Path(sys.argv[1])
    limits, problems = defaults((top / "engine/base/limits.h").read_text()), []
    page = (top / "docs/limits.md").read_text()
    table = page[page.index("| limit |"):].split("\n\n")[0].splitlines()[2:]
    rows = [[cell.strip() for cell in row.strip("|").split("|")] for row in table]
    seen = [row[0].strip("`") for row in rows]
    for name in limits:
        if seen.count(name) != 1:
            problems.append(f"{seen.count(name)} rows for {name}, not one")
    for name, row in zip(seen, rows):
        tests = re.findall(r"`(tests/[^`]+)`", row[-1])
        texts = {test: (top / test).read_text() for test in tests if (top / test).is_file()}
        problems += [f"{name}: {test} is not there" for test in tests if test not in texts]
        if not tests:
            problems.append(f"{name}: no test holds '{row[2]}'")
        if name == "none":
            continue
        if row[1].split(" ")[0] != limits.get(name):
            problems.append(f"{name}: {row[1]} instead of {limits.get(name, 'no such limit')}")
        if not any(name in text for text in texts.values()):
            problems.append(f"{name}: no test that the row names has its name")
    print("\n".join(f"docs/limits.md: {problem}" for problem in problems) or f"limits: {len(rows)} rows, each with its tests")
    return 1 if problems or len(rows) < len(limits) or not limits else 0


sys.exit(main())
