#!/usr/bin/env python3
"""docs/graph-format.md lists every format that `weft types` prints below "formats", under what its texels are, and no other.
Usage: formats.py TOP WEFT"""
import pathlib
import re
import subprocess
import sys


def printed(weft):
    """What the texels are, by name; a format with stencil has depth."""
    lines = subprocess.run([weft, "types"], capture_output=True, text=True, check=True).stdout.split("\nformats\n")[1].splitlines()
    return {line.split()[0]: line.split()[3].split("/")[0] for line in lines[1:]}


def main() -> int:
    top, weft = pathlib.Path(sys.argv[1]), sys.argv[2]
    table = (top / "docs/graph-format.md").read_text().split("| texels | formats |\n|---|---|\n")[1].split("\n\n")[0]
    listed = {}
    for row in table.splitlines():
        texels, names = re.match(r"\| (\w+).*? \| (.*) \|", row).groups()
        listed.update(dict.fromkeys(re.findall(r"[a-z]\w+", names), texels))
    expected = printed(weft)
    problems = [f"{name} is listed as {listed.get(name)}, printed as {expected.get(name)}"
                for name in sorted(listed.keys() | expected.keys()) if listed.get(name) != expected.get(name)]
    print("\n".join(f"docs/graph-format.md: {problem}" for problem in problems) or f"formats: {len(listed)}")
    return 1 if problems or len(listed) < 30 else 0


sys.exit(main())
