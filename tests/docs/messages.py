#!/usr/bin/env python3
"""docs/messages.md against the program: the second block of each section is what `weft check` prints for the file it names.

    messages.py TOP WEFT
"""
import pathlib
import re
import subprocess
import sys


def main():
    top, weft = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    page = (top / "docs/messages.md").read_text()
    sections = re.findall(r"^## \d+\. (\S+)\n(.*?)(?=^## |\Z)", page, re.M | re.S)
    problems = []
    for name, body in sections:
        blocks = re.findall(r"^```text\n(.*?)^```", body, re.M | re.S)
        if len(blocks) != 2:
            problems.append(f"{name}: {len(blocks)} blocks, not two")
            continue
        printed = subprocess.run([weft, "check", name], cwd=top / "tests/bad_graphs", capture_output=True, text=True).stderr
        if printed != blocks[1]:
            problems.append(f"{name}: prints\n{printed}and the page says\n{blocks[1]}")
        if blocks[0] == blocks[1]:
            problems.append(f"{name}: nothing has changed")
    if len(sections) < 20:
        problems.append(f"{len(sections)} messages, not twenty")
    print("\n".join(problems) or f"{len(sections)} messages")
    sys.exit(1 if problems else 0)


main()
