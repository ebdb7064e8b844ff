#!/usr/bin/env python3
"""Fills the second column of the tables of keys in docs/graph-format.md with what docs/graph.schema.json says of each key, as hover and completion say it.

    docs/keys.py            write the page
    docs/keys.py --check    write nothing; say whether the page is what this makes, and whether it names every key of a graph, a pass and an include
"""
import json
import pathlib
import re
import sys

DOCS = pathlib.Path(__file__).resolve().parent
PAGE = DOCS / "graph-format.md"
SCHEMA = json.loads((DOCS / "graph.schema.json").read_text())
# A table's keys are those of the first of these that has the key in its first row.
KINDS = [SCHEMA, SCHEMA["$defs"]["pass"], SCHEMA["$defs"]["passChange"]]


def filled(table):
    keys = re.findall(r"^\| (\[?`(\w+)`.*?) \|", table, re.M)
    known = {key: spec["description"] for kind in reversed(KINDS) for key, spec in kind["properties"].items() if "description" in spec}
    own = next(kind["properties"] for kind in KINDS if keys[0][1] in kind["properties"])
    return "| key | |\n|---|---|\n" + "".join(f"| {cell} | {own.get(key, {}).get('description') or known[key]} |\n" for cell, key in keys)


def main():
    page = PAGE.read_text()
    made = re.sub(r"^\| key \| \|\n\|---\|---\|\n(?:\|.*\n)+", lambda table: filled(table[0]), page, flags=re.M)
    missing = [key for kind in KINDS for key in kind["properties"] if f"`{key}`" not in made and f'"{key}"' not in made and key != "$schema"]
    if missing:
        sys.exit(f"docs/graph-format.md does not name {', '.join(missing)}")
    if "--check" in sys.argv:
        sys.exit(0 if made == page else "docs/graph-format.md is not what docs/keys.py makes: run it")
    PAGE.write_text(made)


if __name__ == "__main__":
    main()
