#!/usr/bin/env python3
"""Holds the package list of ./run and the table of docs/dependencies.md against each other: equal names, equal order,
each with a reason."""
import pathlib
import re
import sys


def main() -> int:
    top = pathlib.Path(sys.argv[1])
    listed = re.search(r"^packages=\(([^)]*)\)", (top / "run").read_text(), re.M)
    packages = listed.group(1).split() if listed else []
    rows = re.findall(r"^\| `([^`]+)` \|(.*)\|$", (top / "docs/dependencies.md").read_text(), re.M)
    named = [name for name, _ in rows]
    problems = [f"run installs '{p}', docs/dependencies.md does not say why" for p in packages if p not in named]
    problems += [f"docs/dependencies.md names '{p}', run does not install it" for p in named if p not in packages]
    problems += [f"docs/dependencies.md gives no reason for '{name}'" for name, why in rows if len(why.strip()) < 10]
    problems += [f"docs/dependencies.md names '{name}' twice" for name in set(named) if named.count(name) > 1]
    if not problems and named != packages:
        problems.append("docs/dependencies.md has another order than run")
    print("\n".join(problems) or f"dependencies: {len(packages)} packages, each with its reason")
    return 1 if problems or not packages else 0


sys.exit(main())
