#!/usr/bin/env python3
"""Every station of a walk in docs/overview.md is there: the file, and the function in it. Usage: stations.py TOP"""
import pathlib
import re
import sys


def main() -> int:
    top = pathlib.Path(sys.argv[1])
    stations = re.findall(r"^\| .+ \| `([^`]+)` \| `([^`]+)` \|$", (top / "docs/overview.md").read_text(), re.M)
    problems = []
    for name, function in stations:
        path = top / name
        if not path.is_file():
            problems.append(f"docs/overview.md: {name} is not there")
        elif not re.search(rf"(?:^|[\s:*&]){re.escape(function)}\(", path.read_text(), re.M):
            problems.append(f"docs/overview.md: no function {function}() in {name}")
    if len(stations) < 15:
        problems.append(f"docs/overview.md: {len(stations)} stations; the walks are not where they were")
    print("\n".join(problems) or f"stations: {len(stations)}, each there")
    return 1 if problems else 0


sys.exit(main())
