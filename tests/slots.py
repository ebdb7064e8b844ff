#!/usr/bin/env python3
"""No list of slots stands twice in a bundled graph file: where two passes have three or more equal slots, parameters or defines
in one list, one of them says `like` instead of writing them out. Usage: slots.py TOP."""
import itertools
import json
import pathlib
import re
import sys

MOST = 2  # equal entries that two stanzas may write out
LISTS = ("read", "write", "modify", "parameters", "defines")
TOKEN = re.compile(r'"(?:[^"\\\n]|\\.)*"|//[^\n]*')


def read_graph(text: str) -> dict:
    return json.loads(TOKEN.sub(lambda m: "" if m.group().startswith("//") else m.group(), text))


def entries(stanza: dict) -> dict[str, set[str]]:
    """The lists that a stanza writes out, by name; null takes away, and is no entry."""
    return {name: {f"{key}: {json.dumps(value)}" for key, value in (stanza.get(name) or {}).items() if value is not None}
            for name in LISTS}


def repeated(graph: dict) -> list[str]:
    """A message for each pair of passes that has more in common than it may."""
    passes = [p for p in graph.get("passes", []) if isinstance(p, dict) and "name" in p]
    said = []
    for one, two in itertools.combinations(passes, 2):
        for name in LISTS:
            both = sorted(entries(one)[name] & entries(two)[name])
            if len(both) > MOST:
                said.append(f"passes '{one['name']}' and '{two['name']}' write out the same {len(both)} entries of \"{name}\", "
                            f'expected {MOST} at most; give the later one "like", and null for what it does not take: '
                            f'{"; ".join(both)}')
    return said


def check_itself() -> None:
    """The check sees what it is for, and nothing else."""
    slots = {"read": {"a": "x", "b": "y", "c": "z"}}
    one, two = {"name": "one", **slots}, {"name": "two", **slots}
    assert len(repeated({"passes": [one, two]})) == 1
    assert len(repeated({"passes": [one, {"name": "other", "read": {"a": "x", "b": "y", "c": "?"}}, two]})) == 1
    assert not repeated({"passes": [one, {"name": "two", "like": "one", "read": {"a": None, "b": None, "c": None}}]})
    assert not repeated({"passes": [one, {"name": "two", "write": slots["read"]}]})


def main() -> int:
    top = pathlib.Path(sys.argv[1])
    check_itself()
    files = sorted((top / "graphs").rglob("*.json"))
    said = [f"{f.relative_to(top)}: {line}" for f in files for line in repeated(read_graph(f.read_text()))]
    print("\n".join(said) or f"slots: {len(files)} files, no list of slots twice")
    return bool(said)


sys.exit(main())
