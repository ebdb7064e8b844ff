#!/usr/bin/env python3
"""Holds the sentences.json of each room against its code: every row is said somewhere, no two say the same of one code, and rows
stand in the order of the codes. That each has the arguments it names, the compiler checks."""
import json
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
codes = [row["name"] for row in json.loads((root / "engine/text/codes.json").read_text()).values()]
problems, count = [], 0
for table in sorted([*root.glob("engine/*/sentences.json"), root / "app/sentences.json"]):
    rows = json.loads(table.read_text())
    count += len(rows)
    said = {name for suffix in ("cpp", "h") for path in table.parent.rglob(f"*.{suffix}")
            for name in re.findall(r"\bsay::(\w+)", path.read_text())}
    problems += [f"{table}: nobody says '{name}'" for name in rows if name not in said]
    texts = [json.dumps(row, sort_keys=True) for row in rows.values()]
    problems += [f"{table}: two rows are {text}" for text in sorted(set(texts)) if texts.count(text) > 1]
    order = [(codes.index(row["code"]), name) for name, row in rows.items()]
    problems += [f"{table}: '{b[1]}' stands behind '{a[1]}'" for a, b in zip(order, order[1:]) if b < a]
print("\n".join(problems) or f"sentences: {count}, each said")
sys.exit(bool(problems))
