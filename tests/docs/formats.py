#!/usr/bin/env python3
"""docs/graph-format.md lists every format that `weft types` prints below "formats", under what its texels are, and no other. It and
docs/graph.schema.json, wherever they list the types of passes, list those that `weft types` prints, in its order.
Usage: formats.py TOP WEFT"""
import pathlib
import re
import subprocess
import sys


def printed(said):
    """What the texels are, by name; a format with stencil has depth."""
    lines = said.split("\nformats\n")[1].splitlines()
    return {line.split()[0]: line.split()[3].split("/")[0] for line in lines[1:]}


def wrong_types(docs, said):
    """Lists of pass types that are not what is printed."""
    types = re.findall(r"^  (\w+)$", said.split("\nimports\n")[0], re.M)
    page = re.findall(r"`type` is its kind: (.*?)\.", (docs / "graph-format.md").read_text())
    schema = re.findall(r'"kind of pass: (.*?)\.', (docs / "graph.schema.json").read_text())
    lists = [("graph-format.md", re.findall(r"`(\w+)`", each)) for each in page] + [("graph.schema.json", re.findall(r"\w+", each)) for each in schema]
    if len(page) != 1 or len(schema) < 4:
        return [f"of the lists of pass types, {len(page)} and {len(schema)} are found"]
    return [f"{name} lists the pass types {', '.join(listed)}, printed are {', '.join(types)}" for name, listed in lists if listed != types]


def main() -> int:
    top, weft = pathlib.Path(sys.argv[1]), sys.argv[2]
    said = subprocess.run([weft, "types"], capture_output=True, text=True, check=True).stdout
    table = (top / "docs/graph-format.md").read_text().split("| texels | formats |\n|---|---|\n")[1].split("\n\n")[0]
    listed = {}
    for row in table.splitlines():
        texels, names = re.match(r"\| (\w+).*? \| (.*) \|", row).groups()
        listed.update(dict.fromkeys(re.findall(r"[a-z]\w+", names), texels))
    expected = printed(said)
    problems = [f"{name} is listed as {listed.get(name)}, printed as {expected.get(name)}"
                for name in sorted(listed.keys() | expected.keys()) if listed.get(name) != expected.get(name)]
    problems = [f"graph-format.md: {problem}" for problem in problems] + wrong_types(top / "docs", said)
    print("\n".join(f"docs/{problem}" for problem in problems) or f"formats: {len(listed)}")
    return 1 if problems or len(listed) < 30 else 0


sys.exit(main())
