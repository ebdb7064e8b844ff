#!/usr/bin/env python3
"""Makes C++ of the tables of what is said, when the build is configured.

    rows.py codes codes.json OUT            a macro with a row for each code, for engine/text/codes.h
    rows.py ROOM sentences.json OUT         a Sentence (engine/text/diagnostic.h) for each row, in weft::ROOM::say
"""
import json
import pathlib
import sys

FIELDS = ("message", "expected", "found", "hint", "resource", "pass")  # in the order of Sentence


def literal(text):
    return json.dumps(text, ensure_ascii=False)


def sentence(name, row):
    unknown = set(row) - {"code", *FIELDS}
    if unknown:
        sys.exit(f"{sys.argv[2]}: '{name}' has the unknown {', '.join(sorted(unknown))}")
    said = "".join(f", .{field} = {literal(row[field])}" for field in FIELDS if field in row)
    return f"inline constexpr text::Sentence {name}{{.code = text::Code::{row['code']}{said}}};\n"


def once(pairs):
    names = [name for name, _ in pairs]
    again = [name for name in names if names.count(name) > 1]
    if again:
        sys.exit(f"{sys.argv[2]}: '{again[0]}' stands there twice")
    return dict(pairs)


room, table, out = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
rows = json.loads(table.read_text(), object_pairs_hook=once)
if room == "codes":
    made = "#define WEFT_CODES(X)" + "".join(f" \\\n  X({code}, {row['name']}, {literal(row['title'])})" for code, row in rows.items()) + "\n"
else:
    made = f"#include \"engine/text/diagnostic.h\"\n\nnamespace weft::{room}::say {{\n\n{''.join(sentence(*item) for item in rows.items())}\n}}\n"
made = f"#pragma once\n\n{made}"
if not out.exists() or out.read_text() != made:  # else everything would be compiled anew
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(made)
