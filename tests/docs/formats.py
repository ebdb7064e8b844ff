#!/usr/bin/env python3
"""The table of formats in docs/graph-format.md has a row for each line that `weft types` prints below "formats", with the same words.
Usage: formats.py TOP WEFT"""
import pathlib
import subprocess
import sys


def printed(weft):
    """Rows of cells."""
    lines = subprocess.run([weft, "types"], capture_output=True, text=True, check=True).stdout.split("\nformats\n")[1].splitlines()
    return [line.split() for line in lines[1:]]


def main() -> int:
    top, weft = pathlib.Path(sys.argv[1]), sys.argv[2]
    page = (top / "docs/graph-format.md").read_text()
    table = page[page.index("| format | bytes |"):].split("\n\n")[0].splitlines()[2:]
    rows = [[cell.strip().strip("`") for cell in row.strip("|").split("|")] for row in table]
    expected = [["" if cell == "-" else cell for cell in row] for row in printed(weft)]
    problems = [f"{a} is in the table, {b} is printed" for a, b in zip(rows, expected) if a != b]
    if len(rows) != len(expected):
        problems.append(f"{len(rows)} rows, {len(expected)} formats")
    print("\n".join(f"docs/graph-format.md: {problem}" for problem in problems) or f"formats: {len(rows)} rows")
    return 1 if problems or len(rows) < 30 else 0


sys.exit(main())
