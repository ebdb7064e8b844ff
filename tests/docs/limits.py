#!/usr/bin/env python3
"""docs/limits.md has a row for each limit of engine/base/limits.h, with its default, and some test names each limit. Usage: limits.py TOP"""
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
    limits = defaults((top / "engine/base/limits.h").read_text())
    page = (top / "docs/limits.md").read_text()
    table = page[page.index("| limit |"):].split("\n\n")[0].splitlines()[2:]
    rows = [[cell.strip() for cell in row.strip("|").split("|")] for row in table]
    shown = [(row[0].strip("`"), row[1].split(" ")[0]) for row in rows]
    problems = [f"no row '{name} | {value}'" for name, value in limits.items() if (name, value) not in shown]
    problems += [f"a row '{name} | {value}', which no limit has" for name, value in shown if limits.get(name) != value]
    problems += [f"two rows of {name}" for name in limits if sum(name == other for other, _ in shown) > 1]
    tests = "".join(path.read_text() for kind in ("*.py", "*.cpp") for path in (top / "tests").rglob(kind))
    problems += [f"no test names {name}" for name in limits if not re.search(rf"Limit::{name}\b|\blimit {name}\b|\b{name}=|['\"]{name}['\"=]", tests)]
    print("\n".join(f"docs/limits.md: {problem}" for problem in problems) or f"limits: {len(rows)} rows")
    return 1 if problems or not limits else 0


sys.exit(main())
